#include "kernels/patches/least_first.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "engine/base/random.h"

using namespace intarsia;

TEST_CASE("entries leave in the order of (key, first, second), negative keys and both zeros too") {
  const Random random(1, 2);
  using Entry = std::tuple<Real, Index, Index>;
  std::vector<Entry> all;
  kernels::LeastFirst queue;
  for (Index i = 0; i < 5000; ++i) {
    const Real u = random.uniform(i);
    const Real key = u < 0.1 ? -0.0 : u < 0.2 ? 0.0 : u < 0.3 ? 1.0 : (u - 0.6) * 1e3;
    all.emplace_back(key, static_cast<Index>(random.bits(i, 1) % 50), static_cast<Index>(random.bits(i, 2) % 50));
    queue.push(key, std::get<1>(all.back()), std::get<2>(all.back()));
  }
  std::sort(all.begin(), all.end());
  std::size_t wrong = 0;
  for (const auto& [key, first, second] : all) {
    REQUIRE_FALSE(queue.empty());
    const auto e = queue.pop();
    wrong += !(e.value() == key && e.first() == first && e.second() == second);
  }
  CHECK(wrong == 0);
  CHECK(queue.empty());
}
