// Mesh edges that are creases by themselves, chained. A smooth fit cannot follow a crease whose vertices lie on it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/feature_curves.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Lengths in units of the bounding-box diagonal, angles in radians.
struct SharpOptions {
  bool enabled = true;                      // paper mode: off
  Real strong = 1.0471975511965976;         // dihedral turning that makes an edge sharp
  Real weak = 0.52359877559829882;          // enough for an edge that continues a sharp chain
  Real relative = 3;                        // times the median turn of the edges around: rough is not sharp
  Real continuation = 0.78539816339744831;  // largest turn of the chain where a weak edge continues it
  Real corner = 0.78539816339744831;        // a chain is cut where it turns by more
  Index min_edges = 4;                      // a connected set of sharp edges must have as many edges ...
  Real min_length = 0.03;                   // ... and be as long, and
  Real min_length_in_edges = 4;             // as long as so many mean edges
  Index suppression_rings = 1;              // ridges are suppressed up to here from a sharp chain of their channel
};

struct SharpEdges {
  FeatureCurves curves;                    // kind sharp, all points on vertices; measures are not filled
  std::vector<Index> edge;                 // the mesh edges on the curves, ascending
  std::vector<std::uint8_t> near_convex;   // per vertex: 1 within suppression_rings of a convex sharp edge
  std::vector<std::uint8_t> near_concave;  // likewise; both empty where there are no sharp edges
};

// Boundary edges are never sharp. Faces without area make their edges not sharp.
// Requires: edge_length = mean edge length.
// Ensures: curves end where the number of sharp edges at a vertex is not two, at corners, and where convex turns
// concave; curves that meet there share the point.
SharpEdges sharp_edges(const Work& work, const MeshView& mesh, Real edge_length, const SharpOptions& options);

}  // namespace intarsia::kernels
