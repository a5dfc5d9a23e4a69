#include "kernels/patches/patch_graph.h"

#include <algorithm>

#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"

namespace intarsia::kernels {
namespace {

auto find_border(std::vector<Border>& row, Index other) {
  return std::lower_bound(row.begin(), row.end(), other, [](const Border& b, Index o) { return b.other < o; });
}

void add(Border& into, const Border& from) {
  into.edges += from.edges;
  into.euler += from.euler;
  into.length += from.length;
  into.salience += from.salience;
  into.given += from.given;
}

void erase_value(std::vector<Index>& values, Index value) {
  values.erase(std::find(values.begin(), values.end(), value));
}

}  // namespace

PatchGraph::PatchGraph(const Work& work, const PatchSurface& s, const PatchLabels& labels)
    : node_(labels.count), into_(labels.count), alive_(labels.count) {
  const auto euler = euler_of_patches(work, s, labels);
  for (Index p = 0; p < labels.count; ++p) into_[p] = p, node_[p].euler = euler[p];
  for (Index f = 0; f < labels.patch_of_face.size(); ++f) {
    if (f % 4096 == 0) work.check();
    PatchNode& n = node_[labels.patch_of_face[f]];
    n.area += s.area[f];
    n.normal_sum += s.area[f] * s.normal[f];
    if (n.first_face == kNone) n.first_face = f;
  }
  add_links(work, s, labels);
  add_meetings(work, s, labels);
}

void PatchGraph::add_links(const Work& work, const PatchSurface& s, const PatchLabels& labels) {
  const MeshView& mesh = s.mesh;
  const auto& patch = labels.patch_of_face;
  const auto edges = compact(work, mesh.edge_count(), [&](std::size_t e) {
    return mesh.edge_f1[e] == kNone || patch[mesh.edge_f0[e]] != patch[mesh.edge_f1[e]];
  });
  struct Link {
    std::uint64_t pair;
    Index edge;
    bool operator<(const Link& o) const { return pair != o.pair ? pair < o.pair : edge < o.edge; }
  };
  std::vector<Link> link(edges.size());
  for_each(work, Cost::light, edges.size(), [&](std::size_t i) {
    const Index e = edges[i], p = patch[mesh.edge_f0[e]];
    const Index q = mesh.edge_f1[e] == kNone ? kNone : patch[mesh.edge_f1[e]];
    link[i] = {std::uint64_t{std::min(p, q)} << 32 | std::max(p, q), e};
  });
  sort_total(work, link.begin(), link.end());
  for (std::size_t i = 0; i < link.size();) {
    const Index p = static_cast<Index>(link[i].pair >> 32), q = static_cast<Index>(link[i].pair);
    Border b;
    b.other = q;
    for (const std::uint64_t pair = link[i].pair; i < link.size() && link[i].pair == pair; ++i) {
      const Real length = s.edge_length(link[i].edge), theta = s.strength(link[i].edge);
      b.length += length;
      b.salience += theta * theta * length;
      ++b.edges;
      b.given += s.is_given(link[i].edge) ? 1 : 0;
    }
    b.euler = static_cast<std::int32_t>(b.edges);
    node_[p].perimeter += b.length;
    if (q == kNone) continue;
    node_[q].perimeter += b.length;
    node_[p].borders.push_back(b);
    b.other = p;
    node_[q].borders.push_back(b);
  }
  for (PatchNode& n : node_)
    std::sort(n.borders.begin(), n.borders.end(), [](const Border& a, const Border& b) { return a.other < b.other; });
}

void PatchGraph::add_meetings(const Work& work, const PatchSurface& s, const PatchLabels& labels) {
  const MeshView& mesh = s.mesh;
  const auto& patch = labels.patch_of_face;
  const auto shared = compact(work, mesh.vertex_count(), [&](std::size_t v) {
    const auto star = mesh.vertex_faces.row(static_cast<Index>(v));
    return std::any_of(star.begin(), star.end(), [&](Index f) { return patch[f] != patch[star[0]]; });
  });
  std::vector<Index> around;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (i % 4096 == 0) work.check();
    around.clear();
    for (const Index f : mesh.vertex_faces.row(shared[i])) around.push_back(patch[f]);
    add_touch(around, true);
  }
  for (Index h = 0; h < s.hole.rows(); ++h) {
    around.clear();
    for (const Index e : s.hole.row(h)) around.push_back(patch[mesh.edge_f0[e]]);
    add_touch(around, false);
  }
}

