// A limit of wall time for the runs of a context.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/run/context.h"

namespace intarsia {

// From its making on, after kLateShare of the time only what a result needs is still done (Work::is_late); at the end
// the context is cancelled, unless disarm() has been called before. What comes out of a run that was late depends on
// the speed of the machine.
class TimeLimit {
 public:
  static constexpr Real kLateShare = 0.6;

  // Requires: the context outlives this object.
  TimeLimit(RunContext& context, Real seconds);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  // There is a result: it may be written to its end.
  void disarm();
  // Whether the context was cancelled by this limit.
  bool has_expired() const { return expired_.load(std::memory_order_relaxed); }

 private:
  void watch(Real seconds);

  RunContext& context_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::atomic<bool> expired_{false};
  std::thread thread_;  // last: starts when the rest exists
};

}  // namespace intarsia
