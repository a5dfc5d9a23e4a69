// The scale stage: surface variation of every vertex in six rings (Eq. 4-6), the ring that each is to be fitted in,
// and, in robust mode, discs beyond six rings where a densely sampled surface bends too slowly for them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/data/sample_levels.h"
#include "engine/parallel/work.h"
#include "kernels/scale/select_scale.h"

namespace intarsia::kernels {

struct ScaleOptions {
  SelectOptions select;
  bool fold_guard = true;  // the rule (not the exported omega) reads the first moment where normals oppose
  bool closest_between =
      true;                   // fit in the third case: the ring closest to omega_+, as in the bent case. The jump rule
                              // ends at ring 2 on a fillet of 6 edges' radius, where three parallel ridges appear.
  bool discs = true;          // look beyond six rings
  Real largest_disc = 0.057;  // diagonals; fillets that bend more slowly turn too little to be features, and on coarser
                              // meshes six rings reach as far
  Real flat_reach = 0.01;  // diagonals; where no disc bends either, the fit reaches this far (2 to 4 rings, or a disc
                           // on denser meshes): on irregular meshes small fits of flat parts are all noise
  bool keep_variation = false;  // fill ScaleFields::omega: 48 bytes a vertex

  static ScaleOptions paper() {
    ScaleOptions o;
    o.select = SelectOptions::paper();
    o.fold_guard = o.closest_between = o.discs = false;
    return o;
  }
};

struct ScaleFields {
  std::array<std::vector<Real>, kRings> omega;  // Eq. 6; empty unless kept
  std::vector<std::uint8_t> scale;              // ring chosen by the rule, 1 .. 6
  std::vector<std::uint8_t> fit_ring;           // ring to fit, 1 .. 6, or disc code (engine/data/sample_levels.h)
  SampleLevels levels;                          // empty where nothing is fitted in a disc
};

// Requires: coordinates in units of the bounding-box diagonal; mesh connected; vertices in canonical order if `discs`.
ScaleFields compute_scale(const Work& work, const MeshView& mesh, const ScaleOptions& options);

}  // namespace intarsia::kernels
