#include "engine/run/progress.h"

#include <algorithm>

namespace intarsia {

Index Progress::add(std::string stage, std::string branch, Real weight) {
  const std::lock_guard lock(mutex_);
  Node& node = nodes_.emplace_back();
  node.stage = std::move(stage), node.branch = std::move(branch), node.weight = std::max(weight, 1e-9);
  return static_cast<Index>(nodes_.size() - 1);
}

Real Progress::fraction(Node& node) {
  if (node.state == State::done) return 1;
  if (node.state == State::waiting) return 0;
  const Real done = static_cast<Real>(node.ticks.load(std::memory_order_relaxed));
  node.shown = std::max(node.shown, done / (done + static_cast<Real>(node.expected)));
  return node.shown;
}

Real Progress::advance_overall() {
  Real all = 0, reached = 0;
  bool complete = !nodes_.empty();
  for (Node& node : nodes_) {
    all += node.weight;
    reached += node.weight * fraction(node);
    complete = complete && node.state == State::done;
  }
  // Rounding must neither show 1 too early nor miss it at the end.
  const Real now = complete ? 1 : all > 0 ? std::min(reached / all, 1 - 1e-6) : 0;
  overall_ = std::max(overall_, now);
  return overall_;
}

template <class Call>
void Progress::tell(Node& node, const Call& call) {
  const ProgressEvent event{run_, node.stage, node.branch, fraction(node), advance_overall()};
  for (ProgressListener* listener : listeners_) call(*listener, event);
}

void Progress::begin(Index node, std::uint64_t expected_ticks) {
  const std::lock_guard lock(mutex_);
  nodes_[node].state = State::running;
  nodes_[node].expected = std::max<std::uint64_t>(1, expected_ticks);
  tell(nodes_[node], [](ProgressListener& l, const ProgressEvent& e) { l.stage_begin(e); });
}

void Progress::end(Index node) {
  const std::lock_guard lock(mutex_);
  nodes_[node].state = State::done;
  tell(nodes_[node], [](ProgressListener& l, const ProgressEvent& e) { l.stage_end(e); });
}

void Progress::poll() {
  const std::lock_guard lock(mutex_);
  for (Node& node : nodes_)
    if (node.state == State::running) tell(node, [](ProgressListener& l, const ProgressEvent& e) { l.advance(e); });
}

Real Progress::overall() {
  const std::lock_guard lock(mutex_);
  return advance_overall();
}

}  // namespace intarsia
