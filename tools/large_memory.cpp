// Operators new and delete of the program: large arrays come from huge pages and are handed on when they are freed.
// Stages make and drop arrays of tens of megabytes; getting those from the system 4 kB at a time, and zeroed, costs a
// tenth of a run. Memory kept for reuse never lifts the process above the most that was ever in use.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <array>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::size_t kLarge = std::size_t{1} << 20;     // bytes; smaller requests are malloc's
constexpr std::size_t kHugePage = std::size_t{2} << 20;  // also the alignment by which our blocks are known
constexpr std::size_t kPage = 4096;

struct Block {
  char* at = nullptr;
  std::size_t bytes = 0;
};

// Blocks in use and blocks kept, in fixed tables: nothing here may allocate.
class LargeMemory {
 public:
  void* take(std::size_t wanted) {
    const std::size_t bytes = (wanted + kPage - 1) / kPage * kPage;
    const std::lock_guard lock(mutex_);
    if (used_count_ == used_.size()) return nullptr;
    Block block = best_kept(bytes);
    if (block.at == nullptr) {
      make_room(bytes);
      block = map(bytes);
      if (block.at == nullptr) {
        while (kept_count_ > 0) unmap_oldest();
        block = map(bytes);
      }
      if (block.at == nullptr) return nullptr;
    }
    in_use_ += block.bytes;
    most_ = in_use_ > most_ ? in_use_ : most_;
    used_[used_count_++] = block;
    return block.at;
  }

  // False if the address is not one of ours.
  bool give_back(void* at) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = used_count_; i-- > 0;) {
      if (used_[i].at != at) continue;
      const Block block = used_[i];
      used_[i] = used_[--used_count_];
      in_use_ -= block.bytes;
      if (kept_count_ == kept_.size()) unmap_oldest();
      kept_[kept_count_++] = block;
      kept_bytes_ += block.bytes;
      return true;
    }
    return false;
  }

 private:
  // The smallest kept block that fits without wasting more than an eighth.
  Block best_kept(std::size_t bytes) {
    std::size_t best = kept_count_;
    for (std::size_t i = 0; i < kept_count_; ++i)
      if (kept_[i].bytes >= bytes && kept_[i].bytes <= bytes + bytes / 8 &&
          (best == kept_count_ || kept_[i].bytes < kept_[best].bytes))
        best = i;
    return best == kept_count_ ? Block{} : forget(best);
  }
  void make_room(std::size_t bytes) {
    while (kept_count_ > 0 && in_use_ + kept_bytes_ + bytes > most_) unmap_oldest();
  }
  void unmap_oldest() {
    const Block block = forget(0);
    ::munmap(block.at, block.bytes);
  }
  Block forget(std::size_t i) {
    const Block block = kept_[i];
    kept_bytes_ -= block.bytes;
    for (--kept_count_; i < kept_count_; ++i) kept_[i] = kept_[i + 1];
    return block;
  }
  static Block map(std::size_t bytes) {
    void* raw = ::mmap(nullptr, bytes + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (raw == MAP_FAILED) return {};
    char* const start = static_cast<char*>(raw);
    const std::size_t skip = (kHugePage - reinterpret_cast<std::uintptr_t>(raw) % kHugePage) % kHugePage;
    if (skip > 0) ::munmap(start, skip);
    if (skip < kHugePage) ::munmap(start + skip + bytes, kHugePage - skip);
    ::madvise(start + skip, bytes, MADV_HUGEPAGE);
    return {start + skip, bytes};
  }

  std::mutex mutex_;
  std::array<Block, 4096> used_{};
  std::array<Block, 64> kept_{};
  std::size_t used_count_ = 0, kept_count_ = 0;
  std::size_t in_use_ = 0, kept_bytes_ = 0, most_ = 0;
};

constinit LargeMemory large_memory;

void* allocate(std::size_t bytes, std::size_t alignment) {
  for (;;) {
    if (bytes >= kLarge && alignment <= kHugePage)
      if (void* at = large_memory.take(bytes)) return at;
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
  if (reinterpret_cast<std::uintptr_t>(at) % kHugePage == 0 && at != nullptr && large_memory.give_back(at)) return;
  std::free(at);
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
