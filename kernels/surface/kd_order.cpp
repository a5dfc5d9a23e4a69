#include "kernels/surface/kd_order.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <vector>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

// Read and written whole, also by loops that cannot know which of two places is meant.
struct alignas(32) Entry {
  Real p[3];
  Index id;
};

// Points that agree in position, and how they are told apart. Ties are noted here: whatever selects or sorts must
// compare neighbours in the final order at last, so none escapes.
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

// By the coordinate on the axis, the other two, and rank.
struct Less {
  Ties* ties;
  int axis;
  bool operator()(const Entry& a, const Entry& b) const {
    for (int i = 0; i < 3; ++i) {
      const int k = (axis + i) % 3;
      if (a.p[k] != b.p[k]) return a.p[k] < b.p[k];
    }
    return ties->less(a, b);
  }
};

// Moves what `goes_first` to the front and returns its number. No branch depends on an entry: with std::nth_element,
// two thirds of the time went into branches that were predicted wrongly.
template <class GoesFirst>
std::size_t partition(std::span<Entry> part, const GoesFirst& goes_first) {
  std::size_t front = 0;
  Entry* const e = part.data();
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Entry here = e[i], other = e[front];
    e[i] = other;
    e[front] = here;
    front += goes_first(here);
  }
  return front;
}

// A coordinate near the one that belongs at place `at`: from a sample, whose size grows with the part.
Real pivot_near(std::span<const Entry> part, std::size_t at, int axis) {
  constexpr std::size_t kMost = 255;
  std::array<Real, kMost> sample;
  std::size_t size = part.size() < 200 ? 3 : part.size() < 2000 ? 7 : part.size() < 50000 ? 31 : kMost;
  for (std::size_t i = 0; i < size; ++i) sample[i] = part[(2 * i + 1) * part.size() / (2 * size)].p[axis];
  std::sort(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(size));
  return sample[at * size / part.size()];
}

// Rearranges the part so that what is before place `at` is less than what is not, by axis and the `order`-th
// coordinates after it.
void select(std::span<Entry> part, std::size_t at, int axis, int order, Ties& ties) {
  constexpr int kMostRounds = 100;  // never seen: bounds the time where samples mislead
  const auto by_all = [&](int a) {
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(at), part.end(), Less{&ties, a});
  };
  const int k = (axis + order) % 3;
  for (int round = 0; at > 0 && at < part.size(); ++round) {
    if (order == 3 || round == kMostRounds) return by_all(axis);
    const Real pivot = pivot_near(part, at, k);
    const std::size_t below = partition(part, [&](const Entry& e) { return e.p[k] < pivot; });
    if (at <= below) {
      part = part.first(below);
    } else if (below > 0) {
      part = part.subspan(below), at -= below;
    } else {  // the pivot is the least: what equals it is told apart by the next coordinate
      const std::size_t equal = partition(part, [&](const Entry& e) { return e.p[k] <= pivot; });
      if (at < equal) return select(part.first(equal), at, axis, order + 1, ties);
      part = part.subspan(equal), at -= equal;
    }
  }
}

// At most kRun entries in order.
constexpr std::size_t kRun = 8;
void sort_run(std::span<Entry> part, int axis, Ties& ties) {
  std::array<Entry, kRun> old;
  std::array<std::size_t, kRun> place{};
  bool tie = false;
  for (std::size_t i = 0; i < part.size(); ++i) {  // by counting: branches on the order cannot be predicted
    old[i] = part[i];
    for (std::size_t j = 0; j < i; ++j) {
      const bool after = old[j].p[axis] < old[i].p[axis];
      tie |= old[j].p[axis] == old[i].p[axis];
      place[i] += after, place[j] += !after;
    }
  }
  if (tie) return std::sort(part.begin(), part.end(), Less{&ties, axis});
  for (std::size_t i = 0; i < part.size(); ++i) part[place[i]] = old[i];
}

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

void split(const Work& work, std::span<Entry> part, Ties& ties) {
  constexpr std::size_t kParallel = 4096;
  while (part.size() > kRun) {
    if (work.cancelled()) return;
    const std::size_t at = split_position(part.size());
    select(part, at, longest_axis(part), 0, ties);
    const auto left = part.first(at), right = part.subspan(at);
    if (part.size() > kParallel)
      return in_parallel([&] { split(work, left, ties); }, [&] { split(work, right, ties); });
    split(work, left, ties);
    part = right;
  }
  if (part.size() > 1) sort_run(part, longest_axis(part), ties);
}

}  // namespace

bool kd_order(const Work& work, const Vec3View& point, std::span<const Index> rank, std::span<Index> order) {
  std::vector<Entry> entries(point.size());
  for_each(work, Cost::light, point.size(), [&](std::size_t i) {
    entries[i] = {{point.x[i], point.y[i], point.z[i]}, static_cast<Index>(i)};
  });
  Ties ties{rank, {}};
  split(work, entries, ties);
  work.check();
  for_each(work, Cost::light, point.size(), [&](std::size_t i) { order[i] = entries[i].id; });
  return !ties.found.load();
}

}  // namespace intarsia::kernels
