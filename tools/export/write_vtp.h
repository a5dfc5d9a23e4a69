// patches.vtp, network.vtp, features.vtp: for ParaView, VTK and PyVista.
#pragma once

#include "tools/export/handover.h"

namespace intarsia::tools {

// Errors of all: write_failed naming the file; cancelled.

// The input's triangles with cell array patch_id.
void write_patches_vtp(const std::filesystem::path& path, const Handover& handover);

// Arcs as polylines with cell arrays arc, kind, left, right (-1 outside the surface), length, turn; points with vertex
// (of layout.ply) and node (-1 between nodes). An arc has points of its own.
void write_network_vtp(const std::filesystem::path& path, const Handover& handover);

// Raw and chosen feature lines with cell arrays kind, chosen, length, L, R, T; points with curvature, radius.
void write_features_vtp(const std::filesystem::path& path, const FeatureLines& lines);

}  // namespace intarsia::tools
