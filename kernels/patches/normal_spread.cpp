#include "kernels/patches/normal_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace intarsia::kernels {
namespace {

constexpr std::size_t kBruteForce = 2000;
constexpr int kDirections = 256;

Vec3 mean_direction(std::span<const WeightedNormal> normals, Real& coherence) {
  Vec3 sum = Vec3::Zero();
  Real area = 0;
  for (const auto& n : normals) {
    if (n.normal.squaredNorm() == 0) continue;
    sum += n.area * n.normal;
    area += n.area;
  }
  const Real length = sum.norm();
  coherence = area > 0 ? length / area : 1;
  return length > 0 ? Vec3(sum / length) : Vec3::Zero();
}

Real least_dot(std::span<const Vec3> a) {
  Real least = 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j) least = std::min(least, a[i].dot(a[j]));
  return least;
}

// Points of a golden spiral on the sphere.
const std::array<Vec3, kDirections>& directions() {
  static const auto table = [] {
    std::array<Vec3, kDirections> d;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const Real z = 1 - (2 * Real(i) + 1) / kDirections, r = std::sqrt(1 - z * z);
      const Real turn = 2 * std::numbers::pi * Real(i) / std::numbers::phi;
      d[i] = Vec3(r * std::cos(turn), r * std::sin(turn), z);
    }
    return d;
  }();
  return table;
}

}  // namespace

Real max_pair_angle(std::span<const WeightedNormal> normals, Real enough) {
  Real coherence = 0;
  const Vec3 mean = mean_direction(normals, coherence);
  Real lowest = 1;
  for (const auto& n : normals)
    if (n.normal.squaredNorm() > 0) lowest = std::min(lowest, n.normal.dot(mean));
  const Real cone = std::acos(std::clamp(lowest, Real{-1}, Real{1}));
  if (2 * cone <= enough) return 2 * cone;  // an upper bound
  // A pair `enough` apart has one normal at least enough - cone and one at least enough / 2 away from the mean.
  std::vector<Vec3> candidates;
  const Real gate = std::cos(std::clamp(enough - cone, Real{0}, Real(std::numbers::pi)));
  for (const auto& n : normals)
    if (n.normal.squaredNorm() > 0 && n.normal.dot(mean) <= gate + 1e-12) candidates.push_back(n.normal);
  if (candidates.size() > kBruteForce) {
    std::vector<std::size_t> extreme;
    for (const Vec3& d : directions()) {
      std::size_t best = 0;
      Real most = -2;
      for (std::size_t i = 0; i < candidates.size(); ++i)
        if (const Real dot = candidates[i].dot(d); dot > most) most = dot, best = i;
      extreme.push_back(best);
    }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    std::vector<Vec3> kept;
    kept.reserve(extreme.size());
    for (const std::size_t i : extreme) kept.push_back(candidates[i]);
    candidates.swap(kept);
  }
  return std::acos(std::clamp(least_dot(candidates), Real{-1}, Real{1}));
}

Real trimmed_spread(std::span<const WeightedNormal> normals, Real trim) {
  constexpr Real kIncoherent = 0.3;  // |sum A n| / A: an arc of normals of 280 degrees
  Real coherence = 0;
  const Vec3 mean = mean_direction(normals, coherence);
  if (coherence < kIncoherent) return std::numbers::pi;
  const Vec3 u = mean.unitOrthogonal(), v = mean.cross(u);
  // Angle from the mean, laid out in the plane across it.
  struct Item {
    Real x, y, area;
  };
  std::vector<Item> items;
  items.reserve(normals.size());
  Real xx = 0, xy = 0, yy = 0, total = 0;
  for (const auto& n : normals) {
    if (n.normal.squaredNorm() == 0 || n.area <= 0) continue;
    const Real x = n.normal.dot(u), y = n.normal.dot(v), side = std::hypot(x, y);
    const Real angle = std::atan2(side, n.normal.dot(mean)), scale = side > 0 ? angle / side : 0;
    items.push_back({x * scale, y * scale, n.area});
    xx += n.area * items.back().x * items.back().x;
    xy += n.area * items.back().x * items.back().y;
    yy += n.area * items.back().y * items.back().y;
    total += n.area;
  }
  if (items.empty()) return 0;
  const Real turn = std::atan2(2 * xy, xx - yy) / 2, c = std::cos(turn), s = std::sin(turn);
  std::vector<std::pair<Real, Real>> along;  // position, area
  along.reserve(items.size());
  for (const Item& i : items) along.push_back({c * i.x + s * i.y, i.area});
  std::sort(along.begin(), along.end());
  const auto quantile = [&](Real share) {
    Real sum = 0;
    for (const auto& [at, area] : along)
      if ((sum += area) >= share * total) return at;
    return along.back().first;
  };
  return quantile(1 - trim) - quantile(trim);
}

}  // namespace intarsia::kernels
