#include "kernels/curves/turn_angle.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "kernels/curves/normal_graph.h"

namespace intarsia::kernels {

namespace {

// The nodes reached by one walk: a set with generation stamps, so that starting over costs nothing.
class SeenNodes {
 public:
  SeenNodes() : slot_(1024) {}
  void clear() {
    ++generation_;
    count_ = 0;
  }
  // True if n was not there.
  bool insert(Index n) {
    if (2 * count_ >= slot_.size()) grow();
    Slot& s = slot_[find(n)];
    if (s.generation == generation_) return false;
    s = {n, generation_};
    ++count_;
    return true;
  }

 private:
  struct Slot {
    Index node = 0;
    std::uint32_t generation = 0;
  };
  std::size_t find(Index n) const {
    const std::size_t mask = slot_.size() - 1;
    std::size_t i = (n * std::size_t{0x9e3779b1u}) >> 7 & mask;
    while (slot_[i].generation == generation_ && slot_[i].node != n) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    std::vector<Slot> old(2 * slot_.size());
    old.swap(slot_);
    for (const Slot& s : old)
      if (s.generation == generation_) slot_[find(s.node)] = s;
  }

  std::vector<Slot> slot_;
  std::size_t count_ = 0;
  std::uint32_t generation_ = 1;
};

struct Frame {
  Vec3 p, normal, across;
  Real radius;
};

Real turn_at(const NormalGraph& graph, const CsrView& neighbours, std::span<const std::uint8_t> barrier,
             const TurnOptions& options, const Frame& f, std::span<const Index> start, SeenNodes& seen,
             std::vector<Index>& queue) {
  const Vec3 along = f.normal.cross(f.across);
  const Real reach2 = f.radius * f.radius;
  const Real min2 = options.min_side * options.min_side * reach2, max_along = options.max_along * f.radius;
  Vec3 side[2] = {Vec3::Zero(), Vec3::Zero()};
  seen.clear();
  queue.clear();
  for (Index n : start)
    if (seen.insert(n)) queue.push_back(n);
  const std::size_t first = queue.size();
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Index n = queue[head];
    if (barrier[n] && head >= first) continue;
    const Vec3 x = graph.point[n] - f.p;
    const Real d2 = x.squaredNorm();
    if (d2 > reach2 && head >= first) continue;  // the nodes next to the point always count
    const Real s = x.dot(f.across), u = x.dot(along);
    // Distance from the tangent, not along `across`: on both flanks of a narrow fold `across` alone stays small.
    if (std::abs(u) < max_along && d2 - u * u > min2) side[s > 0] += graph.normal[n];
    for (Index m : neighbours.row(n))
      if (seen.insert(m)) queue.push_back(m);
  }
  Vec3 unit[2];
  for (int i = 0; i < 2; ++i) {
    const Real length = side[i].norm();
    unit[i] = length > 0 ? Vec3(side[i] / length) : f.normal;
  }
  return std::atan2(unit[0].cross(unit[1]).norm(), unit[0].dot(unit[1]));
}

}  // namespace

void turn_angles(const Work& work, const MeshView& mesh, Real edge_length, const TurnOptions& options,
                 FeatureCurves& curves) {
  const Real rho = std::max(options.radius, options.radius_in_edges * edge_length);
  const auto radius_at = [&](Index p) {
    return options.follow_fit ? std::clamp(curves.radius[p], rho, std::max(rho, options.largest_radius)) : rho;
  };
  const auto& item = curves.net.curve.item;
  const auto& offset = curves.net.curve.offset;

  // Where to measure: both ends of a curve, and points about sample_step apart between them.
  std::vector<Real> way(item.size(), 0);  // arc length from the start of the curve
  for_each(work, Cost::heavy, curves.curve_count(), [&](std::size_t c) {
    if (curves.net.kind[c] == CurveKind::sharp) return;
    for (Index i = offset[c] + 1; i < offset[c + 1]; ++i)
      way[i] = way[i - 1] +
               (position(mesh, curves.net.point[item[i]]) - position(mesh, curves.net.point[item[i - 1]])).norm();
  });
  std::vector<Index> sample;
  for (Index c = 0; c < curves.curve_count(); ++c) {
    if (curves.net.kind[c] == CurveKind::sharp) continue;
    Index last = offset[c];
    for (Index i = offset[c]; i < offset[c + 1]; ++i)
      if (i == offset[c] || i + 1 == offset[c + 1] ||
          way[i + 1] - way[last] > options.sample_step * radius_at(item[last]))
        sample.push_back(last = i);
  }
  if (sample.empty()) return;

  std::vector<std::uint8_t> on_sharp(mesh.vertex_count(), 0);
  for (Index c = 0; c < curves.curve_count(); ++c)
    if (curves.net.kind[c] == CurveKind::sharp)
      for (Index p : curves.points_of(c)) on_sharp[curves.net.point[p].element] = 1;

  const bool gather = edge_length < 0.8 * options.finest * rho;
  const NormalGraph graph = normal_graph(work, mesh, on_sharp, gather ? options.finest * rho : 0);
  std::vector<std::uint8_t> barrier(graph.point.size(), 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (on_sharp[v]) barrier[graph.node(v)] = 1;
  const CsrView neighbours = gather ? CsrView(graph.neighbours) : mesh.vertex_vertices;
  std::vector<Real> measured(sample.size());
  for_each_block(work, Cost::heavy, sample.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    SeenNodes seen;
    std::vector<Index> queue;
    for (std::size_t k = begin; k < end; ++k) {
      const Index p = item[sample[k]];
      const SurfacePoint& at = curves.net.point[p];
      Index start[3], n = 0;
      if (at.kind == PointKind::vertex) start[n++] = graph.node(at.element);
      if (at.kind == PointKind::edge)
        for (Index v : {mesh.edge_v0[at.element], mesh.edge_v1[at.element]}) start[n++] = graph.node(v);
      if (at.kind == PointKind::face)
        for (Index v : mesh.face(at.element)) start[n++] = graph.node(v);
      const Frame frame{position(mesh, at), curves.normal[p], curves.across[p], radius_at(p)};
      measured[k] = turn_at(graph, neighbours, barrier, options, frame, {start, n}, seen, queue);
    }
  });

  // Serial, because curves share points; the later curve decides, and it is the same one in every run.
  for (std::size_t k = 0; k + 1 < sample.size(); ++k) {
    const Index i0 = sample[k], i1 = sample[k + 1];
    curves.turn()[item[i0]] = measured[k];
    curves.turn()[item[i1]] = measured[k + 1];
    if (way[i1] == 0 || way[i1] <= way[i0]) continue;  // the next curve begins
    for (Index i = i0 + 1; i < i1; ++i) {
      const Real w = (way[i] - way[i0]) / (way[i1] - way[i0]);
      curves.turn()[item[i]] = (1 - w) * measured[k] + w * measured[k + 1];
    }
  }
}

}  // namespace intarsia::kernels
