#include "kernels/quality/surface_distance.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "engine/base/random.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/scan.h"
#include "kernels/quality/farthest_point.h"

namespace intarsia::kernels {
namespace {

constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;

// Point i of triangle f: the R2 sequence (Roberts 2018) from a start of the triangle's own, so that few points per
// triangle are unbiased and many fill it evenly; the half of the unit square beyond the diagonal is turned back.
Vec3 sample_point(const TrianglesView& t, Index f, std::uint64_t i) {
  constexpr Random start(0x696e7461, 14);
  const auto part = [&](Real step, std::uint64_t draw) {
    const Real x = start.uniform(f, draw) + step * static_cast<Real>(i);
    return x - std::floor(x);
  };
  Real u = part(0.7548776662466927, 0), v = part(0.5698402909980532, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Index* corner = &t.corner[3 * std::size_t{f}];
  const Vec3 a = t.point[corner[0]];
  return a + u * (t.point[corner[1]] - a) + v * (t.point[corner[2]] - a);
}

Real area_of(const TrianglesView& t, std::size_t f) {
  const Vec3 a = t.point[t.corner[3 * f]];
  return 0.5 * (t.point[t.corner[3 * f + 1]] - a).cross(t.point[t.corner[3 * f + 2]] - a).norm();
}

// Samples of one surface and what they found on the other. Ranks count triangles in the order of their tree.
class Side {
 public:
  Side(const Work& work, const TrianglesView& surface, std::span<const Index> order, const TrianglesView& other,
       const TriangleTree& other_tree, const DistanceOptions& options)
      : work_(work), surface_(surface), order_(order), other_(other), tree_(other_tree), options_(options) {
    area.resize(surface.count());
    for_each(work, Cost::light, area.size(), [&](std::size_t f) { area[f] = area_of(surface, f); });
    total.area = sum(work, Cost::light, area.size(), Real{0}, [&](std::size_t f) { return area[f]; });
    if (!(total.area > 0) || !std::isfinite(total.area))
      throw Error(ErrorCode::rejected, "a surface whose triangles have no area cannot be sampled");
  }

  void measure() {
    place_samples();
    measure_samples();
    measure_vertices();
    add_up();
    find_farthest();
  }

  DistanceSamples samples() const {
    DistanceSamples s;
    s.point.resize(sample_distance_.size()), s.triangle.resize(sample_distance_.size());
    for_each(work_, Cost::medium, order_.size(), [&](std::size_t r) {
      for (std::uint64_t i = first_[r]; i < first_[r + 1]; ++i)
        s.point.set(i, sample_point(surface_, order_[r], i - first_[r])), s.triangle[i] = order_[r];
    });
    s.distance = sample_distance_;
    return s;
  }

  OneSided total;
  std::vector<Real> area, mean, rms, max;  // per triangle
  std::vector<Real> vertex;

 private:
  // Stratified by area along the order of the tree: a face gets the whole numbers that its part of the running sum
  // passes (at least one). Sums in fixed point, so that any blocking gives the same.
  void place_samples() {
    const std::uint64_t wanted = std::clamp<std::uint64_t>(options_.samples / 2, 1, kMostSamples);
    const Real density = static_cast<Real>(wanted) / total.area;
    std::vector<std::uint64_t> place(order_.size() + 1);
    for_each(work_, Cost::light, order_.size(),
             [&](std::size_t r) { place[r] = static_cast<std::uint64_t>(area[order_[r]] * density * 0x1p32); });
    exclusive_scan<std::uint64_t>(work_, place);
    first_.assign(order_.size() + 1, 0);
    for_each(work_, Cost::light, order_.size(), [&](std::size_t r) {
      const std::uint64_t least = area[order_[r]] > 0 ? 1 : 0;
      first_[r] = std::max(least, (place[r + 1] >> 32) - (place[r] >> 32));
    });
    total.samples = exclusive_scan<std::uint64_t>(work_, first_);
    sample_distance_.resize(total.samples);
    sample_nearest_.resize(total.samples);
  }

  void measure_samples() {
    for_each_block(work_, Cost::medium, total.samples, [&](std::size_t begin, std::size_t end, std::size_t) {
      std::size_t r =
          static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), begin) - first_.begin()) - 1;
      Index hint = kNone;
      for (std::size_t s = begin; s < end; ++s) {
        while (first_[r + 1] <= s) ++r;
        const ClosestTriangle found = tree_.closest(sample_point(surface_, order_[r], s - first_[r]), hint);
        sample_distance_[s] = std::sqrt(found.distance2), sample_nearest_[s] = hint = found.triangle;
      }
    });
  }

