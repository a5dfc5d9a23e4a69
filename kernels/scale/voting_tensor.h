// Normal voting tensor and surface variation in six nested rings.
//
// T_k(P) = sum over N_k(P) of A_f exp(-|c_f - P| / max |c_f - P|) n_f n_f^T, omega_k = (l2 + l3) / l1 of its
// eigenvalues l1 >= l2 >= l3 (Cao, Yan, Wonka 2014, Eq. 4-6; the division by the largest area cancels in omega and is
// left out). omega is 0 on a plane, 1 on a symmetric right-angled crease, 2 in the corner of a cube.
#pragma once

#include <array>
#include <vector>

#include "engine/base/lanes.h"
#include "engine/data/k_ring.h"
#include "engine/data/mesh.h"
#include "engine/data/sample_levels.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// What the tensor needs of a face.
struct FaceRecord {
  Vec3 centroid;
  Vec3 normal;  // unit; zero where area is 0
  Real area;    // 0 for degenerate faces (at most 1e-14 of the squared diagonal): they vote for nothing
};

FaceRecord face_record(const MeshView& mesh, Index f);

using Tensor = std::array<Real, 6>;  // symmetric: xx, xy, xz, yy, yz, zz
using RingValues = std::array<Real, kRings>;

// Eq. 6 of one vertex and the first-moment reading of the same votes.
struct Variation {
  RingValues omega;   // Eq. 6, in [0, 2]; 0 where no face votes
  RingValues folded;  // omega, or 1/m^2 - 1 with m = |sum mu n| / sum mu where that is above 1 and above omega: n n^T
                      // does not see the sign of n, so omega falls back to 0 at knife edges. Only filled if asked for.
};

// Scratch of variation_of: the faces of N_6 as arrays, grown to the largest neighbourhood met.
struct VotingScratch {
  LaneArray distance, weight, area, nx, ny, nz;
};

// The variation of vertex v in rings 1 .. 6: the reference for kernels/scale/group_voting.h, which serves most
// vertices, and what serves the rest. Ensures: no NaN; a vertex without faces gets zeros. Walks `walker`.
Variation variation_of(const MeshView& mesh, Index v, bool fold_guard, RingWalker& walker, VotingScratch& scratch);

// (trace - l1) / l1; 0 if the trace is not positive.
Real variation_of_tensor(const Tensor& tensor);

// Taylor series of exp(-t) about t = 1/2; the remainder of degree 14 on [0, 1] is below 3e-17.
inline constexpr std::size_t kDecayTerms = 14;
inline constexpr std::array<Real, kDecayTerms> kDecay = [] {
  std::array<Real, kDecayTerms> c{};
  Real term = 0.60653065971263342360;  // exp(-1/2)
  for (std::size_t i = 0; i < kDecayTerms; ++i) {
    c[i] = term;
    term /= -static_cast<Real>(i + 1);
  }
  return c;
}();

// exp(-t) for t in [0, 1], to 1e-15, without a call.
inline Real decay(Real t) {
  const Real u = t - 0.5;
  Real sum = kDecay[kDecayTerms - 1];
  for (std::size_t i = kDecayTerms - 1; i-- > 0;) sum = sum * u + kDecay[i];
  return sum;
}

}  // namespace intarsia::kernels
