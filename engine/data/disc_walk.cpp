#include "engine/data/disc_walk.h"

namespace intarsia {

DiscWalker::DiscWalker(const SampleLevels& levels) : levels_(levels), list_(std::size_t{kDiscs} * kKept) {
  for (const SampleLevel& l : levels.level) stamp_.emplace_back(l.size(), 0u);
}

DiscWalker::Samples DiscWalker::around(Index c, int code) {
  const Real radius = disc_radius(code), spacing = levels_.level[0].spacing[c];
  const std::size_t level = levels_.level_for(radius, spacing);
  const Real cell = std::max(SampleLevels::cell(level, spacing), Real(1e-12));
  const bool above = level + 1 < levels_.level.size();
  Index first = c;
  for (std::size_t l = 1; l <= level; ++l) first = levels_.level[l].parent[first];
  const Index shared = above ? levels_.level[level + 1].parent[first] : first;
  List& list = list_[static_cast<std::size_t>(code - kFirstDisc) * kKept + shared % kKept];
  if (list.around != shared || list.level != level) {
    list.around = shared;
    list.level = level;
    const SampleLevel& of = levels_.level[level + above];
    if (above) first = of.member.row(shared)[0];
    // Points below a cluster lie up to about one of its cells from its centre, and the ramp adds half a sample's.
    const Real own = SampleLevels::cell(level + above, of.spacing[shared]);
    walk(list, first, of.centre[shared], radius + (above ? 1.4 : 1.75) * own);
  }
  return {level, list.id, cell};
}

void DiscWalker::walk(List& list, Index first, const Vec3& centre, Real reach) {
  const SampleLevel& l = levels_.level[list.level];
  auto& stamp = stamp_[list.level];
  if (++epoch_ == 0) {
    for (auto& s : stamp_) std::fill(s.begin(), s.end(), 0u);
    epoch_ = 1;
  }
  list.id.assign(1, first);
  stamp[first] = epoch_;
  for (std::size_t i = 0; i < list.id.size(); ++i)
    for (Index w : l.neighbours.row(list.id[i])) {
      if (stamp[w] == epoch_) continue;
      stamp[w] = epoch_;
      if ((l.centre[w] - centre).squaredNorm() <= reach * reach) list.id.push_back(w);
    }
}

}  // namespace intarsia
