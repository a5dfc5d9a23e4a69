// The nodes of a run as a Chrome trace (load it in chrome://tracing or Perfetto).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/run/record.h"

namespace intarsia {

struct TracedRun {
  std::string name;
  const RunRecord* record;
};

// {"traceEvents": [...]}: one complete event ("ph": "X") per node, in order of start, times in microseconds since the
// first run's start; pid = run,
// tid = place of the thread in the arena; args hold items, bytes, hash and CPU seconds.
nlohmann::json chrome_trace(const std::vector<TracedRun>& runs);

}  // namespace intarsia
