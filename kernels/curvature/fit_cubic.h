// The adjacent-normal cubic at a vertex, fitted over rings or over a disc of coarse samples (Cao, Yan, Wonka 2014, Eq.
// 1; Goldfeather, Interrante 2004, "A novel cubic-order algorithm for approximating principal direction vectors").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/disc_walk.h"
#include "engine/data/fields.h"
#include "engine/data/k_ring.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/curvature/cubic_system.h"

namespace intarsia::kernels {

struct FitOptions {
  Real normal_gate = 0.1;      // a point takes part if its normal is within about 84 degrees of the centre's
  Real disc_gate = 0.5;        // the same in a disc, 60 degrees: what lies beyond a sharp feature must not be fitted
  Real least_pivot = 1e-6;     // smallest over largest pivot of an acceptable fit
  int extra_rings = 2;         // rings added before giving up the cubic terms
  int refine_ring = 2;         // ring of the normal refinement where the curvature is fitted in a disc
  Rows rows = Rows::round;     // rows that are exact on spheres and cylinders, or the paper's
  bool refine_normals = true;  // pass B; off in paper mode

  static FitOptions paper() {
    FitOptions o;
    o.rows = Rows::slopes, o.refine_normals = false;
    return o;
  }
};

// Right-handed orthonormal frame around a unit normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
struct Frame {
  Vec3 u, v, n;
  explicit Frame(const Vec3& normal);
};

struct VertexFit {
  CubicFit cubic;
  Real radius = 0;  // mean 3D distance of the points: the unit of the fit
  int ring = 0;     // ring really used
  FitStatus status = FitStatus::invalid;
};

// Fits h over rings 1 .. ring of v in its frame, growing by extra_rings where the cubic is not determined, then falling
// back to the quadratic. terms: 7 (Eq. 1) or 9 (free tangent plane).
// Requires: normals unit (a zero normal drops its point). Ensures: no NaN. Walks `walker`; `batch` is scratch.
VertexFit fit_rings(const MeshView& mesh, const Vec3View& normal, Index v, const Frame& frame, int ring,
                    std::size_t terms, const FitOptions& options, RingWalker& walker, PointBatch& batch);

// One unit mean normal per cluster of every level, from vertex normals weighted by area.
std::vector<Vec3Array> sample_normals(const Work& work, const MeshView& mesh, const SampleLevels& levels,
                                      const Vec3View& normal);

// Fits the cubic with a free plane (10 terms) to the samples of the disc `code` around vertex v of cluster c of level
// 0. The free plane takes up what the means of clusters lie below the surface. Status full or invalid.
VertexFit fit_disc(const MeshView& mesh, const SampleLevels& levels, std::span<const Vec3Array> sample_normal, Index v,
                   Index c, int code, const Frame& frame, const FitOptions& options, DiscWalker& walker,
                   PointBatch& batch);

// Pass B: the normal of the 9-term fit with the given normals. Reads normal_in, writes normal_out (Jacobi). A vertex
// whose fit is not determined or would turn by more than 45 degrees keeps its normal.
void refine_normals(const Work& work, const MeshView& mesh, const Vec3View& normal_in,
                    std::span<const std::uint8_t> fit_ring, std::span<const std::uint8_t> barrier,
                    const FitOptions& options, Vec3Array& normal_out);

}  // namespace intarsia::kernels
