#include "engine/data/disc_walk.h"

namespace intarsia {

DiscWalker::DiscWalker(const SampleLevels& levels) : levels_(levels) {
  for (const SampleLevel& l : levels.level) stamp_.emplace_back(l.size(), 0u);
}

DiscWalker::Samples DiscWalker::around(Index c, int code) {
  const Real radius = disc_radius(code), spacing = levels_.level[0].spacing[c];
  const std::size_t level = levels_.level_for(radius, spacing);
  for (std::size_t l = 1; l <= level; ++l) c = levels_.level[l].parent[c];
  List& list = list_[static_cast<std::size_t>(code - kFirstDisc)];
  if (list.start != c || list.level != level) {
    list.start = c;
    list.level = level;
    walk(list, radius);
  }
  return {level, list.id, std::max(SampleLevels::cell(level, spacing), Real(1e-12))};
}

void DiscWalker::walk(List& list, Real radius) {
  const SampleLevel& l = levels_.level[list.level];
  auto& stamp = stamp_[list.level];
  if (++epoch_ == 0) {
    for (auto& s : stamp_) std::fill(s.begin(), s.end(), 0u);
    epoch_ = 1;
  }
  // Points below the start lie up to about one cell from its centre, and the ramp adds half a cell.
  const Vec3 centre = l.centre[list.start];
  const Real reach = radius + 1.75 * SampleLevels::cell(list.level, l.spacing[list.start]);
  list.id.assign(1, list.start);
  stamp[list.start] = epoch_;
  for (std::size_t i = 0; i < list.id.size(); ++i)
    for (Index w : l.neighbours.row(list.id[i])) {
      if (stamp[w] == epoch_) continue;
      stamp[w] = epoch_;
      if ((l.centre[w] - centre).squaredNorm() <= reach * reach) list.id.push_back(w);
    }
}

}  // namespace intarsia
