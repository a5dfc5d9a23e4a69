#include "kernels/surface/kd_order.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

struct Entry {
  Real p[3];
  Index id;
};

// Ties are noted here. Any sort or selection must compare neighbours in the final order directly, so none escapes.
struct Ties {
  std::span<const Index> rank;
  std::atomic<bool> found{false};

  bool less(const Entry& a, const Entry& b) {
    if (a.id == b.id) return false;
    if (!rank.empty() && rank[a.id] != rank[b.id]) return rank[a.id] < rank[b.id];
    found.store(true, std::memory_order_relaxed);
    return a.id < b.id;
  }
};

template <int kAxis>
struct Less {
  Ties* ties;
  bool operator()(const Entry& a, const Entry& b) const {
    constexpr int j = (kAxis + 1) % 3, k = (kAxis + 2) % 3;
    if (a.p[kAxis] != b.p[kAxis]) return a.p[kAxis] < b.p[kAxis];
    if (a.p[j] != b.p[j]) return a.p[j] < b.p[j];
    if (a.p[k] != b.p[k]) return a.p[k] < b.p[k];
    return ties->less(a, b);
  }
};

int longest_axis(std::span<const Entry> part) {
  constexpr Real inf = std::numeric_limits<Real>::infinity();
  Real low[3] = {inf, inf, inf}, high[3] = {-inf, -inf, -inf};
  for (const Entry& e : part)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], e.p[i]), high[i] = std::max(high[i], e.p[i]);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  return axis;
}

// Where a part of n > 8 points is split: near the middle, at a multiple of the largest run that still divides it.
std::size_t split_position(std::size_t n) {
  const std::size_t run = n > 256 ? 256 : n > 64 ? 64 : n > 32 ? 32 : n > 16 ? 16 : 8;
  const std::size_t middle = (n / 2 + run / 2) / run * run;
  return std::max(middle, run);
}

class Splitter {
 public:
  Splitter(const Work& work, Ties& ties) : work_(work), ties_(ties) {}

  void run(std::span<Entry> part) const {
    while (part.size() > kRun) {
      if (work_.cancelled()) return;
      const std::size_t at = split_position(part.size());
      select(part, at);
      const auto left = part.first(at), right = part.subspan(at);
      if (part.size() > kParallel) return in_parallel([&] { run(left); }, [&] { run(right); });
      run(left);
      part = right;
    }
    sort(part);
  }

 private:
  static constexpr std::size_t kRun = 8, kParallel = 4096;

  void select(std::span<Entry> part, std::size_t at) const {
    const auto split = [&](auto less) {
      std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(at), part.end(), less);
    };
    switch (longest_axis(part)) {
      case 0:
        return split(Less<0>{&ties_});
      case 1:
        return split(Less<1>{&ties_});
      default:
        return split(Less<2>{&ties_});
    }
  }
  void sort(std::span<Entry> part) const {
    switch (longest_axis(part)) {
      case 0:
        return std::sort(part.begin(), part.end(), Less<0>{&ties_});
      case 1:
        return std::sort(part.begin(), part.end(), Less<1>{&ties_});
      default:
        return std::sort(part.begin(), part.end(), Less<2>{&ties_});
    }
  }

  const Work& work_;
  Ties& ties_;
};

}  // namespace

bool kd_order(const Work& work, const Vec3View& point, std::span<const Index> rank, std::span<Index> order) {
  std::vector<Entry> entries(point.size());
  for_each(work, Cost::light, point.size(), [&](std::size_t i) {
    entries[i] = {{point.x[i], point.y[i], point.z[i]}, static_cast<Index>(i)};
  });
  Ties ties{rank, {}};
  Splitter(work, ties).run(entries);
  work.check();
  for_each(work, Cost::light, point.size(), [&](std::size_t i) { order[i] = entries[i].id; });
  return !ties.found.load();
}

}  // namespace intarsia::kernels
