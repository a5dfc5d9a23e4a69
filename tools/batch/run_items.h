// Running the meshes of a batch as processes of their own: whole meshes side by side while they are small, all threads
// inside one that is large, never more memory than there is. A mesh whose run crashes or is refused stops no other.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/batch/item.h"
#include "tools/forecast.h"

namespace intarsia::tools {

struct BatchPlan {
  std::filesystem::path program, results;
  std::vector<std::string> run_options;  // handed on to `intarsia run`
  int threads = 1;                       // in all
  int jobs = 1;                          // most meshes side by side
  std::uint64_t memory = 0;              // bytes in all; 0 = no limit
  double large_seconds = 4;              // CPU seconds of a mesh that gets all threads for itself
};

struct BatchCount {
  std::size_t done = 0, failed = 0, left = 0;  // left: not begun, because of an interruption or wrong options
  bool wrong_options = false;                  // the run's options are refused: the first refusal ends the batch
};

using ForecastOf = std::function<Forecast(const std::filesystem::path&)>;
using OnItem = std::function<void(const BatchItem&, const ItemRecord&)>;

// Runs the items, large ones first, and writes a record for each. A mesh that needs more memory than the plan has by
// forecast is not begun: exit status 6. on_item is called after each, in the order in which they end.
// stop: set by an interrupt; running meshes are interrupted too and get no record.
BatchCount run_items(const std::vector<BatchItem>& items, const BatchPlan& plan, const ForecastOf& forecast_of,
                     const OnItem& on_item, const std::atomic<bool>& stop);

}  // namespace intarsia::tools
