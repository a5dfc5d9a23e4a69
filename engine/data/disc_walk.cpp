#include "engine/data/disc_walk.h"

namespace intarsia {

DiscWalker::DiscWalker(const SampleLevels& levels) : levels_(levels), list_(std::size_t{kDiscs} * kKept) {
  for (const SampleLevel& l : levels.level) stamp_.emplace_back(l.size(), 0u);
  for (int d = 0; d < kDiscs; ++d) radius_[static_cast<std::size_t>(d)] = disc_radius(kFirstDisc + d);
}

DiscWalker::Place DiscWalker::place(Index c, int code) const {
  Place p;
  p.radius = radius_[static_cast<std::size_t>(code - kFirstDisc)];
  const Real spacing = levels_.level[0].spacing[c];
  p.level = levels_.level_for(p.radius, spacing);
  p.cell = std::max(SampleLevels::cell(p.level, spacing), Real(1e-12));
  const std::size_t last = std::min(p.level + 1, levels_.level.size() - 1);
  p.shared = c;
  for (std::size_t l = 1; l <= last; ++l) p.shared = levels_.level[l].parent[p.shared];
  return p;
}

DiscWalker::Samples DiscWalker::around(Index c, int code) {
  const Place at = place(c, code);
  const bool above = at.level + 1 < levels_.level.size();
  List& list = list_[static_cast<std::size_t>(code - kFirstDisc) * kKept + at.shared % kKept];
  if (list.around != at.shared || list.level != at.level) {
    list.around = at.shared;
    list.level = at.level;
    const SampleLevel& of = levels_.level[at.level + above];
    const Index first = above ? of.member.row(at.shared)[0] : at.shared;
    // Points below a cluster lie up to about one of its cells from its centre, and the ramp adds half a sample's.
    const Real own = SampleLevels::cell(at.level + above, of.spacing[at.shared]);
    walk(list, first, of.centre[at.shared], at.radius + (above ? 1.4 : 1.75) * own);
  }
  return {at.level, list.id, at.cell};
}

void DiscWalker::walk(List& list, Index first, const Vec3& centre, Real reach) {
  const SampleLevel& l = levels_.level[list.level];
  auto& stamp = stamp_[list.level];
  if (++epoch_ == 0) {
    for (auto& s : stamp_) std::fill(s.begin(), s.end(), 0u);
    epoch_ = 1;
  }
  // Wave by wave: what a wave is next to and has not been met, and then what of that is near enough. Without branches
  // on either, which processors cannot predict.
  const auto& id = list.id;
  list.id.assign(std::max<std::size_t>(id.size(), 256), first);
  stamp[first] = epoch_;
  const Index* offset = l.neighbours.offset.data();
  const Index* item = l.neighbours.item.data();
  const Real *x = l.centre.x.data(), *y = l.centre.y.data(), *z = l.centre.z.data();
  const Real cx = centre.x(), cy = centre.y(), cz = centre.z(), most = reach * reach;
  std::size_t begin = 0, end = 1;
  while (begin < end) {
    std::size_t met = end;
    for (std::size_t i = begin; i < end; ++i) {
      const Index from = offset[id[i]], to = offset[id[i] + 1];
      if (id.size() < met + (to - from)) list.id.resize(2 * id.size() + (to - from));
      Index* out = list.id.data();
      for (Index j = from; j < to; ++j) {
        const Index w = item[j];
        const std::size_t fresh = stamp[w] != epoch_;
        stamp[w] = epoch_;
        out[met] = w;
        met += fresh;
      }
    }
    begin = end;
    for (std::size_t i = begin; i < met; ++i) {
      const Index w = id[i];
      const Real dx = x[w] - cx, dy = y[w] - cy, dz = z[w] - cz;
      list.id[end] = w;
      end += dx * dx + dy * dy + dz * dz <= most;
    }
  }
  list.id.resize(end);
}

}  // namespace intarsia
