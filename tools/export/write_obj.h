// patches.obj, patches.mtl, network.obj: for Blender, Rhino, MeshLab.
#pragma once

#include "tools/export/handover.h"

namespace intarsia::tools {

// Errors of all: write_failed naming the file; cancelled.

// The input's triangles, a group and a material for each patch ("patch_7"), patches in order.
void write_patches_obj(const Work& work, const std::filesystem::path& path, const Handover& handover);

// Materials of the patches, and of the kinds of curves ("ridge").
void write_patches_mtl(const std::filesystem::path& path, const Handover& handover);

// Arcs as `l` lines, a group for each arc ("arc_3"), the material of its kind. Arcs share the vertices they meet at.
void write_network_obj(const std::filesystem::path& path, const Handover& handover);

}  // namespace intarsia::tools
