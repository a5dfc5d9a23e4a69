#include "engine/run/context.h"

#include <tbb/info.h>

namespace intarsia {
namespace {

int effective_threads(int asked) {
  if (asked < 0 || asked > kMostThreads)
    throw Error(ErrorCode::bad_argument, "the number of threads must be 0 (all) to " + std::to_string(kMostThreads));
  return asked > 0 ? asked : tbb::info::default_concurrency();
}

}  // namespace

RunContext::RunContext(const RunSettings& settings, std::atomic<bool>* cancel)
    : settings_(settings),
      threads_(effective_threads(settings.threads)),
      cancel_(cancel ? cancel : &own_cancel_),
      arena_(threads_) {
  // Without a control of its own an arena never has more threads than there are processors.
  if (settings.whole_process || threads_ > tbb::info::default_concurrency())
    control_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
}

}  // namespace intarsia
