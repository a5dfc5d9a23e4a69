// Operators new and delete of the program: large arrays live side by side in one reserved range of addresses, on huge
// pages, and their memory is handed on when they are freed. Stages make and drop arrays of tens of megabytes; getting
// those from the system, 4 kB at a time and zeroed, costs a sixth of a run. What is kept for reuse never lifts the
// process above the most that was ever in use. Memory that is fresh is fetched by all threads at once: a vector's
// resize would do it on one, which was a sixth of the wall seconds of a run on two threads.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

#include <sys/mman.h>

#include "engine/parallel/populate.h"

namespace {

constexpr std::size_t kLarge = std::size_t{256} << 10;  // bytes; smaller requests are malloc's
constexpr std::size_t kGrain = std::size_t{64} << 10;   // bytes; everything below counts in these
constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kGrains = std::size_t{1} << 22;  // 256 GB of addresses, none of it memory until it is used

// A free stretch of the range. Holes do not overlap; neighbours differ in `resident`.
struct Hole {
  std::size_t at = 0, grains = 0;
  bool resident = false;  // still holds memory
  std::size_t end() const { return at + grains; }
};

class LargeMemory {
 public:
  struct Block {
    char* at = nullptr;     // null if there is no room here
    std::size_t fresh = 0;  // bytes of it that hold no memory yet
  };

  Block take(std::size_t bytes) {
    const std::size_t grains = (bytes + kGrain - 1) / kGrain;
    const std::lock_guard lock(mutex_);
    if (!is_reserved() || is_full()) return {};
    const Place place = best_place(grains);
    if (place.at + grains > kGrains) return {};
    const std::size_t kept = kept_;
    cut(place, grains);
    const std::size_t fresh = grains - (kept - kept_);
    in_use_ += grains;
    ++blocks_;
    most_ = std::max(most_, in_use_);
    while (kept_ > 0 && in_use_ + kept_ > most_) drop(in_use_ + kept_ - most_);
    size_[place.at] = static_cast<std::uint32_t>(grains);
    return {base_.load() + place.at * kGrain, fresh * kGrain};
  }

  // False if the address is not one of ours.
  bool give_back(void* address) {
    const std::uintptr_t a = reinterpret_cast<std::uintptr_t>(address),
                         b = reinterpret_cast<std::uintptr_t>(base_.load(std::memory_order_relaxed));
    if (b == 0 || a < b || a >= b + kGrains * kGrain) return false;
    const std::lock_guard lock(mutex_);
    const std::size_t at = (a - b) / kGrain, grains = size_[at];
    in_use_ -= grains;
    --blocks_;
    kept_ += grains;
    insert({at, grains, true});
    return true;
  }

 private:
  struct Place {
    std::size_t at = 0, first = 0;  // first hole, or holes_ if it begins where all others end
  };

  // Every block may become a hole when it is freed: the table must hold them all.
  bool is_full() const { return blocks_ + holes_ + 4 > hole_.size(); }

