#include "kernels/curves/tidy_curves.h"

#include <algorithm>

#include "engine/parallel/compact.h"

namespace intarsia::kernels {

namespace {

bool is_crest(CurveKind kind) { return kind == CurveKind::ridge || kind == CurveKind::valley; }

void keep_chains(FeatureCurves& curves, std::span<const std::uint8_t> keep) {
  WeldedChains kept;
  kept.chain.offset.push_back(0);
  for (Index c = 0; c < curves.curve_count(); ++c) {
    if (!keep[c]) continue;
    const auto row = curves.points_of(c);
    kept.chain.item.insert(kept.chain.item.end(), row.begin(), row.end());
    kept.chain.offset.push_back(static_cast<Index>(kept.chain.item.size()));
    kept.source.push_back(c);
  }
  replace_chains(curves, std::move(kept));
}

// Two ends of one kind at a point that nothing else touches are one curve.
void weld_through(FeatureCurves& curves) {
  const auto uses = point_uses(curves);
  std::vector<Index> waiting(curves.point_count(), kNone), mate(2 * std::size_t{curves.curve_count()}, kNone);
  bool any = false;
  for (Index end = 0; end < mate.size(); ++end) {
    const Index c = chain_of_end(end);
    if (!is_crest(curves.net.kind[c]) || curves.net.is_closed(c)) continue;
    const auto row = curves.points_of(c);
    const Index p = end % 2 ? row.back() : row.front();
    if (uses[p] != 2) continue;
    const Index other = waiting[p];
    if (other == kNone)
      waiting[p] = end;
    else if (curves.net.kind[chain_of_end(other)] == curves.net.kind[c])
      mate[other] = end, mate[end] = other, any = true;
  }
  if (any) replace_chains(curves, weld_chains(curves.net.curve, mate));
}

}  // namespace

std::vector<Index> point_uses(const FeatureCurves& curves) {
  std::vector<Index> uses(curves.point_count(), 0);
  for (Index c = 0; c < curves.curve_count(); ++c) {
    const auto row = curves.points_of(c);
    for (Index p : row) uses[p] += 2;
    --uses[row.front()], --uses[row.back()];
  }
  return uses;
}

Real curve_length(const MeshView& mesh, const FeatureCurves& curves, Index c) {
  const auto row = curves.points_of(c);
  Real length = 0;
  Vec3 last = position(mesh, curves.net.point[row.front()]);
  for (Index p : row.subspan(1)) {
    const Vec3 next = position(mesh, curves.net.point[p]);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

void replace_chains(FeatureCurves& curves, WeldedChains chains) {
  std::vector<CurveKind> kind(chains.source.size());
  std::vector<std::uint8_t> concave(chains.source.size());
  for (std::size_t i = 0; i < chains.source.size(); ++i)
    kind[i] = curves.net.kind[chains.source[i]], concave[i] = curves.concave[chains.source[i]];
  curves.net.curve = std::move(chains.chain);
  curves.net.kind = std::move(kind), curves.concave = std::move(concave);
  curves.length.clear(), curves.rms_curvature.clear(), curves.strength.clear(), curves.saliency.clear();
  curves.component.clear(), curves.component_saliency.clear(), curves.component_passed.clear();
}

FeatureCurves select_curves(const Work& work, const FeatureCurves& curves, std::span<const std::uint8_t> keep) {
  FeatureCurves out;
  out.net.curve.offset.assign(1, 0);
  std::vector<Index> to(curves.point_count(), kNone);
  for (Index c = 0; c < curves.curve_count(); ++c)
    if (keep[c])
      for (Index p : curves.points_of(c)) to[p] = 0;
  const auto kept = compact(work, to.size(), [&](std::size_t p) { return to[p] == 0; });
  out.resize_points(kept.size());
  for_each(work, Cost::light, kept.size(), [&](std::size_t i) {
    to[kept[i]] = static_cast<Index>(i);
    out.copy_point(static_cast<Index>(i), curves, kept[i]);
  });
  const bool measured = !curves.length.empty(), ranked = !curves.component.empty();
  std::vector<Index> row;
  for (Index c = 0; c < curves.curve_count(); ++c) {
    if (!keep[c]) continue;
    row.clear();
    for (Index p : curves.points_of(c)) row.push_back(to[p]);
    out.add_curve(row, curves.net.kind[c], curves.concave[c] != 0);
    if (measured) {
      out.length.push_back(curves.length[c]), out.rms_curvature.push_back(curves.rms_curvature[c]);
      out.strength.push_back(curves.strength[c]), out.saliency.push_back(curves.saliency[c]);
    }
    if (ranked) out.component.push_back(curves.component[c]);
  }
  out.component_saliency = curves.component_saliency, out.component_passed = curves.component_passed;
  return out;
}

FeatureCurves merge_channels(std::span<const FeatureCurves* const> sets) {
  FeatureCurves out;
  out.net.curve.offset.assign(1, 0);
  std::size_t points = 0;
  for (const auto* set : sets) points += set->point_count();
  out.resize_points(points);
  Index base = 0;
  std::vector<Index> row;
  for (const auto* set : sets) {
    for (Index p = 0; p < set->point_count(); ++p) out.copy_point(base + p, *set, p);
    for (Index c = 0; c < set->curve_count(); ++c) {
      row.clear();
      for (Index p : set->points_of(c)) row.push_back(base + p);
      out.add_curve(row, set->net.kind[c], set->concave[c] != 0);
    }
    base += set->point_count();
  }
  return out;
}

void remove_spurs(const Work& work, const MeshView& mesh, Real max_length, FeatureCurves& curves) {
  const auto uses = point_uses(curves);
  std::vector<std::uint8_t> keep(curves.curve_count(), 1);
  for_each(work, Cost::medium, curves.curve_count(), [&](std::size_t i) {
    const Index c = static_cast<Index>(i);
    if (!is_crest(curves.net.kind[c]) || curves.net.is_closed(c)) return;
    const auto row = curves.points_of(c);
    const Index a = uses[row.front()], b = uses[row.back()];
    if (std::min(a, b) == 1 && std::max(a, b) >= 3 && curve_length(mesh, curves, c) < max_length) keep[c] = 0;
  });
  keep_chains(curves, keep);
  weld_through(curves);
}

void remove_fragments(const Work& work, const MeshView& mesh, Real min_length, FeatureCurves& curves) {
  const auto uses = point_uses(curves);
  std::vector<std::uint8_t> keep(curves.curve_count(), 1);
  for_each(work, Cost::medium, curves.curve_count(), [&](std::size_t i) {
    const Index c = static_cast<Index>(i);
    if (!is_crest(curves.net.kind[c])) return;
    const auto row = curves.points_of(c);
    const bool alone =
        curves.net.is_closed(c) ? uses[row.front()] == 2 : uses[row.front()] == 1 && uses[row.back()] == 1;
    if (alone && curve_length(mesh, curves, c) < min_length) keep[c] = 0;
  });
  keep_chains(curves, keep);
}

void trim_tails(const Work& work, Real min_turn, Index window, FeatureCurves& curves) {
  const Index half = window / 2;
  for (int round = 0; round < 8; ++round) {
    work.check();
    const auto uses = point_uses(curves);
    WeldedChains kept;
    kept.chain.offset.push_back(0);
    bool changed = false;
    for (Index c = 0; c < curves.curve_count(); ++c) {
      const auto row = curves.points_of(c);
      Index begin = 0, end = static_cast<Index>(row.size());
      if (is_crest(curves.net.kind[c]) && !curves.net.is_closed(c)) {
        const auto faint = [&](Index i) {
          const Index lo = i > half ? i - half : 0, hi = std::min<Index>(end, i + half + 1);
          Real sum = 0;
          for (Index j = lo; j < hi; ++j) sum += curves.turn()[row[j]];
          return sum < min_turn * (hi - lo);
        };
        const bool front = uses[row.front()] == 1, back = uses[row.back()] == 1;
        // A point in the middle of the tail where another curve begins stops the cut: it is a junction.
        if (front)
          while (begin + 1 < row.size() && faint(begin) && (begin == 0 || uses[row[begin]] == 2)) ++begin;
        if (back) {
          Index last = end;
          while (last > begin + 1 && faint(last - 1) && (last == end || uses[row[last - 1]] == 2)) --last;
          end = last;
        }
        changed |= begin > 0 || end < row.size();
        if (end - begin < 2) continue;
      }
      kept.chain.item.insert(kept.chain.item.end(), row.begin() + begin, row.begin() + end);
      kept.chain.offset.push_back(static_cast<Index>(kept.chain.item.size()));
      kept.source.push_back(c);
    }
    if (!changed) break;
    replace_chains(curves, std::move(kept));
    weld_through(curves);
  }
}

}  // namespace intarsia::kernels
