#include "engine/run/time_limit.h"

#include <algorithm>
#include <chrono>

namespace intarsia {

TimeLimit::TimeLimit(RunContext& context, Real seconds)
    : context_(context), thread_([this, seconds] { watch(seconds); }) {}

TimeLimit::~TimeLimit() {
  disarm();
  thread_.join();
}

void TimeLimit::disarm() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_all();
}

void TimeLimit::watch(Real seconds) {
  constexpr Real kLongest = 1e8;  // three years: clocks do not count much further
  const auto begin = std::chrono::steady_clock::now();
  const auto after = [&](Real share) {
    return begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                       std::chrono::duration<Real>(share * std::min(seconds, kLongest)));
  };
  std::unique_lock lock(mutex_);
  if (wake_.wait_until(lock, after(kLateShare), [&] { return done_; })) return;
  context_.hurry();
  if (wake_.wait_until(lock, after(1), [&] { return done_; })) return;
  expired_ = true;
  context_.cancel();
}

}  // namespace intarsia