  bool is_reserved() {
    if (tried_) return base_.load() != nullptr;
    tried_ = true;
    void* raw = ::mmap(nullptr, kGrains * kGrain + kHugePage, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (raw == MAP_FAILED) return false;
    const std::size_t past = reinterpret_cast<std::uintptr_t>(raw) % kHugePage;
    char* start = static_cast<char*>(raw) + (past > 0 ? kHugePage - past : 0);
    ::madvise(start, kGrains * kGrain, MADV_HUGEPAGE);
    base_.store(start);
    return true;
  }

  // The run of neighbouring holes with most memory in its first `grains`; of equal ones the tightest.
  Place best_place(std::size_t grains) const {
    Place best{top_, holes_};
    std::size_t best_resident = 0, best_size = kGrains;
    for (std::size_t i = 0; i < holes_; ++i) {
      std::size_t size = 0, resident = 0;
      std::size_t k = i;
      for (; k < holes_ && size < grains && (k == i || hole_[k].at == hole_[k - 1].end()); ++k) {
        if (hole_[k].resident) resident += std::min(hole_[k].grains, grains - size);
        size += hole_[k].grains;
      }
      if (size < grains && hole_[k - 1].end() != top_) continue;
      if (resident > best_resident || (resident == best_resident && size >= grains && size < best_size))
        best = {hole_[i].at, i}, best_resident = resident, best_size = std::max(size, grains);
    }
    return best;
  }

  void cut(const Place& place, std::size_t grains) {
    const std::size_t end = place.at + grains;
    std::size_t k = place.first;
    for (; k < holes_ && hole_[k].end() <= end; ++k)
      if (hole_[k].resident) kept_ -= hole_[k].grains;
    if (k < holes_ && hole_[k].at < end) {
      if (hole_[k].resident) kept_ -= end - hole_[k].at;
      hole_[k].grains = hole_[k].end() - end;
      hole_[k].at = end;
    }
    std::copy(hole_.begin() + static_cast<std::ptrdiff_t>(k), hole_.begin() + static_cast<std::ptrdiff_t>(holes_),
              hole_.begin() + static_cast<std::ptrdiff_t>(place.first));
    holes_ -= k - place.first;
    top_ = std::max(top_, end);
  }

  void insert(const Hole& fresh) {
    std::size_t i = 0;
    while (i < holes_ && hole_[i].at < fresh.at) ++i;
    for (std::size_t k = holes_; k > i; --k) hole_[k] = hole_[k - 1];
    ++holes_;
    hole_[i] = fresh;
    join(i + 1);
    if (i > 0) join(i);
  }
  // Joins hole i to the one before it if they touch and are alike.
  void join(std::size_t i) {
    if (i == 0 || i >= holes_ || hole_[i - 1].end() != hole_[i].at || hole_[i - 1].resident != hole_[i].resident)
      return;
    hole_[i - 1].grains += hole_[i].grains;
    for (std::size_t k = i; k + 1 < holes_; ++k) hole_[k] = hole_[k + 1];
    --holes_;
  }

  // Gives memory of the largest resident hole back to the system, from its end.
  void drop(std::size_t grains) {
    std::size_t largest = holes_;
    for (std::size_t i = 0; i < holes_; ++i)
      if (hole_[i].resident && (largest == holes_ || hole_[i].grains > hole_[largest].grains)) largest = i;
    if (largest == holes_) {
      kept_ = 0;
      return;
    }
    Hole& hole = hole_[largest];
    const std::size_t dropped = is_full() ? hole.grains : std::min(hole.grains, grains);
    const Hole gone{hole.end() - dropped, dropped, false};
    ::madvise(base_.load() + gone.at * kGrain, gone.grains * kGrain, MADV_DONTNEED);
    kept_ -= dropped;
    hole.grains -= dropped;
    if (hole.grains == 0) {
      hole = gone;
      join(largest + 1);
      join(largest);
    } else {
      insert(gone);
    }
  }

  std::mutex mutex_;
  bool tried_ = false;
  std::atomic<char*> base_ = nullptr;             // read without the lock by whoever frees
  std::size_t top_ = 0;                           // nothing was ever used from here on
  std::size_t in_use_ = 0, kept_ = 0, most_ = 0;  // grains in use, in resident holes, the most ever in use
  std::array<Hole, 2048> hole_{};                 // by address
  std::size_t blocks_ = 0;
  std::size_t holes_ = 0;
  std::array<std::uint32_t, kGrains> size_{};  // of the block that begins at a grain
};

constinit LargeMemory large_memory;

void* allocate(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t kWorthThreads = 4 * kHugePage;
  for (;;) {
    if (bytes >= kLarge && alignment <= kGrain) {
      const LargeMemory::Block block = large_memory.take(bytes);
      if (block.fresh >= kWorthThreads) intarsia::populate(block.at, bytes);
      if (block.at != nullptr) return block.at;
    }
    void* at = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                   ? std::malloc(bytes > 0 ? bytes : 1)
                   : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (at != nullptr) return at;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void release(void* at) {
  if (!large_memory.give_back(at)) std::free(at);
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes, 1); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* at) noexcept { release(at); }
void operator delete(void* at, std::size_t) noexcept { release(at); }
void operator delete(void* at, std::align_val_t) noexcept { release(at); }
void operator delete(void* at, std::size_t, std::align_val_t) noexcept { release(at); }

#endif
