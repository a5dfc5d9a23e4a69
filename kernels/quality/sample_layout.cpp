#include "kernels/quality/sample_layout.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

// Segments per arc.
std::vector<Index> segment_counts(const LayoutGraph& graph, const SampleOptions& options) {
  const Index arcs = graph.arc_count();
  std::vector<Real> border(graph.patch_count(), 0);
  for (Index a = 0; a < arcs; ++a)
    for (const Index p : {graph.left[a], graph.right[a]})
      if (p != kNone) border[p] += graph.length[a];
  std::vector<Index> count(arcs, 1);
  const Real samples = std::max<Real>(3, options.loop_samples);
  for (Index a = 0; a < arcs; ++a) {
    Real step = 0;
    for (const Index p : {graph.left[a], graph.right[a]})
      if (p != kNone) step = std::max(step, border[p] / samples);
    const Real wanted = step > 0 ? std::min(graph.length[a] / step, samples) : 1;
    count[a] = std::max(Index{1}, static_cast<Index>(std::lround(wanted)));
    if (graph.is_closed(a)) count[a] = std::max({count[a], Index{3}, options.least_closed});
  }
  // Arcs between the same two nodes.
  std::vector<Index> order(arcs);
  for (Index a = 0; a < arcs; ++a) order[a] = a;
  const auto ends = [&](Index a) {
    return std::pair(std::min(graph.start[a], graph.end[a]), std::max(graph.start[a], graph.end[a]));
  };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::pair(ends(a), a) < std::pair(ends(b), b); });
  for (Index i = 0; i + 1 < arcs; ++i)
    if (ends(order[i]) == ends(order[i + 1]))
      for (const Index a : {order[i], order[i + 1]}) count[a] = std::max(count[a], Index{2});
  return count;
}

// Twice the area long.
Vec3 face_normal(const MeshView& mesh, Index f) {
  const auto [a, b, c] = mesh.face(f);
  return (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a));
}

Vec3 unit_or_zero(const Vec3& v) {
  const Real length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(Vec3::Zero());
}

// Area-weighted sum of the normals on the side of patch p around border vertex v. Where the border is a rounded ridge,
// the second ring knows better how the patch leaves it than the ridge's own normal does.
Vec3 side_normal(const MeshView& mesh, std::span<const Index> label, const std::vector<std::uint8_t>& on_border,
                 Index v, Index p) {
  Vec3 near = Vec3::Zero(), far = Vec3::Zero();
  for (const Index f : mesh.vertex_faces.row(v)) {
    if (label[f] != p) continue;
    near += face_normal(mesh, f);
    for (const Index w : mesh.face(f)) {
      if (on_border[w]) continue;
      for (const Index g : mesh.vertex_faces.row(w)) {
        if (label[g] != p) continue;
        const auto [a, b, c] = mesh.face(g);
        if (!on_border[a] && !on_border[b] && !on_border[c]) far += face_normal(mesh, g);
      }
    }
  }
  return far.squaredNorm() > 0 ? far : near;
}

class ArcSampler {
 public:
  ArcSampler(const MeshView& mesh, const LayoutGraph& graph, std::span<const Index> label,
             const std::vector<std::uint8_t>& on_border, const SampleOptions& options, SampledLayout& out)
      : mesh_(mesh), graph_(graph), label_(label), on_border_(on_border), options_(options), out_(out) {}

  void sample(Index a) {
    const auto vertex = graph_.arc.row(a);
    const auto point = out_.arc.row(a);
    const std::size_t segments = point.size() - 1;
    along_.assign(1, 0);
    for (std::size_t i = 1; i < vertex.size(); ++i)
      along_.push_back(along_.back() + (mesh_.point(vertex[i]) - mesh_.point(vertex[i - 1])).norm());
    const Real length = along_.back();
    std::size_t i = 1;
    for (std::size_t s = 1; s < segments; ++s) {
      const Real at = length * static_cast<Real>(s) / static_cast<Real>(segments);
      while (i + 1 < vertex.size() && along_[i] < at) ++i;
      const Real step = along_[i] - along_[i - 1];
      const Real t = step > 0 ? std::clamp((at - along_[i - 1]) / step, Real(0), Real(1)) : 0;
      out_.point.set(point[s], (1 - t) * mesh_.point(vertex[i - 1]) + t * mesh_.point(vertex[i]));
    }
    for (const int side : {0, 1}) {
      const Index patch = side == 0 ? graph_.left[a] : graph_.right[a];
      if (patch != kNone) side_normals(a, patch, out_.normal[side]);
    }
  }

