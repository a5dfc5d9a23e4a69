#include "kernels/patches/reach_count.h"

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>

#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"

namespace intarsia::kernels {
namespace {

class Halving {
 public:
  Halving(const Work& work, const PatchSurface& s, const PatchLabels& labels, const ReachOptions& options)
      : work_(work),
        s_(s),
        options_(options),
        regions_(labels),
        normal_(smooth_normals(work, s, labels.patch_of_face, options.split.smoothing)),
        faces_(labels.count) {
    const Csr rows = faces_of_patches(labels);
    for (Index p = 0; p < labels.count; ++p) {
      faces_[p].assign(rows.row(p).begin(), rows.row(p).end());
      push(p);
    }
  }

  // Returns false if no patch can be divided any more.
  bool divide_worst() {
    while (!queue_.empty()) {
      const Index p = std::get<2>(queue_.top());
      queue_.pop();
      if (!halve(p)) continue;
      const Index q = static_cast<Index>(faces_.size());
      std::vector<Index> kept, moved;
      for (const Index f : faces_[p]) (regions_.label[f] == 0 ? kept : moved).push_back(f);
      for (const Index f : moved) regions_.source[f] = q, regions_.label[f] = 0;
      faces_[p].swap(kept);
      faces_.push_back(std::move(moved));
      push(p), push(q);
      return true;
    }
    return false;
  }

  PatchLabels labels() const { return compact_labels(work_, regions_.source, static_cast<Index>(faces_.size())); }

 private:
  struct Shape {
    Real area = 0, energy = 0;
  };
  Shape measure(std::span<const Index> faces) const {
    Shape shape;
    Vec3 sum = Vec3::Zero();
    for (const Index f : faces) shape.area += s_.area[f], sum += s_.area[f] * s_.normal[f];
    shape.energy = 2 * std::max(Real{0}, shape.area - sum.norm());
    return shape;
  }
  void push(Index p) {
    constexpr Real kFlatWorth = 1e-4;  // lets area decide among flat patches
    if (faces_[p].size() < 2 || s_.is_locked(faces_[p][0])) return;
    const Shape shape = measure(faces_[p]);
    queue_.push({shape.energy + kFlatWorth * shape.area, shape.area, p});
  }
  void restore(Index p) {
    for (const Index f : faces_[p]) regions_.label[f] = 0;
  }

  // Two parts, both of some size and, if asked for, both discs?
  bool is_good(Index p, Real least_share) const {
    std::array<std::vector<Index>, 2> part;
    for (const Index f : faces_[p]) part[std::min<Index>(1, regions_.label[f])].push_back(f);
    if (part[0].empty() || part[1].empty()) return false;
    const Real a = measure(part[0]).area, b = measure(part[1]).area;
    if (std::min(a, b) < least_share * (a + b)) return false;
    for (Index l = 0; options_.discs && l < 2; ++l)
      if (euler_of_region(s_, {p, l, part[l]}, regions_) != 1) return false;
    return true;
  }

  bool halve(Index p) {
    const Shape shape = measure(faces_[p]);
    const Region region{p, 0, faces_[p]};
    if (shape.energy > options_.flat * shape.area) {
      if (approximate_region(work_, s_, normal_, region, 2, options_.split, regions_) == 2 && is_good(p, 0.05))
        return true;
      restore(p);
    }
    divide_region(work_, s_, region, 2, 1, options_.relax, regions_);
    if (is_good(p, 0)) return true;
    restore(p);
    if (peel(p)) return true;
    restore(p);
    return false;
  }

  // Does f touch the faces of a label in one arc? Then it can leave label 0, or join label 1, and a disc stays a disc.
  bool meets_in_arc(Index f, Index p, Index label) const {
    int edges = 0, vertices = 0;
    for (int i = 0; i < 3; ++i) {
      const Index g = s_.neighbour(f, i);
      if (g != kNone && regions_.is_in(g, p, label)) ++edges;
      const auto star = s_.mesh.vertex_faces.row(s_.mesh.corner[3 * f + i]);
      if (std::any_of(star.begin(), star.end(), [&](Index x) { return x != f && regions_.is_in(x, p, label); }))
        ++vertices;
    }
    if (edges == 0 || vertices - edges != 1) return false;
    return edges == 1 || label == 1 || stays_joined(s_.mesh, f, [&](Index g) { return regions_.is_in(g, p, label); });
  }

  // Takes faces off the rim of a disc one by one, nearest to the first one first, until half of the area is gone. Both
  // sides stay discs at every step, so this works where division by normals or distance does not.
  bool peel(Index p) {
    const auto& faces = faces_[p];
    const auto start =
        std::find_if(faces.begin(), faces.end(), [&](Index f) { return !s_.beside_hole[f] && meets_in_arc(f, p, 0); });
    if (start == faces.end()) return false;
    const Vec3 centre = s_.centroid(*start);
    using Entry = std::pair<Real, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    Real taken = 0;
    const Real half = measure(faces).area / 2;
    const auto take = [&](Index f) {
      regions_.label[f] = 1;
      taken += s_.area[f];
      for (int i = 0; i < 3; ++i)
        for (const Index g : s_.mesh.vertex_faces.row(s_.mesh.corner[3 * f + i]))
          if (regions_.is_in(g, p, 0)) queue.push({(s_.centroid(g) - centre).squaredNorm(), g});
    };
    take(*start);
    for (Index step = 0; !queue.empty() && taken < half; ++step) {
      if (step % 1024 == 0) work_.check();
      const Index f = queue.top().second;
      queue.pop();
      if (!regions_.is_in(f, p, 0) || s_.beside_hole[f]) continue;
      if (meets_in_arc(f, p, 0) && meets_in_arc(f, p, 1)) take(f);
    }
    return is_good(p, 0);
  }

  const Work& work_;
  const PatchSurface& s_;
  const ReachOptions& options_;
  Regions regions_;
  SmoothNormals normal_;
  std::vector<std::vector<Index>> faces_;
  std::priority_queue<std::tuple<Real, Real, Index>> queue_;
};

}  // namespace

ReachedCount reach_count(const Work& work, const PatchSurface& s, const PatchLabels& labels, Index target,
                         const ReachOptions& options) {
  ReachedCount result{labels, {}};
  const std::vector<Index> zero(s.mesh.face_count(), 0);
  const Index components = flood_equal(work, s.mesh, zero).count;
  if (target < components)
    result.reason = "the surface has " + std::to_string(components) + " components, each needs a patch";
  else if (target > s.mesh.face_count())
    result.reason = "there are only " + std::to_string(s.mesh.face_count()) + " faces";
  if (labels.count > target) {
    PatchGraph graph(work, s, labels);
    merge_cheapest(
        work, options.merge, target,
        [&](Index p, const Border& b) {
          if (!options.discs) return true;
          const int euler = graph.union_euler(p, b);
          return euler == 1 || std::abs(1 - euler) < std::max(graph[p].defect(), graph[b.other].defect());
        },
        graph);
    result.labels = graph.labels(work, labels);
    if (graph.alive() > target && result.reason.empty())
      result.reason = "no two neighbouring patches can be joined to a disc below this number";
  } else if (labels.count < target) {
    Halving halving(work, s, labels, options);
    for (Index n = labels.count; n < target; ++n)
      if (!halving.divide_worst()) {
        if (result.reason.empty()) result.reason = "no patch can be divided further";
        break;
      }
    result.labels = halving.labels();
  }
  return result;
}

}  // namespace intarsia::kernels
