// From a closed network to the final patches: the whole fourth step of the method, in order.
#pragma once

#include <string>
#include <vector>

#include "kernels/patches/reach_count.h"

namespace intarsia::kernels {

struct SubdivideOptions {
  Index patches = 0;       // wanted number; 0 = as many as the rules ask for
  bool merge_tiny = true;  // before and after the division
  bool discs = true;       // robust: every patch a disc; paper: as they come
  MergeOptions merge;
  SplitOptions split;
  DiscOptions disc;
  Real hole_length = 0.05;  // boundary loops shorter than this count as filled
};

SubdivideOptions robust_subdivision();
SubdivideOptions paper_subdivision(std::uint64_t seed);

struct Subdivision {
  PatchLabels labels;  // per refined face
  PatchTable table;
  std::vector<std::uint8_t> on_network;  // per refined edge: border of a patch or of the surface
  std::vector<CurveKind> edge_kind;      // new borders: subdivision
  Index network_patches = 0;             // enclosed by the network
  Index merged_patches = 0;              // left after the tiny merge
  Index not_discs = 0;
  std::vector<std::string> warnings;
};

// Tiny merge, pi/2 rule, cuts to discs, merge of slivers, wanted number.
// Requires: `refined` with a closed network (loose ends are ignored), parent normals of the original faces, mean edge
// length of the original mesh in units of its diagonal.
// Ensures: every patch connected; on_network marks exactly the edges between two patches and those of the boundary.
// locked: as make_patch_surface has it.
Subdivision subdivide(const Work& work, const RefinedMesh& refined, Vec3View parent_normal, Real mean_edge,
                      const SubdivideOptions& options, std::span<const std::uint8_t> locked = {});

// Marks of the final labels on the edges of the refined mesh.
void mark_borders(const Work& work, const RefinedMesh& refined, const PatchLabels& labels,
                  std::vector<std::uint8_t>& on_network, std::vector<CurveKind>& edge_kind);

}  // namespace intarsia::kernels
