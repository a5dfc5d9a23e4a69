#include "kernels/scale/voting_tensor.h"

#include <algorithm>
#include <cmath>

namespace intarsia::kernels {

namespace {

constexpr Real kDegenerateArea = 1e-14;

// Weights and tensor of the first `count` faces (whole lanes; faces of area 0 fill up). The weights stay for
// first_moment_variation.
INTARSIA_WIDE void vote(std::size_t count, Real inverse_reach, const Real* distance, const Real* area, const Real* nx,
                        const Real* ny, const Real* nz, Real* weight, Tensor& tensor) {
  Lanes xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes u = lanes_at(distance + i) * inverse_reach - 0.5;
    Lanes w = u * kDecay[kDecayTerms - 1] + kDecay[kDecayTerms - 2];
    for (std::size_t j = kDecayTerms - 2; j-- > 0;) w = w * u + kDecay[j];
    w = w * lanes_at(area + i);
    lanes_at(weight + i) = w;
    const Lanes x = lanes_at(nx + i), y = lanes_at(ny + i), z = lanes_at(nz + i);
    const Lanes wx = w * x, wy = w * y, wz = w * z;
    xx += wx * x, xy += wx * y, xz += wx * z;
    yy += wy * y, yz += wy * z, zz += wz * z;
  }
  tensor = {sum_of(xx), sum_of(xy), sum_of(xz), sum_of(yy), sum_of(yz), sum_of(zz)};
}

// 1/m^2 - 1 with m = |sum mu n| / sum mu; the weights are those of collect().
Real first_moment_variation(const VotingScratch& s, std::size_t count) {
  Vec3 moment = Vec3::Zero();
  Real total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    moment += s.weight.data()[i] * Vec3(s.nx.data()[i], s.ny.data()[i], s.nz.data()[i]);
    total += s.weight.data()[i];
  }
  const Real squared = moment.squaredNorm();
  if (!(total > 0)) return 0;
  constexpr Real kMost = 1e6;  // all normals cancel
  return squared * kMost <= total * total ? kMost : total * total / squared - 1;
}

}  // namespace

FaceRecord face_record(const MeshView& mesh, Index f) {
  const auto [i, j, k] = mesh.face(f);
  const Vec3 a = mesh.point(i), b = mesh.point(j), c = mesh.point(k);
  const Vec3 cross = (b - a).cross(c - a);
  const Real twice = cross.norm();
  const bool degenerate = !(0.5 * twice > kDegenerateArea);
  FaceRecord record;
  record.centroid = (a + b + c) / 3;
  record.normal = degenerate ? Vec3(Vec3::Zero()) : Vec3(cross / twice);
  record.area = degenerate ? 0 : 0.5 * twice;
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

Variation variation_of(const MeshView& mesh, Index v, bool fold_guard, RingWalker& walker, VotingScratch& s) {
  Variation out;
  out.omega.fill(0);
  out.folded.fill(0);
  walker.walk(v, kRings - 1, RingWalker::kTensorCap);
  walker.collect_faces(kRings);
  const auto around = walker.faces(kRings);
  if (s.area.size() < around.size() + kLanes)
    for (auto* a : {&s.distance, &s.weight, &s.area, &s.nx, &s.ny, &s.nz}) a->resize(2 * around.size() + kLanes);
  Real *distance = s.distance.data(), *area = s.area.data();
  Real *nx = s.nx.data(), *ny = s.ny.data(), *nz = s.nz.data();

  const Vec3 centre = mesh.point(v);
  std::size_t count = 0;
  Real reach = 0;         // max |c_f - P|^2 so far
  Real least_cosine = 1;  // against the first normal: a bound for the first moment
  for (int k = 1; k <= kRings; ++k) {
    const std::size_t listed = walker.faces(k).size();
    for (std::size_t i = k == 1 ? 0 : walker.faces(k - 1).size(); i < listed; ++i) {
      const FaceRecord f = face_record(mesh, around[i]);
      if (f.area <= 0) continue;
      const Real squared = (f.centroid - centre).squaredNorm();
      reach = std::max(reach, squared);
      distance[count] = std::sqrt(squared), area[count] = f.area;
      nx[count] = f.normal.x(), ny[count] = f.normal.y(), nz[count] = f.normal.z();
      least_cosine = std::min(least_cosine, nx[count] * nx[0] + ny[count] * ny[0] + nz[count] * nz[0]);
      ++count;
    }
    if (count == 0) continue;
    for (std::size_t i = count; i < whole_lanes(count); ++i) area[i] = distance[i] = nx[i] = ny[i] = nz[i] = 0;
    Tensor tensor;
    vote(whole_lanes(count), reach > 0 ? 1 / std::sqrt(reach) : 0, distance, area, nx, ny, nz, s.weight.data(), tensor);
    const Real omega = variation_of_tensor(tensor);
    const auto at = static_cast<std::size_t>(k - 1);
    out.omega[at] = out.folded[at] = omega;
    // The moment is at least the smallest cosine against any axis: above sqrt(1/2) its variation stays below 1.
    if (fold_guard && least_cosine < 0.7072) {
      const Real first = first_moment_variation(s, count);
      if (first > 1) out.folded[at] = std::max(omega, first);
    }
  }
  return out;
}

}  // namespace intarsia::kernels
