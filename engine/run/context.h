// What belongs to a run and not to the method: threads, seed, order of reductions, cancellation, listeners.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "engine/parallel/work.h"
#include "engine/run/cpu_meter.h"
#include "engine/run/progress.h"

namespace intarsia {

// More asked for is an error: past what the system allows, a thread that cannot start ends the process.
inline constexpr int kMostThreads = 1024;

struct RunSettings {
  int threads = 0;  // 0 = every processor the process may use (affinity); results do not depend on it
  std::uint64_t seed = 0;
  Order order = Order::fixed;
  bool whole_process = true;  // the number of threads holds for all of oneTBB in this process; false: for the context
};

// Shared by any number of flows, which may run at once. Must outlive them.
class RunContext {
 public:
  // cancel: a flag to watch instead of an own one, for example one that a signal handler sets; must outlive the
  // context. Errors: bad_argument if threads < 0 or > kMostThreads.
  explicit RunContext(const RunSettings& settings = {}, std::atomic<bool>* cancel = nullptr);

  int threads() const { return threads_; }
  std::uint64_t seed() const { return settings_.seed; }
  Order order() const { return settings_.order; }

  void cancel() { cancel_->store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancel_->load(std::memory_order_relaxed); }
  // Tells the stages that the time is nearly up (Work::is_late).
  void hurry() { late_.store(true, std::memory_order_relaxed); }
  const std::atomic<bool>& late_flag() const { return late_; }
  // Lock-free, so a signal handler may set it.
  std::atomic<bool>& cancel_flag() { return *cancel_; }

  // Listeners are told of flows made afterwards; they must outlive those flows. Not thread-safe.
  void add_listener(ProgressListener& listener) { listeners_.push_back(&listener); }
  const std::vector<ProgressListener*>& listeners() const { return listeners_; }

  // Runs f in the context's arena, for parallel work outside any flow.
  template <class F>
  auto execute(const F& f) {
    return arena_.execute(f);
  }
  Work work() const { return Work(cancel_, nullptr, settings_.order); }
  CpuMeter& cpu_meter() { return cpu_meter_; }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free);
  RunSettings settings_;
  int threads_;
  std::atomic<bool> own_cancel_{false}, late_{false};
  std::atomic<bool>* cancel_;
  std::vector<ProgressListener*> listeners_;
  CpuMeter cpu_meter_;
  std::optional<tbb::global_control> control_;
  tbb::task_arena arena_;
};

}  // namespace intarsia
