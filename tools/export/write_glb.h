// layout.glb: glTF 2.0 in one binary file, for viewers, game engines, browsers, Blender.
#pragma once

#include "tools/export/handover.h"

namespace intarsia::tools {

// A node "patches" whose mesh has a primitive and a material ("patch_7") for each patch, and a node "curves" with a
// primitive of line segments for each kind of curve. Positions are floats around the centre of the input's box, which
// is the translation of the nodes: nothing is lost far from the origin. Normals are smooth inside a patch, and across
// borders that do not bend.
// Errors: too_large above 4 GiB, the format's limit; write_failed; cancelled.
void write_layout_glb(const Work& work, const std::filesystem::path& path, const Handover& handover);

}  // namespace intarsia::tools
