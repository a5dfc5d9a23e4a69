// How far a run has come, for whoever wants to show it. Stages know nothing of this: they only tick (engine/parallel).
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

struct ProgressEvent {
  const std::string& run;     // name of the run (of the mesh); several runs may report through one listener
  const std::string& stage;   // name in reports: read surface scale curvature ridges ...
  const std::string& branch;  // tells nodes of one stage apart; empty if there is one
  Real stage_fraction;        // 0..1 of this node
  Real overall;               // 0..1 of the run; never goes back, reaches 1 when every stage has ended
};

// Calls of one run never overlap and may come from any thread; they must return soon and must not throw. They may
// cancel the run.
class ProgressListener {
 public:
  virtual ~ProgressListener() = default;
  virtual void stage_begin(const ProgressEvent&) {}
  virtual void advance(const ProgressEvent&) {}  // at most once per kProgressInterval and running node
  virtual void stage_end(const ProgressEvent&) {}
};

inline constexpr int kProgressIntervalMilliseconds = 100;

// The state of one run. Nodes are added first, then begin/end may come from any thread.
class Progress {
 public:
  Progress(std::string run, std::vector<ProgressListener*> listeners)
      : run_(std::move(run)), listeners_(std::move(listeners)) {}

  bool has_listeners() const { return !listeners_.empty(); }
  // weight: the node's expected share of the run, in any unit.
  Index add(std::string stage, std::string branch, Real weight);
  // expected_ticks: a guess; the fraction of a running node approaches 1 as its ticks pass it, without reaching it.
  void begin(Index node, std::uint64_t expected_ticks);
  void end(Index node);
  // Tells listeners about the running nodes; to be called every kProgressInterval.
  void poll();
  Real overall();
  std::atomic<std::uint64_t>& ticks(Index node) { return nodes_[node].ticks; }

 private:
  enum class State : std::uint8_t { waiting, running, done };
  struct Node {
    std::string stage, branch;
    Real weight = 1;
    State state = State::waiting;
    std::uint64_t expected = 1;
    Real shown = 0;
    std::atomic<std::uint64_t> ticks{0};
  };

  Real fraction(Node& node);
  Real advance_overall();
  template <class Call>
  void tell(Node& node, const Call& call);

  std::string run_;
  std::vector<ProgressListener*> listeners_;
  std::mutex mutex_;
  std::deque<Node> nodes_;  // addresses stay
  Real overall_ = 0;
};

}  // namespace intarsia
