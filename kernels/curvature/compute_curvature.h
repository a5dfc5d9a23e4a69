// The curvature stage: refined normals, cubic fits, principal curvatures and directions, extremalities (Eq. 1-3).
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/fields.h"
#include "engine/data/mesh.h"
#include "engine/data/sample_levels.h"
#include "engine/parallel/work.h"
#include "kernels/curvature/fit_cubic.h"

namespace intarsia::kernels {

struct CurvatureOptions {
  FitOptions fit;
  Real anisotropy = 0.05;  // paper silent; least (kmax - kmin) / max(|kmax|, |kmin|) for directions
  Real flat_turn = 1e-6;   // radians over the fit radius below which the surface is flat; 1e-4 if the input's
                           // coordinates were single precision

  static CurvatureOptions paper() {
    CurvatureOptions o;
    o.fit = FitOptions::paper();
    return o;
  }
};

// fit_ring: ring (1 .. 6) or disc code per vertex; levels: those the codes were chosen on (may be empty without codes).
// barrier: one flag per edge that fits over rings do not cross, or empty. Discs ignore it.
// Requires: vertex_normal unit; sizes agree.
// Ensures: no NaN; directions unit and perpendicular to the normal, (tmax, tmin, normal) right-handed; status invalid:
// all zero but the normal and an arbitrary frame; quadratic: e = 0.
CurvatureFields compute_curvature(const Work& work, const MeshView& mesh, const Vec3View& vertex_normal,
                                  std::span<const std::uint8_t> fit_ring, const SampleLevels& levels,
                                  std::span<const std::uint8_t> barrier, const CurvatureOptions& options);

}  // namespace intarsia::kernels
