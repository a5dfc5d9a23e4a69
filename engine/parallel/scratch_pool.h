// Large scratch objects that blocks of a parallel loop borrow and give back. At most one per thread is ever made.
// Scratch must not carry anything from one block to the next that could change a result.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace intarsia {

template <class T, class Make>
class ScratchPool {
 public:
  explicit ScratchPool(Make make) : make_(std::move(make)) {}

  class Loan {
   public:
    Loan(ScratchPool& pool, std::unique_ptr<T> item) : pool_(&pool), item_(std::move(item)) {}
    Loan(Loan&&) noexcept = default;
    ~Loan() {
      if (item_) pool_->give_back(std::move(item_));
    }
    T& operator*() const { return *item_; }
    T* operator->() const { return item_.get(); }

   private:
    ScratchPool* pool_;
    std::unique_ptr<T> item_;
  };

  Loan borrow() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        Loan loan(*this, std::move(idle_.back()));
        idle_.pop_back();
        return loan;
      }
    }
    return Loan(*this, std::make_unique<T>(make_()));
  }

 private:
  void give_back(std::unique_ptr<T> item) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(item));
  }
  Make make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

// pool(make): make() -> T.
template <class Make>
auto make_scratch_pool(Make make) {
  using T = decltype(make());
  return ScratchPool<T, Make>(std::move(make));
}

}  // namespace intarsia
