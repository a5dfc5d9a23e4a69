#include "kernels/patches/region_graph.h"

#include <algorithm>
#include <limits>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/scan.h"
#include "kernels/patches/least_first.h"

namespace intarsia::kernels {
namespace {

constexpr Real kBallTurn = 0.8;  // cosine

// Ranks of the faces across the three edges of each face of the region; kNone outside.
std::vector<Index> rank_neighbours(const Work& work, const PatchSurface& s, const Region& region,
                                   const Regions& regions) {
  std::vector<Index> near(3 * region.faces.size());
  for_each(work, Cost::light, region.faces.size(), [&](std::size_t i) {
    for (int k = 0; k < 3; ++k) {
      const Index g = s.neighbour(region.faces[i], k);
      near[3 * i + static_cast<std::size_t>(k)] =
          g != kNone && regions.is_in(g, region.source, region.label) ? regions.position[g] : kNone;
    }
  });
  return near;
}

// Balls of faces in breadth-first order, started at the lowest face left over.
Index gather_balls(const Work& work, const PatchSurface& s, const Region& region, Index node_size,
                   std::span<const Index> near, std::vector<Index>& node_of_face) {
  node_of_face.assign(region.faces.size(), kNone);
  std::vector<Index> ball;
  Index nodes = 0;
  for (std::size_t start = 0; start < region.faces.size(); ++start) {
    if (start % 4096 == 0) work.check();
    if (node_of_face[start] != kNone) continue;
    ball.assign(1, static_cast<Index>(start));
    node_of_face[start] = nodes;
    const Vec3 n = s.normal[region.faces[start]];
    for (std::size_t i = 0; i < ball.size() && ball.size() < node_size; ++i)
      for (std::size_t k = 0; k < 3 && ball.size() < node_size; ++k) {
        const Index g = near[3 * std::size_t{ball[i]} + k];
        if (g == kNone || node_of_face[g] != kNone) continue;
        const Index f = region.faces[g];
        if (s.area[f] > 0 && n.dot(s.normal[f]) < kBallTurn) continue;
        node_of_face[g] = nodes;
        ball.push_back(g);
      }
    ++nodes;
  }
  return nodes;
}

// The graph of the faces themselves: rows ascending.
void link_faces(const Work& work, std::span<const Index> near, RegionGraph& g) {
  const std::size_t n = near.size() / 3;
  g.offset.assign(n + 1, 0);
  for_each(work, Cost::light, n, [&](std::size_t i) {
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) g.offset[i] += near[k] != kNone ? 1 : 0;
  });
  g.other.resize(exclusive_scan<Index>(work, g.offset));
  for_each(work, Cost::light, n, [&](std::size_t i) {
    Index at = g.offset[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      if (near[k] != kNone) g.other[at++] = near[k];
    std::sort(g.other.begin() + g.offset[i], g.other.begin() + at);
  });
}

// The graph of the balls: rows ascending, each neighbour once.
void link_nodes(const Work& work, std::span<const Index> near, const Csr& faces_of_node, RegionGraph& g) {
  g.offset.assign(std::size_t{g.nodes()} + 1, 0);
  std::vector<std::vector<Index>> found(block_count(Cost::heavy, g.nodes()));
  for_each_block(work, Cost::heavy, g.nodes(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    std::vector<Index> row;
    for (std::size_t node = begin; node < end; ++node) {
      row.clear();
      for (const Index i : faces_of_node.row(static_cast<Index>(node)))
        for (std::size_t k = 3 * std::size_t{i}; k < 3 * std::size_t{i} + 3; ++k)
          if (near[k] != kNone && g.node_of_face[near[k]] != node) row.push_back(g.node_of_face[near[k]]);
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      g.offset[node] = static_cast<Index>(row.size());
      found[b].insert(found[b].end(), row.begin(), row.end());
    }
  });
  g.other.resize(exclusive_scan<Index>(work, g.offset));
  for_each_block(work, Cost::heavy, g.nodes(), [&](std::size_t begin, std::size_t, std::size_t b) {
    std::copy(found[b].begin(), found[b].end(), g.other.begin() + g.offset[begin]);
  });
}

Real step_length(const RegionGraph& g, Index a, Index b) {
  const Real turn = (g.mean_normal[a] - g.mean_normal[b]).squaredNorm();
  return (g.centroid[a] - g.centroid[b]).norm() * (1 + std::min(Real{2}, 2 * turn));
}

// Takes over every node that is nearer to the new seed than to those before it.
void spread(const Work& work, const RegionGraph& g, Index seed, Index label, std::vector<Real>& distance,
            std::vector<Index>& labels) {
  LeastFirst queue;
  distance[seed] = 0, labels[seed] = label;
  queue.push(0, seed, 0);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto top = queue.pop();
    const Real d = top.value();
    const Index n = top.first();
    if (d > distance[n] || labels[n] != label) continue;
    for (const Index o : g.row(n)) {
      const Real reached = d + step_length(g, n, o);
      if (reached < distance[o]) {
        distance[o] = reached, labels[o] = label;
        queue.push(reached, o, 0);
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
  for_each(work, Cost::light, n, [&](std::size_t i) { regions.position[region.faces[i]] = static_cast<Index>(i); });
  const std::vector<Index> near = rank_neighbours(work, s, region, regions);
  Index nodes = static_cast<Index>(n);
  g.is_faces = node_size <= 1;
  if (g.is_faces) {
    g.node_of_face.resize(n);
    for_each(work, Cost::light, n, [&](std::size_t i) { g.node_of_face[i] = static_cast<Index>(i); });
  } else {
    nodes = gather_balls(work, s, region, node_size, near, g.node_of_face);
  }
  g.area.resize(nodes);
  g.normal_sum.resize(nodes), g.mean_normal.resize(nodes), g.centroid.resize(nodes);
  Csr faces_of_node;
  if (!g.is_faces)
    faces_of_node = build_csr(
        work, nodes, n, [&](std::size_t i) { return g.node_of_face[i]; },
        [](std::size_t i) { return static_cast<Index>(i); });
  for_each(work, g.is_faces ? Cost::light : Cost::heavy, nodes, [&](std::size_t node) {
    const Index own = static_cast<Index>(node);
    const std::span<const Index> faces =
        g.is_faces ? std::span<const Index>(&own, 1) : faces_of_node.row(static_cast<Index>(node));
    Real area = 0;
    Vec3 sum = Vec3::Zero(), mean = Vec3::Zero(), centroid = Vec3::Zero();
    Vec3 plain = Vec3::Zero();  // centroid of faces without area
    for (const Index i : faces) {
      const Index f = region.faces[i];
      const Vec3 c = s.centroid(f);
      area += s.area[f];
      sum += s.area[f] * s.normal[f];
      mean += s.area[f] * normal[f];
      centroid += s.area[f] * c;
      plain += c;
    }
    g.area[node] = area;
    g.normal_sum.set(node, sum);
    g.mean_normal.set(node, area > 0 ? Vec3(mean / area) : mean);
    g.centroid.set(node, area > 0 ? Vec3(centroid / area) : Vec3(plain / static_cast<Real>(faces.size())));
  });
  if (g.is_faces)
    link_faces(work, near, g);
  else
    link_nodes(work, near, faces_of_node, g);
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
  LeastFirst queue;  // distance, label, node
  std::vector<Index> label(g.nodes(), kNone);
  std::vector<Real> best(g.nodes(), std::numeric_limits<Real>::infinity());
  for (Index i = 0; i < seed.size(); ++i) queue.push(0, i, seed[i]);
  for (Index step = 0; !queue.empty(); ++step) {
    if (step % 4096 == 0) work.check();
    const auto top = queue.pop();
    const Real d = top.value();
    const Index l = top.first(), n = top.second();
    if (label[n] != kNone) continue;
    label[n] = l;
    for (const Index o : g.row(n)) {
      if (label[o] != kNone) continue;
      const Real reached = d + step_length(g, n, o);
      if (reached <= best[o]) {
        best[o] = reached;
        queue.push(reached, l, o);
      }
    }
  }
  return label;
}

}  // namespace intarsia::kernels
