// CPU seconds of stages that may overlap.
#pragma once

#include <mutex>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

Real wall_seconds();         // monotone clock
Real process_cpu_seconds();  // user + system, all threads

// Between two events the process's CPU time is shared out equally among the nodes then running: exact for a node that
// runs alone, and the nodes' sum is always the time really spent while any node ran.
class CpuMeter {
 public:
  struct Share {
    Real seconds = 0;
  };
  void begin(Share& share);
  void end(Share& share);

 private:
  void settle();
  std::mutex mutex_;
  std::vector<Share*> running_;
  Real last_ = 0;
};

}  // namespace intarsia