 private:
  // Vertex normals gathered by hats of one step around every sample, then smoothed along the arc.
  void side_normals(Index a, Index patch, Vec3Array& out) {
    const auto vertex = graph_.arc.row(a);
    const auto point = out_.arc.row(a);
    const std::size_t segments = point.size() - 1;
    if (segments < 2) return;
    const Real step = along_.back() / static_cast<Real>(segments);
    sum_.assign(segments + 1, Vec3::Zero());
    std::vector<Real>& weight = weight_;
    weight.assign(segments + 1, 0);
    for (std::size_t i = 1; i + 1 < vertex.size(); ++i) {
      const Vec3 n = unit_or_zero(side_normal(mesh_, label_, on_border_, vertex[i], patch));
      const Real at = step > 0 ? along_[i] / step : 0;
      const std::size_t s = std::min(static_cast<std::size_t>(at), segments - 1);
      const Real t = std::clamp(at - static_cast<Real>(s), Real(0), Real(1));
      const Real stretch = along_[i + 1] - along_[i - 1];  // of the arc that this vertex stands for
      sum_[s] += (1 - t) * stretch * n, sum_[s + 1] += t * stretch * n;
      weight[s] += (1 - t) * stretch, weight[s + 1] += t * stretch;
    }
    if (vertex.size() == 2) {  // one edge: the face beside it is all there is
      for (const Index f : {mesh_.edge_f0[graph_.arc_edges.row(a)[0]], mesh_.edge_f1[graph_.arc_edges.row(a)[0]]})
        if (f != kNone && label_[f] == patch)
          for (std::size_t s = 0; s <= segments; ++s) sum_[s] += face_normal(mesh_, f), weight[s] = 1;
    }
    // Where the arc has no vertex of its own near a sample: from its neighbours.
    for (std::size_t s = 0; s <= segments; ++s) sum_[s] = unit_or_zero(sum_[s]);
    for (std::size_t s = 1; s <= segments; ++s)
      if (weight[s] == 0) sum_[s] = sum_[s - 1];
    for (std::size_t s = segments; s-- > 0;)
      if (sum_[s].squaredNorm() == 0) sum_[s] = sum_[s + 1];
    for (int pass = 0; pass < options_.normal_passes; ++pass) {
      next_ = sum_;
      for (std::size_t s = 1; s < segments; ++s) next_[s] = unit_or_zero(sum_[s - 1] + 2 * sum_[s] + sum_[s + 1]);
      sum_.swap(next_);
    }
    for (std::size_t s = 1; s < segments; ++s) out.set(point[s], sum_[s]);
  }

  const MeshView& mesh_;
  const LayoutGraph& graph_;
  std::span<const Index> label_;
  const std::vector<std::uint8_t>& on_border_;
  const SampleOptions& options_;
  SampledLayout& out_;
  std::vector<Real> along_, weight_;
  std::vector<Vec3> sum_, next_;
};

}  // namespace

SampledLayout sample_layout(const Work& work, const MeshView& mesh, const LayoutGraph& graph,
                            std::span<const Index> label, const SampleOptions& options) {
  SampledLayout out;
  out.loop = graph.loop, out.loop_patch = graph.loop_patch, out.patch_loops = graph.patch_loops;
  out.nodes = graph.node_count();
  const std::vector<Index> count = segment_counts(graph, options);

  Index next = graph.node_count();
  out.arc.offset.push_back(0);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    out.arc.item.push_back(graph.start[a]);
    for (Index s = 1; s < count[a]; ++s) out.arc.item.push_back(next++);
    out.arc.item.push_back(graph.end[a]);
    out.arc.offset.push_back(static_cast<Index>(out.arc.item.size()));
  }
  out.point.resize(next), out.normal[0].resize(next), out.normal[1].resize(next);
  for (Index n = 0; n < graph.node_count(); ++n) out.point.set(n, mesh.point(graph.node[n]));

  std::vector<std::uint8_t> on_border(mesh.vertex_count(), 0);
  for (const Index v : graph.arc.item) on_border[v] = 1;
  for_each_block(work, Cost::single, graph.arc_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    ArcSampler sampler(mesh, graph, label, on_border, options, out);
    for (std::size_t a = begin; a < end; ++a) sampler.sample(static_cast<Index>(a));
  });
  return out;
}

void append_loop(const SampledLayout& layout, Index loop, LoopPoints& out) {
  if (out.side.empty()) out.side.push_back(static_cast<Index>(out.point.size()));
  for (const Index h : layout.loop.row(loop)) {
    const auto row = layout.arc.row(h / 2);
    if (h % 2 == 0)
      out.point.insert(out.point.end(), row.begin(), row.end() - 1);
    else
      out.point.insert(out.point.end(), row.rbegin(), row.rend() - 1);
    out.side.push_back(static_cast<Index>(out.point.size()));
  }
}

}  // namespace intarsia::kernels