  // Every used point is measured once, with the first triangle of the order that has it: its samples are near.
  void measure_vertices() {
    const std::size_t points = surface_.point.size();
    std::vector<Index> owner(points, kNone);
    for_each(work_, Cost::light, order_.size(), [&](std::size_t r) {
      for (std::size_t i = 0; i < 3; ++i) {
        std::atomic_ref<Index> at(owner[surface_.corner[3 * std::size_t{order_[r]} + i]]);
        Index known = at.load(std::memory_order_relaxed);
        while (r < known && !at.compare_exchange_weak(known, static_cast<Index>(r), std::memory_order_relaxed))
          continue;
      }
    });
    vertex.assign(points, 0);
    vertex_nearest_.assign(points, kNone);
    for_each(work_, Cost::medium, order_.size(), [&](std::size_t r) {
      Index hint = first_[r] < first_[r + 1] ? sample_nearest_[first_[r]] : kNone;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = surface_.corner[3 * std::size_t{order_[r]} + i];
        if (owner[v] != r || vertex_nearest_[v] != kNone) continue;
        const ClosestTriangle found = tree_.closest(surface_.point[v], hint);
        vertex[v] = std::sqrt(found.distance2), vertex_nearest_[v] = hint = found.triangle;
      }
    });
  }

  void add_up() {
    mean.assign(area.size(), 0), rms.assign(area.size(), 0), max.assign(area.size(), 0);
    face_nearest_.assign(area.size(), kNone);
    struct Sums {
      Real mean = 0, square = 0;
    };
    const Sums sums = reduce(
        work_, Cost::medium, order_.size(), Sums{},
        [&](std::size_t begin, std::size_t end) {
          Sums block;
          for (std::size_t r = begin; r < end; ++r) {
            const Index f = order_[r];
            Sums face;
            Real most = -1;
            for (std::uint64_t s = first_[r]; s < first_[r + 1]; ++s) {
              const Real d = sample_distance_[s];
              face.mean += d, face.square += d * d;
              if (d > most) most = d, face_nearest_[f] = sample_nearest_[s];
            }
            for (std::size_t i = 0; i < 3; ++i) most = std::max(most, vertex[surface_.corner[3 * std::size_t{f} + i]]);
            max[f] = most;
            if (first_[r] == first_[r + 1]) continue;
            const Real count = static_cast<Real>(first_[r + 1] - first_[r]);
            mean[f] = face.mean / count, rms[f] = std::sqrt(face.square / count);
            block.mean += area[f] * (face.mean / count), block.square += area[f] * (face.square / count);
          }
          return block;
        },
        [](const Sums& a, const Sums& b) {
          return Sums{a.mean + b.mean, a.square + b.square};
        });
    total.mean = sums.mean / total.area, total.rms = std::sqrt(sums.square / total.area);
  }

  void find_farthest() {
    const std::size_t worst = reduce(
        work_, Cost::light, order_.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
          std::size_t best = begin;
          for (std::size_t r = begin; r < end; ++r)
            if (max[order_[r]] > max[order_[best]]) best = r;
          return best;
        },
        [&](std::size_t a, std::size_t b) { return max[order_[b]] > max[order_[a]] ? b : a; });
    const Index f = order_[worst];
    Farthest found{max[f], 0, Vec3::Zero(), f};
    for (std::size_t i = 3; i-- > 0;)
      if (const Index v = surface_.corner[3 * std::size_t{f} + i]; vertex[v] == max[f]) found.point = surface_.point[v];
    for (std::uint64_t s = first_[worst + 1]; s-- > first_[worst];)
      if (sample_distance_[s] == max[f]) found.point = sample_point(surface_, f, s - first_[worst]);
    FarthestOptions farthest;
    farthest.tolerance = options_.tolerance;
    farthest.splits = static_cast<Index>(std::max<std::uint64_t>(4096, total.samples / 16));
    const KnownDistances known{vertex, vertex_nearest_, face_nearest_};
    found = farthest_point(work_, surface_, known, other_, tree_, found, farthest);
    total.max = found.distance, total.bound = found.bound;
    total.worst = found.point, total.worst_triangle = found.triangle;
    max[found.triangle] = std::max(max[found.triangle], found.distance);
  }

  const Work& work_;
  const TrianglesView& surface_;
  std::span<const Index> order_;
  const TrianglesView& other_;
  const TriangleTree& tree_;
  const DistanceOptions& options_;
  std::vector<std::uint64_t> first_;  // rank -> its first sample
  std::vector<Real> sample_distance_;
  std::vector<Index> sample_nearest_, vertex_nearest_, face_nearest_;
};

}  // namespace

SurfaceDistance surface_distance(const Work& work, const TrianglesView& a, const TriangleTree& a_tree,
                                 const TrianglesView& b, const TriangleTree& b_tree, const DistanceOptions& options) {
  SurfaceDistance result;
  {
    Side side(work, b, b_tree.order(), a, a_tree, options);
    side.measure();
    result.backward = side.total;
    if (options.per_sample) result.backward_sample = side.samples();
  }
  Side side(work, a, a_tree.order(), b, b_tree, options);
  side.measure();
  result.forward = side.total;
  if (options.per_sample) result.forward_sample = side.samples();
  result.face_area = std::move(side.area), result.face_mean = std::move(side.mean);
  result.face_rms = std::move(side.rms), result.face_max = std::move(side.max);
  result.vertex_distance = std::move(side.vertex);
  return result;
}

SurfaceDistance surface_distance(const Work& work, const TrianglesView& a, const TrianglesView& b,
                                 const DistanceOptions& options) {
  std::optional<TriangleTree> a_tree, b_tree;
  in_parallel([&] { a_tree.emplace(work, a); }, [&] { b_tree.emplace(work, b); });
  return surface_distance(work, a, *a_tree, b, *b_tree, options);
}

std::vector<PartDistance> distance_per_label(const SurfaceDistance& distance, std::span<const Index> label,
                                             Index labels) {
  std::vector<PartDistance> part(labels);
  for (std::size_t f = 0; f < label.size(); ++f) {
    if (label[f] == kNone) continue;
    PartDistance& p = part[label[f]];
    const Real area = distance.face_area[f];
    p.area += area, p.mean += area * distance.face_mean[f];
    p.rms += area * distance.face_rms[f] * distance.face_rms[f];
    p.max = std::max(p.max, distance.face_max[f]);
  }
  for (PartDistance& p : part)
    if (p.area > 0) p.mean /= p.area, p.rms = std::sqrt(p.rms / p.area);
  return part;
}

}  // namespace intarsia::kernels
