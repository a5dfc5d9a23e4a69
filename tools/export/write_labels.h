// labels.seg, labels.npy, patches.csv, network.polylines.txt: the layout as plain rows.
#pragma once

#include "tools/export/handover.h"

namespace intarsia::tools {

// Errors of all: write_failed naming the file; cancelled.

// The patch of each triangle of patches.ply, one a line (Chen, Golovinskiy, Funkhouser 2009).
void write_labels_seg(const std::filesystem::path& path, const Handover& handover);

// The same as a NumPy array: version 1.0, shape (triangles,), little-endian int32.
void write_labels_npy(const std::filesystem::path& path, const Handover& handover);

// Arcs, one a line: number of points, then their coordinates. For CGAL's read_polylines and whatever reads numbers.
void write_network_polylines(const std::filesystem::path& path, const Handover& handover);

// A row of numbers for each patch, in the input's units.
struct PatchRow {
  Index triangles = 0;  // of patches.ply
  Real area = 0, perimeter = 0;
  Vec3 centroid = Vec3::Zero();
  Vec3 normal = Vec3::Zero();     // mean of the unit normals by area: its length is 1 where the patch is flat
  Index loops = 0, sides = 0;     // sides: arcs around the patch
  std::vector<Index> neighbours;  // ascending

  // perimeter^2 / (4 pi area): 1 for a disc
  Real compactness() const;
};
std::vector<PatchRow> patch_rows(const Handover& handover);

void write_patches_csv(const std::filesystem::path& path, const Handover& handover);

}  // namespace intarsia::tools
