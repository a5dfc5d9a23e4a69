// Runs a function with a given number of worker threads, for tests that compare results between thread counts.
#pragma once

#include <cstddef>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace intarsia::test {

template <class F>
auto run_with_threads(int threads, F&& f) {
  // More threads than cores are allowed on purpose: interleavings matter here, not speed.
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute([&] { return f(); });
}

}  // namespace intarsia::test
