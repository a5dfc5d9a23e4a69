#include "kernels/patches/region_graph.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace intarsia::kernels {
namespace {

constexpr Real kBallTurn = 0.8;  // cosine

// Balls of faces in breadth-first order, started at the lowest face left over.
Index gather_balls(const Work& work, const PatchSurface& s, const Region& region, Index node_size,
                   const Regions& regions, std::vector<Index>& node_of_face) {
  node_of_face.assign(region.faces.size(), kNone);
  std::vector<Index> ball;
  Index nodes = 0;
  for (std::size_t start = 0; start < region.faces.size(); ++start) {
    if (start % 4096 == 0) work.check();
    if (node_of_face[start] != kNone) continue;
    ball.assign(1, region.faces[start]);
    node_of_face[start] = nodes;
    const Vec3 n = s.normal[ball[0]];
    for (std::size_t i = 0; i < ball.size() && ball.size() < node_size; ++i)
      for (int k = 0; k < 3 && ball.size() < node_size; ++k) {
        const Index g = s.neighbour(ball[i], k);
        if (g == kNone || !regions.is_in(g, region.source, region.label)) continue;
        if (node_of_face[regions.position[g]] != kNone) continue;
        if (s.area[g] > 0 && n.dot(s.normal[g]) < kBallTurn) continue;
        node_of_face[regions.position[g]] = nodes;
        ball.push_back(g);
      }
    ++nodes;
  }
  return nodes;
}

void link_nodes(const PatchSurface& s, const Region& region, const Regions& regions, RegionGraph& g) {
  std::vector<std::uint64_t> link;
  link.reserve(region.faces.size() * (g.is_faces ? 3 : 1));
  for (std::size_t i = 0; i < region.faces.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Index o = s.neighbour(region.faces[i], k);
      if (o == kNone || !regions.is_in(o, region.source, region.label)) continue;
      const Index a = g.node_of_face[i], b = g.node_of_face[regions.position[o]];
      if (a != b) link.push_back(std::uint64_t{a} << 32 | b);
    }
  if (!g.is_faces) {
    std::sort(link.begin(), link.end());
    link.erase(std::unique(link.begin(), link.end()), link.end());
  }
  g.offset.assign(std::size_t{g.nodes()} + 1, 0);
  g.other.resize(link.size());
  for (std::size_t i = 0; i < link.size(); ++i) {
    ++g.offset[(link[i] >> 32) + 1];
    g.other[i] = static_cast<Index>(link[i]);
  }
  for (Index n = 0; n < g.nodes(); ++n) {
    g.offset[n + 1] += g.offset[n];
    if (g.is_faces) std::sort(g.other.begin() + g.offset[n], g.other.begin() + g.offset[n + 1]);
  }
}

Real step_length(const RegionGraph& g, Index a, Index b) {
  const Real turn = (g.mean_normal[a] - g.mean_normal[b]).squaredNorm();
  return (g.centroid[a] - g.centroid[b]).norm() * (1 + std::min(Real{2}, 2 * turn));
}

// Takes over every node that is nearer to the new seed than to those before it.
void spread(const Work& work, const RegionGraph& g, Index seed, Index label, std::vector<Real>& distance,
            std::vector<Index>& labels) {
  using Entry = std::pair<Real, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[seed] = 0, labels[seed] = label;
  queue.push({0, seed});
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto [d, n] = queue.top();
    queue.pop();
    if (d > distance[n] || labels[n] != label) continue;
    for (const Index o : g.row(n)) {
      const Real reached = d + step_length(g, n, o);
      if (reached < distance[o]) {
        distance[o] = reached, labels[o] = label;
        queue.push({reached, o});
      }
    }
  }
}

}  // namespace

Index node_size_for(std::size_t faces) {
  if (faces <= 4096) return 1;
  const std::size_t wanted = std::max<std::size_t>(1500, faces / 150);
  return static_cast<Index>(std::max<std::size_t>(4, faces / wanted));
}

RegionGraph make_region_graph(const Work& work, const PatchSurface& s, const Region& region, Index node_size,
                              const FaceVectors& normal, Regions& regions) {
  RegionGraph g;
  const std::size_t n = region.faces.size();
  for (std::size_t i = 0; i < n; ++i) regions.position[region.faces[i]] = static_cast<Index>(i);
  Index nodes = static_cast<Index>(n);
  g.is_faces = node_size <= 1;
  if (g.is_faces) {
    g.node_of_face.resize(n);
    for (std::size_t i = 0; i < n; ++i) g.node_of_face[i] = static_cast<Index>(i);
  } else {
    nodes = gather_balls(work, s, region, node_size, regions, g.node_of_face);
  }
  g.area.assign(nodes, 0);
  g.normal_sum.resize(nodes), g.mean_normal.resize(nodes), g.centroid.resize(nodes);
  std::vector<Index> count(nodes, 0);
  Vec3Array plain(nodes);  // centroid of faces without area
  for (std::size_t i = 0; i < n; ++i) {
    const Index f = region.faces[i], node = g.node_of_face[i];
    const Vec3 c = s.centroid(f);
    g.area[node] += s.area[f];
    g.normal_sum.set(node, g.normal_sum[node] + s.area[f] * s.normal[f]);
    g.mean_normal.set(node, g.mean_normal[node] + s.area[f] * normal[f]);
    g.centroid.set(node, g.centroid[node] + s.area[f] * c);
    plain.set(node, plain[node] + c);
    ++count[node];
  }
  for (Index i = 0; i < nodes; ++i) {
    if (g.area[i] > 0) g.mean_normal.set(i, g.mean_normal[i] / g.area[i]);
    g.centroid.set(i, g.area[i] > 0 ? Vec3(g.centroid[i] / g.area[i]) : Vec3(plain[i] / count[i]));
  }
  link_nodes(s, region, regions, g);
  return g;
}

FarSeeds farthest_seeds(const Work& work, const RegionGraph& g, Index k) {
  constexpr Real kFar = std::numeric_limits<Real>::infinity();
  FarSeeds far;
  std::vector<Real> distance(g.nodes(), kFar);
  far.label.assign(g.nodes(), kNone);
  const auto farthest = [&] {  // ties: smaller id; unreached nodes first
    return static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  };
  spread(work, g, 0, 0, distance, far.label);
  const Index first = farthest();
  std::fill(distance.begin(), distance.end(), kFar);
  for (Index label = 0, seed = first; label < std::min(k, g.nodes()); ++label, seed = farthest()) {
    if (distance[seed] == 0) break;
    far.seed.push_back(seed);
    spread(work, g, seed, label, distance, far.label);
  }
  return far;
}

std::vector<Index> nearest_seed(const Work& work, const RegionGraph& g, std::span<const Index> seed) {
  using Entry = std::tuple<Real, Index, Index>;  // distance, label, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<Index> label(g.nodes(), kNone);
  std::vector<Real> best(g.nodes(), std::numeric_limits<Real>::infinity());
  for (Index i = 0; i < seed.size(); ++i) queue.push({0, i, seed[i]});
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto [d, l, n] = queue.top();
    queue.pop();
    if (label[n] != kNone) continue;
    label[n] = l;
    for (const Index o : g.row(n)) {
      if (label[o] != kNone) continue;
      const Real reached = d + step_length(g, n, o);
      if (reached <= best[o]) {
        best[o] = reached;
        queue.push({reached, l, o});
      }
    }
  }
  return label;
}

}  // namespace intarsia::kernels
