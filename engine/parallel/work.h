// What a kernel may know of the run: whether to stop, and how far it has come.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "engine/base/error.h"

namespace intarsia {

// fixed: results are a function of the input only. relaxed: exists to show what that costs.
enum class Order : std::uint8_t { fixed = 0, relaxed = 1 };

// Block size by the cost of one item; never a function of the thread count.
enum class Cost : std::size_t { light = 4096, medium = 512, heavy = 64, single = 1 };

class Work {
 public:
  Work() = default;
  // stop: a second reason to stop, for example that another stage of the same run has failed.
  Work(const std::atomic<bool>* cancel, std::atomic<std::uint64_t>* done, Order order,
       const std::atomic<bool>* stop = nullptr)
      : cancel_(cancel), stop_(stop), done_(done), order_(order) {}

  bool cancelled() const {
    return (cancel_ && cancel_->load(std::memory_order_relaxed)) || (stop_ && stop_->load(std::memory_order_relaxed));
  }
  // Throws ErrorCode::cancelled if the run was asked to stop. Serial loops poll this every few thousand items.
  void check() const {
    if (cancelled()) throw Error(ErrorCode::cancelled, "the run was cancelled");
  }
  // Whether the run's time is nearly up. Loops that only improve what is valid already ask before every round, and stop
  // if so: then the stage's output is no longer a function of its inputs and options.
  bool is_late() const {
    if (!late_ || !late_->load(std::memory_order_relaxed)) return false;
    if (shortened_) shortened_->store(true, std::memory_order_relaxed);
    return true;
  }
  // late: is_late() from when it is set. shortened: set when somebody was told so.
  void watch(const std::atomic<bool>* late, std::atomic<bool>* shortened) { late_ = late, shortened_ = shortened; }
  void tick(std::uint64_t items) const {
    if (done_) done_->fetch_add(items, std::memory_order_relaxed);
  }
  Order order() const { return order_; }  // read by engine/parallel only

 private:
  const std::atomic<bool>* cancel_ = nullptr;
  const std::atomic<bool>* stop_ = nullptr;
  const std::atomic<bool>* late_ = nullptr;
  std::atomic<bool>* shortened_ = nullptr;
  std::atomic<std::uint64_t>* done_ = nullptr;
  Order order_ = Order::fixed;
};

}  // namespace intarsia
