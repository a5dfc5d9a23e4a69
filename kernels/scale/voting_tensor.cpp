#include "kernels/scale/voting_tensor.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

namespace {

constexpr Real kDegenerateArea = 1e-14;

// Taylor series about t = 1/2: the remainder of degree 14 on |t - 1/2| <= 1/2 is below 3e-17.
constexpr int kDecayTerms = 14;
constexpr std::array<Real, kDecayTerms> decay_coefficients() {
  std::array<Real, kDecayTerms> c{};
  Real term = 0.60653065971263342360;  // exp(-1/2)
  for (int i = 0; i < kDecayTerms; ++i) {
    c[i] = term;
    term /= -(i + 1);
  }
  return c;
}
constexpr auto kDecay = decay_coefficients();

// Weights and tensor of the first `count` faces; the weights stay for first_moment_variation.
Tensor collect(const VotingScratch& s, std::size_t count, Real inverse_reach, std::vector<Real>& weight) {
  for (std::size_t i = 0; i < count; ++i) weight[i] = s.area[i] * decay(s.distance[i] * inverse_reach);
  Tensor t{};
  for (std::size_t i = 0; i < count; ++i) {
    const Real w = weight[i], x = s.nx[i], y = s.ny[i], z = s.nz[i];
    const Real wx = w * x, wy = w * y;
    t[0] += wx * x, t[1] += wx * y, t[2] += wx * z;
    t[3] += wy * y, t[4] += wy * z, t[5] += w * z * z;
  }
  return t;
}

// 1/m^2 - 1 with m = |sum mu n| / sum mu; the weights are those of collect().
Real first_moment_variation(const VotingScratch& s, std::size_t count) {
  Vec3 moment = Vec3::Zero();
  Real total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    moment += s.weight[i] * Vec3(s.nx[i], s.ny[i], s.nz[i]);
    total += s.weight[i];
  }
  const Real squared = moment.squaredNorm();
  if (!(total > 0)) return 0;
  constexpr Real kMost = 1e6;  // all normals cancel
  return squared * kMost <= total * total ? kMost : total * total / squared - 1;
}

}  // namespace

Real decay(Real t) {
  const Real u = t - 0.5;
  Real sum = kDecay[kDecayTerms - 1];
  for (int i = kDecayTerms - 2; i >= 0; --i) sum = sum * u + kDecay[i];
  return sum;
}

std::vector<FaceRecord> face_records(const Work& work, const MeshView& mesh) {
  std::vector<FaceRecord> record(mesh.face_count());
  for_each(work, Cost::light, record.size(), [&](std::size_t f) {
    const auto [i, j, k] = mesh.face(static_cast<Index>(f));
    const Vec3 a = mesh.point(i), b = mesh.point(j), c = mesh.point(k);
    const Vec3 cross = (b - a).cross(c - a);
    const Real twice = cross.norm();
    const bool degenerate = !(0.5 * twice > kDegenerateArea);
    record[f].centroid = (a + b + c) / 3;
    record[f].normal = degenerate ? Vec3(Vec3::Zero()) : Vec3(cross / twice);
    record[f].area = degenerate ? 0 : 0.5 * twice;
  });
  return record;
}

Real variation_of_tensor(const Tensor& t) {
  const Real trace = t[0] + t[3] + t[5];
  if (!(trace > 0)) return 0;
  // Largest root of the characteristic cubic in trigonometric form (Smith 1961, "Eigenvalues of a symmetric 3x3
  // matrix").
  const Real mean = trace / 3;
  const Real a = t[0] - mean, b = t[3] - mean, c = t[5] - mean;
  const Real p2 = (a * a + b * b + c * c + 2 * (t[1] * t[1] + t[2] * t[2] + t[4] * t[4])) / 6;
  const Real p = std::sqrt(p2);
  if (p <= 1e-15 * mean) return 2;
  const Real det = a * (b * c - t[4] * t[4]) - t[1] * (t[1] * c - t[4] * t[2]) + t[2] * (t[1] * t[4] - b * t[2]);
  const Real r = std::clamp(det / (2 * p2 * p), Real(-1), Real(1));
  const Real largest = mean + 2 * p * std::cos(std::acos(r) / 3);
  return std::clamp((trace - largest) / largest, Real(0), Real(2));
}

Variation variation_of(const MeshView& mesh, std::span<const FaceRecord> faces, Index v, bool fold_guard,
                       RingWalker& walker, VotingScratch& s) {
  Variation out;
  out.omega.fill(0);
  out.folded.fill(0);
  walker.walk(v, kRings - 1, RingWalker::kTensorCap);
  walker.collect_faces(kRings);
  const auto around = walker.faces(kRings);
  if (s.area.size() < around.size())
    for (auto* a : {&s.distance, &s.weight, &s.area, &s.nx, &s.ny, &s.nz}) a->resize(2 * around.size());

  const Vec3 centre = mesh.point(v);
  std::size_t count = 0;
  Real reach = 0;         // max |c_f - P| so far
  Real least_cosine = 1;  // against the first normal: a bound for the first moment
  for (int k = 1; k <= kRings; ++k) {
    const std::size_t listed = walker.faces(k).size();
    for (std::size_t i = k == 1 ? 0 : walker.faces(k - 1).size(); i < listed; ++i) {
      const FaceRecord& f = faces[around[i]];
      if (f.area <= 0) continue;
      const Real d = (f.centroid - centre).norm();
      reach = std::max(reach, d);
      s.distance[count] = d, s.area[count] = f.area;
      s.nx[count] = f.normal.x(), s.ny[count] = f.normal.y(), s.nz[count] = f.normal.z();
      least_cosine = std::min(least_cosine, f.normal.x() * s.nx[0] + f.normal.y() * s.ny[0] + f.normal.z() * s.nz[0]);
      ++count;
    }
    if (count == 0) continue;
    const Tensor votes = collect(s, count, reach > 0 ? 1 / reach : 0, s.weight);
    const Real omega = variation_of_tensor(votes);
    out.omega[k - 1] = out.folded[k - 1] = omega;
    // The moment is at least the smallest cosine against any axis: above sqrt(1/2) its variation stays below 1.
    if (fold_guard && least_cosine < 0.7072) {
      const Real first = first_moment_variation(s, count);
      if (first > 1) out.folded[k - 1] = std::max(omega, first);
    }
  }
  return out;
}

}  // namespace intarsia::kernels
