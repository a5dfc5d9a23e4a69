#include "kernels/scale/sample_levels.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/scan.h"

namespace intarsia::kernels {

namespace {

constexpr Cost kBlock{4096};  // clusters end at blocks, whose size is therefore part of the method
constexpr std::size_t kBlockSize = static_cast<std::size_t>(kBlock);
constexpr Index kTarget = 4;  // items a cluster
constexpr Index kLoose = 2;   // clusters of at most this size are shared out

// Clusters of one block of items, with ids local to the block.
class BlockClusters {
 public:
  BlockClusters(CsrView graph, Vec3View point, std::size_t begin, std::size_t end)
      : graph_(graph),
        point_(point),
        begin_(static_cast<Index>(begin)),
        end_(static_cast<Index>(end)),
        cluster_(end - begin, kNone) {
    for (Index i = begin_; i < end_; ++i)
      if (cluster_[i - begin_] == kNone) grow(i);
    for (Index i = begin_; i < end_; ++i)
      if (size_[cluster_[i - begin_]] <= kLoose) share_out(i);
    renumber();
  }
  Index count() const { return count_; }
  Index cluster_of(std::size_t item) const { return cluster_[item - begin_]; }

 private:
  bool here(Index i) const { return i >= begin_ && i < end_; }

  // From i, the free neighbour nearest to the mean joins until the cluster is full.
  void grow(Index i) {
    const Index id = static_cast<Index>(size_.size());
    Index member[kTarget] = {i};
    Index members = 1;
    cluster_[i - begin_] = id;
    Vec3 sum = point_[i];
    while (members < kTarget) {
      Index best = kNone;
      Real least = 0;
      const Vec3 mean = sum / static_cast<Real>(members);
      for (Index m = 0; m < members; ++m)
        for (Index w : graph_.row(member[m])) {
          if (!here(w) || cluster_[w - begin_] != kNone) continue;
          const Real d = (point_[w] - mean).squaredNorm();
          if (best == kNone || d < least || (d == least && w < best)) best = w, least = d;
        }
      if (best == kNone) break;
      cluster_[best - begin_] = id;
      member[members++] = best;
      sum += point_[best];
    }
    size_.push_back(members);
  }

  // Moves one item to the smallest neighbouring cluster; the nearest item decides between equals.
  void share_out(Index i) {
    const Index own = cluster_[i - begin_];
    Index best = kNone, best_size = 0;
    Real least = 0;
    for (Index w : graph_.row(i)) {
      if (!here(w)) continue;
      const Index c = cluster_[w - begin_];
      if (c == own) continue;
      const Real d = (point_[w] - point_[i]).squaredNorm();
      if (best == kNone || size_[c] < best_size || (size_[c] == best_size && d < least))
        best = c, best_size = size_[c], least = d;
    }
    if (best == kNone) return;
    --size_[own];
    ++size_[best];
    cluster_[i - begin_] = best;
  }

  void renumber() {
    std::vector<Index> id(size_.size(), kNone);
    for (Index& c : cluster_) {
      if (id[c] == kNone) id[c] = count_++;
      c = id[c];
    }
  }

