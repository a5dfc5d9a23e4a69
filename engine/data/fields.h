// Per-vertex fields of the feature detection, structure of arrays. Lengths are in units of the bounding-box diagonal.
// Sign convention: normals point outward, a convex surface has positive curvature (a sphere of radius r has 1/r).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/types.h"
#include "engine/data/mesh.h"

namespace intarsia {

enum class FitStatus : std::uint8_t { full = 0, ring_grown = 1, quadratic = 2, invalid = 3 };

struct CurvatureFields {
  Vec3Array normal;                // unit, refined (pass B)
  std::vector<Real> kmax, kmin;    // kmax >= kmin, signed
  Vec3Array tmax, tmin;            // unit tangent directions, each defined up to sign
  std::vector<Real> emax, emin;    // derivative of kmax (kmin) along the stored tmax (tmin)
  std::vector<Real> radius;        // rho: mean 3D distance of the fit points
  std::vector<std::uint8_t> ring;  // ring really fitted; above 6 a disc, see engine/data/sample_levels.h
  std::vector<FitStatus> status;
  std::vector<std::uint8_t> direction_ok;  // 0 where kmax and kmin are too equal for directions to mean anything

  Index vertex_count() const { return static_cast<Index>(kmax.size()); }
  void resize(std::size_t n) {
    normal.resize(n), tmax.resize(n), tmin.resize(n);
    for (auto* a : {&kmax, &kmin, &emax, &emin, &radius}) a->resize(n);
    ring.resize(n), status.resize(n), direction_ok.resize(n);
  }
};

}  // namespace intarsia