void PatchGraph::add_touch(std::vector<Index>& patches, bool is_vertex) {
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  if (patches.size() == 2) {
    add_euler(patches[0], patches[1], is_vertex ? -1 : 1);
  } else if (patches.size() > 2) {
    for (const Index p : patches) node_[p].meetings.push_back(static_cast<Index>(meeting_.size()));
    meeting_.push_back({patches, is_vertex});
  }
}

Border& PatchGraph::border_between(Index p, Index q) {
  auto& row = node_[p].borders;
  auto it = find_border(row, q);
  if (it == row.end() || it->other != q) {
    Border fresh;
    fresh.other = q;
    it = row.insert(it, fresh);
  }
  return *it;
}

void PatchGraph::add_euler(Index p, Index q, int euler) {
  border_between(p, q).euler += euler;
  border_between(q, p).euler += euler;
}

int PatchGraph::union_euler(Index p, const Border& border) const {
  Index a = p, b = border.other;
  if (node_[a].meetings.size() > node_[b].meetings.size()) std::swap(a, b);
  int shared = 0;
  for (const Index m : node_[a].meetings)
    if (meeting_[m].is_vertex && std::binary_search(meeting_[m].patches.begin(), meeting_[m].patches.end(), b))
      ++shared;
  return node_[a].euler + node_[b].euler + border.euler - shared;
}

Real PatchGraph::union_energy_increase(Index p, const Border& border) const {
  const PatchNode &a = node_[p], &b = node_[border.other];
  return 2 * std::max(Real{0}, a.normal_sum.norm() + b.normal_sum.norm() - (a.normal_sum + b.normal_sum).norm());
}

Real PatchGraph::union_perimeter(Index p, const Border& border) const {
  return std::max(Real{0}, node_[p].perimeter + node_[border.other].perimeter - 2 * border.length);
}

Index PatchGraph::merge(Index p, Index q) {
  if (p > q) std::swap(p, q);
  Index keep = p, gone = q;  // the longer row stays: n merges into one patch cost n log n, not n^2
  if (node_[q].borders.size() > node_[p].borders.size()) std::swap(keep, gone);
  PatchNode &k = node_[keep], &g = node_[gone];
  const Border between = *find_border(k.borders, gone);
  k.euler = union_euler(keep, between);
  k.perimeter = union_perimeter(keep, between);
  k.area += g.area;
  k.normal_sum += g.normal_sum;
  k.first_face = std::min(k.first_face, g.first_face);
  ++k.version, ++g.version;
  k.borders.erase(find_border(k.borders, gone));
  for (const Border& b : g.borders) {
    if (b.other == keep) continue;
    auto& row = node_[b.other].borders;
    row.erase(find_border(row, gone));
    add(border_between(keep, b.other), b);
    add(border_between(b.other, keep), b);
  }
  for (const Index m : g.meetings) {
    auto& patches = meeting_[m].patches;
    erase_value(patches, gone);
    const auto at = std::lower_bound(patches.begin(), patches.end(), keep);
    if (at == patches.end() || *at != keep) {
      patches.insert(at, keep);
      k.meetings.push_back(m);
    } else if (patches.size() == 2) {
      add_euler(patches[0], patches[1], meeting_[m].is_vertex ? -1 : 1);
      for (const Index r : patches) erase_value(node_[r].meetings, m);
      patches.clear();
    }
  }
  g.borders.clear(), g.borders.shrink_to_fit();
  g.meetings.clear(), g.meetings.shrink_to_fit();
  g.alive = false;
  into_[gone] = keep;
  --alive_;
  return keep;
}

Index PatchGraph::survivor(Index p) const {
  while (into_[p] != p) p = into_[p];
  return p;
}

PatchLabels PatchGraph::labels(const Work& work, const PatchLabels& before) const {
  std::vector<Index> root(into_.size());
  for (Index p = 0; p < root.size(); ++p) root[p] = survivor(p);
  std::vector<Index> id(before.patch_of_face.size());
  for_each(work, Cost::light, id.size(), [&](std::size_t f) { id[f] = root[before.patch_of_face[f]]; });
  return compact_labels(work, id, static_cast<Index>(into_.size()));
}

}  // namespace intarsia::kernels
