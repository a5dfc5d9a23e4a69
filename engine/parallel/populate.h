#pragma once

#include <cstddef>

namespace intarsia {

// Fetches the memory behind a range of addresses from the system, on all threads of the caller's arena, before anything
// is written there; what the range holds stays as it is. The thread that waits meanwhile runs no other task, so locks
// may be held. Where the system does not know the request (Linux before 5.14), the first touch does it as ever.
// Requires: `at` on a page boundary, a range that may be written.
void populate(void* at, std::size_t bytes) noexcept;

}  // namespace intarsia
