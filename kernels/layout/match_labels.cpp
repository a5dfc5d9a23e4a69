#include "kernels/layout/match_labels.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/parallel/compact.h"
#include "engine/space/surface_path.h"
#include "kernels/layout/parent_weights.h"

namespace intarsia::kernels {
namespace {

struct Overlap {
  Index fresh, old;
  Real area;
};

struct Share {
  Index label;
  Real share;
};

// The labels inside one parent, ascending, with the shares of its area.
void shares_of(const MeshView& original, const RefinedMesh& refined, std::span<const Index> children,
               std::span<const Index> label, std::vector<Share>& out) {
  out.clear();
  if (children.empty()) return;
  if (std::all_of(children.begin(), children.end(), [&](Index c) { return label[c] == label[children[0]]; })) {
    out.push_back({label[children[0]], 1});
    return;
  }
  for (Index c : children)
    out.push_back({label[c], std::max(Real{0}, share_of_parent(original, refined, c).value_or(0))});
  std::stable_sort(out.begin(), out.end(), [](const Share& a, const Share& b) { return a.label < b.label; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (out[i].label == out[last].label)
      out[last].share += out[i].share;
    else
      out[++last] = out[i];
  }
  out.resize(last + 1);
}

// Sums of common area, ascending by (new, old).
std::vector<Overlap> overlaps(const Work& work, const MeshView& original, const LabelShares& old,
                              const RefinedMesh& new_refined, std::span<const Index> new_label) {
  const Csr new_children = children_of_parents(work, original.face_count(), new_refined);
  std::vector<std::vector<Overlap>> by_block(block_count(Cost::light, original.face_count()));
  for_each_block(work, Cost::light, original.face_count(), [&](std::size_t begin, std::size_t end, std::size_t b) {
    std::vector<Share> old_share, new_share;
    std::vector<Overlap>& found = by_block[b];
    auto cut = static_cast<std::size_t>(std::lower_bound(old.face.begin(), old.face.end(), static_cast<Index>(begin)) -
                                        old.face.begin());
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = static_cast<Index>(i);
      old_share.clear();
      if (old.whole[f] != kNone) {
        old_share.push_back({old.whole[f], 1});
      } else {
        for (Index k = old.offset[cut]; k < old.offset[cut + 1]; ++k) old_share.push_back({old.label[k], old.share[k]});
        ++cut;
      }
      shares_of(original, new_refined, new_children.row(f), new_label, new_share);
      const Real area = area_normal(original, f).norm() / 2;
      for (const Share& n : new_share)
        for (const Share& o : old_share) {
          const Real common = area * n.share * o.share;
          // Neighbouring faces mostly carry the same pair: adding up runs keeps the list short.
          if (!found.empty() && found.back().fresh == n.label && found.back().old == o.label)
            found.back().area += common;
          else
            found.push_back({n.label, o.label, common});
        }
    }
  });
  std::vector<Overlap> all;
  for (const auto& block : by_block) all.insert(all.end(), block.begin(), block.end());
  std::stable_sort(all.begin(), all.end(), [](const Overlap& a, const Overlap& b) {
    return a.fresh != b.fresh ? a.fresh < b.fresh : a.old < b.old;
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].fresh == all[last].fresh && all[i].old == all[last].old)
      all[last].area += all[i].area;
    else
      all[++last] = all[i];
  }
  if (!all.empty()) all.resize(last + 1);
  return all;
}

}  // namespace