  CsrView graph_;
  Vec3View point_;
  Index begin_, end_;
  std::vector<Index> cluster_, size_;
  Index count_ = 0;
};

// item -> cluster and the number of clusters.
std::vector<Index> aggregate(const Work& work, CsrView graph, Vec3View point, Index& clusters) {
  const std::size_t items = point.size();
  std::vector<Index> parent(items), start(block_count(kBlock, items));
  for_each_block(work, kBlock, items, [&](std::size_t begin, std::size_t end, std::size_t b) {
    const BlockClusters block(graph, point, begin, end);
    for (std::size_t i = begin; i < end; ++i) parent[i] = block.cluster_of(i);
    start[b] = block.count();
  });
  clusters = exclusive_scan<Index>(work, start);
  for_each(work, kBlock, items, [&](std::size_t i) { parent[i] += start[i / kBlockSize]; });
  return parent;
}

// The clusters that share an edge with each cluster: rows by block, then one after the other.
Csr cluster_graph(const Work& work, CsrView graph, const std::vector<Index>& parent, const Csr& member) {
  Csr out;
  out.offset.assign(std::size_t{member.rows()} + 1, 0);
  std::vector<std::vector<Index>> rows(block_count(kBlock, member.rows()));
  for_each_block(work, kBlock, member.rows(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    std::vector<Index>& list = rows[b];
    list.reserve(7 * (end - begin));
    for (std::size_t at = begin; at < end; ++at) {
      const Index c = static_cast<Index>(at);
      const std::size_t first = list.size();
      for (Index i : member.row(c))
        for (Index w : graph.row(i)) {
          const Index p = parent[w];
          if (p == c) continue;
          // Rows are short: what was found before is found again soonest from the end.
          std::size_t j = list.size();
          while (j > first && list[j - 1] > p) --j;
          if (j == first || list[j - 1] != p) list.insert(list.begin() + static_cast<std::ptrdiff_t>(j), p);
        }
      out.offset[at] = static_cast<Index>(list.size() - first);
    }
  });
  out.item.resize(exclusive_scan<Index>(work, out.offset));
  for_each_block(work, kBlock, member.rows(), [&](std::size_t begin, std::size_t, std::size_t b) {
    std::copy(rows[b].begin(), rows[b].end(), out.item.begin() + out.offset[begin]);
    rows[b] = {};
  });
  return out;
}

// What a cluster sums over its items.
struct Share {
  Vec3 weighted = Vec3::Zero(), plain = Vec3::Zero(), normal = Vec3::Zero();
  Real area = 0, spacing = 0, items = 0;
  Tensor tensor{};
  void add(const Vec3& p, Real a, const Tensor& t) {
    weighted += a * p, plain += p, area += a, items += 1;
    for (std::size_t i = 0; i < 6; ++i) tensor[i] += t[i];
  }
};

void add_vertex(const MeshView& mesh, std::span<const VotingFace> faces, Index v, Share& share) {
  Tensor t{};
  Vec3 normal = Vec3::Zero();
  Real area = 0;
  for (Index f : mesh.vertex_faces.row(v)) {
    const VotingFace& r = faces[f];
    const Real a = Real{r.area} / 3;
    const Real x = r.normal[0], y = r.normal[1], z = r.normal[2];
    area += a;
    normal += a * Vec3(x, y, z);
    t[0] += a * x * x, t[1] += a * x * y, t[2] += a * x * z;
    t[3] += a * y * y, t[4] += a * y * z, t[5] += a * z * z;
  }
  share.add(mesh.point(v), area, t);
  share.normal += normal;
}

}  // namespace

LevelBuild build_sample_levels(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces,
                               Real max_radius) {
  LevelBuild build;
  CsrView graph = mesh.vertex_vertices;
  Vec3View point{mesh.x, mesh.y, mesh.z};
  for (std::size_t l = 0;; ++l) {
    const Index items = static_cast<Index>(point.size());
    SampleLevel level;
    Index clusters = 0;
    level.parent = aggregate(work, graph, point, clusters);
    if (clusters < 16 || clusters > 0.7 * items) break;
    level.member = build_csr(
        work, clusters, items, [&](std::size_t i) { return level.parent[i]; },
        [](std::size_t i) { return static_cast<Index>(i); });
    level.neighbours = cluster_graph(work, graph, level.parent, level.member);
    level.centre.resize(clusters);
    level.area.resize(clusters);
    level.spacing.resize(clusters);
    std::vector<Tensor> tensor(clusters);
    std::vector<Real> spacing(clusters);
    Vec3Array normal(clusters);
    const SampleLevel* below = l == 0 ? nullptr : &build.levels.level[l - 1];
    for_each(work, kBlock, clusters, [&](std::size_t c) {
      Share s;
      for (Index i : level.member.row(static_cast<Index>(c))) {
        if (below) {
          s.add(below->centre[i], below->area[i], build.sums[l - 1].tensor[i]);
          s.spacing += below->spacing[i];
          s.normal += build.sums[l - 1].normal[i];
        } else {
          add_vertex(mesh, faces, i, s);
        }
      }
      level.centre.set(c, s.area > 0 ? Vec3(s.weighted / s.area) : Vec3(s.plain / s.items));
      level.area[c] = s.area;
      tensor[c] = s.tensor;
      normal.set(c, s.normal);
      // 2/sqrt(3) h^2 / 2 is the area around a vertex of the regular triangular mesh with edges h.
      spacing[c] = below ? s.spacing / s.items : std::sqrt(s.area / s.items * 1.1547005383792515);
    });
    for_each(work, kBlock, clusters, [&](std::size_t c) {
      Real sum = spacing[c];
      const auto row = level.neighbours.row(static_cast<Index>(c));
      for (Index w : row) sum += spacing[w];
      level.spacing[c] = sum / static_cast<Real>(row.size() + 1);
    });
    build.levels.level.push_back(std::move(level));
    build.sums.push_back({std::move(tensor), std::move(normal)});
    const SampleLevel& top = build.levels.level.back();
    Real finest = top.spacing[0];
    for (Real s : top.spacing) finest = std::min(finest, s);
    graph = top.neighbours;
    point = top.centre;
    // The last level serves no disc: those that share samples are below its clusters.
    if (3.2 * SampleLevels::cell(l, finest) > max_radius) break;
  }
  for (std::size_t l = 0; l < build.levels.level.size(); ++l)
    build.tiles.push_back(sample_tiles(work, build.levels, build.sums, l));
  return build;
}

Real disc_variation(const LevelBuild& build, Index c, int code, DiscWalker& walker) {
  const Real radius = disc_radius(code);
  const Vec3 at = build.levels.level[0].centre[c];
  const DiscWalker::Samples samples = walker.around(c, code);
  const SampleLevel& level = build.levels.level[samples.level];
  const auto& tensor = build.sums[samples.level].tensor;
  const Real limit = radius + 0.5 * samples.cell;
  Tensor sum{};
  for (Index s : samples.id) {
    const Real squared = (level.centre[s] - at).squaredNorm();
    if (squared >= limit * limit) continue;
    const Real d = std::sqrt(squared);
    const Real w = ramp(d, radius, samples.cell) * decay(std::min(d / radius, Real(1)));
    for (std::size_t i = 0; i < 6; ++i) sum[i] += w * tensor[s][i];
  }
  return variation_of_tensor(sum);
}

}  // namespace intarsia::kernels
