#include "engine/run/cpu_meter.h"

#include <algorithm>
#include <chrono>

#include <time.h>

namespace intarsia {

Real wall_seconds() { return std::chrono::duration<Real>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Real process_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

void CpuMeter::settle() {
  const Real now = process_cpu_seconds();
  for (Share* share : running_) share->seconds += (now - last_) / static_cast<Real>(running_.size());
  last_ = now;
}

void CpuMeter::begin(Share& share) {
  const std::lock_guard lock(mutex_);
  settle();
  running_.push_back(&share);
}

void CpuMeter::end(Share& share) {
  const std::lock_guard lock(mutex_);
  settle();
  running_.erase(std::find(running_.begin(), running_.end(), &share));
}

}  // namespace intarsia