LabelShares label_shares(const Work& work, MeshView original, const RefinedMesh& refined,
                         std::span<const Index> label) {
  if (label.size() != refined.parent.size())
    throw Error(ErrorCode::internal, "label_shares needs one label per refined face");
  const Csr children = children_of_parents(work, original.face_count(), refined);
  LabelShares out;
  out.whole.resize(original.face_count());
  for_each(work, Cost::light, original.face_count(), [&](std::size_t f) {
    const auto row = children.row(static_cast<Index>(f));
    const bool whole =
        !row.empty() && std::all_of(row.begin(), row.end(), [&](Index c) { return label[c] == label[row[0]]; });
    out.whole[f] = whole ? label[row[0]] : kNone;
  });
  out.face = compact(work, original.face_count(), [&](std::size_t f) { return out.whole[f] == kNone; });
  out.offset.push_back(0);
  std::vector<Share> shares;
  for (std::size_t i = 0; i < out.face.size(); ++i) {
    if (i % 4096 == 0) work.check();
    shares_of(original, refined, children.row(out.face[i]), label, shares);
    for (const Share& s : shares) out.label.push_back(s.label), out.share.push_back(s.share);
    out.offset.push_back(static_cast<Index>(out.label.size()));
  }
  return out;
}

LabelMatch match_labels(const Work& work, MeshView original, const RefinedMesh& old_refined,
                        std::span<const Index> old_label, Index old_count, const RefinedMesh& new_refined,
                        std::span<const Index> new_label, Index new_count) {
  return match_labels(work, original, label_shares(work, original, old_refined, old_label), old_count, new_refined,
                      new_label, new_count);
}

LabelMatch match_labels(const Work& work, MeshView original, const LabelShares& old, Index old_count,
                        const RefinedMesh& new_refined, std::span<const Index> new_label, Index new_count) {
  if (old.whole.size() != original.face_count() || new_label.size() != new_refined.parent.size())
    throw Error(ErrorCode::internal, "match_labels needs one label per refined face");
  LabelMatch match;
  match.old_of_new.assign(new_count, kNone);
  std::vector<Real> best(new_count, -1), kept(old_count, 0), area(old_count, 0);
  std::vector<Index> components(old_count, 0);
  for (const Overlap& o : overlaps(work, original, old, new_refined, new_label)) {
    area[o.old] += o.area;
    if (o.area > best[o.fresh]) best[o.fresh] = o.area, match.old_of_new[o.fresh] = o.old;
  }
  bool all_matched = true;
  for (Index c = 0; c < new_count; ++c) {
    const Index p = match.old_of_new[c];
    if (p == kNone) {
      all_matched = false;
      continue;
    }
    ++components[p];
    kept[p] = std::max(kept[p], best[c]);
  }
  for (Index p = 0; p < old_count; ++p)
    if (components[p] != 1 || kept[p] < area[p] / 2) match.trouble.push_back(p);
  match.ok = all_matched && match.trouble.empty();
  return match;
}

std::vector<std::uint8_t> arcs_of_patches(const LayoutGraph& graph, std::span<const Index> patches) {
  std::vector<std::uint8_t> bad(graph.patch_count(), 0), flag(graph.arc_count(), 0);
  for (Index p : patches) bad[p] = 1;
  for (Index a = 0; a < graph.arc_count(); ++a)
    for (Index p : {graph.left[a], graph.right[a]})
      if (p != kNone && bad[p]) flag[a] = 1;
  return flag;
}

std::vector<Index> patches_out_of_place(const Work& work, const LayoutGraph& graph, MeshView new_refined,
                                        std::span<const Index> patch_of_face, std::span<const Index> edge,
                                        std::span<const Index> edge_curve) {
  const auto sides = [&](std::size_t i) {
    const Index f = new_refined.edge_f0[edge[i]], g = new_refined.edge_f1[edge[i]];
    return std::minmax({patch_of_face[f], g == kNone ? kNone : patch_of_face[g]});
  };
  const std::vector<Index> wrong = compact(work, edge.size(), [&](std::size_t i) {
    return sides(i) != std::minmax({graph.left[edge_curve[i]], graph.right[edge_curve[i]]});
  });
  std::vector<Index> patches;
  for (Index i : wrong) {
    const auto [low, high] = sides(i);
    for (Index p : {low, high, graph.left[edge_curve[i]], graph.right[edge_curve[i]]})
      if (p != kNone) patches.push_back(p);
  }
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  return patches;
}

}  // namespace intarsia::kernels
