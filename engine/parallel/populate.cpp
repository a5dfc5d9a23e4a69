#include "engine/parallel/populate.h"

#include <algorithm>

#ifdef __linux__
#include <sys/mman.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifndef MADV_POPULATE_WRITE
#define MADV_POPULATE_WRITE 23
#endif
#endif

namespace intarsia {

#ifdef __linux__
void populate(void* at, std::size_t bytes) noexcept {
  constexpr std::size_t kStep = std::size_t{8} << 20;  // a few huge pages
  try {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, (bytes + kStep - 1) / kStep, [&](std::size_t i) {
        ::madvise(static_cast<char*>(at) + i * kStep, std::min(kStep, bytes - i * kStep), MADV_POPULATE_WRITE);
      });
    });
  } catch (...) {  // no room for a task: the first touch does it
  }
}
#else
void populate(void*, std::size_t) noexcept {}
#endif

}  // namespace intarsia
