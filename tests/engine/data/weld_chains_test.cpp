#include "engine/data/weld_chains.h"

#include <doctest/doctest.h>

using namespace intarsia;

namespace {

Csr rows(const std::vector<std::vector<Index>>& r) {
  Csr csr{{0}, {}};
  for (const auto& row : r) {
    csr.item.insert(csr.item.end(), row.begin(), row.end());
    csr.offset.push_back(static_cast<Index>(csr.item.size()));
  }
  return csr;
}

std::vector<Index> mates(Index chains, const std::vector<std::pair<Index, Index>>& pairs) {
  std::vector<Index> mate(2 * chains, kNone);
  for (auto [a, b] : pairs) mate[a] = b, mate[b] = a;
  return mate;
}

}  // namespace

TEST_CASE("chains without mates stay as they are") {
  const Csr in = rows({{5, 4}, {1, 2, 3}});
  const auto out = weld_chains(in, mates(2, {}));
  CHECK(out.chain == in);
  CHECK(out.source == std::vector<Index>{0, 1});
}

TEST_CASE("chains are turned and joined; a shared item appears once") {
  // 0: 1-2, 1: 7-2 (joined back to back), 2: 7-9 (front to front of 1), 3 apart
  const auto out = weld_chains(rows({{1, 2}, {7, 2}, {7, 9}, {4, 5}}), mates(4, {{1, 3}, {2, 4}}));
  CHECK(out.chain == rows({{1, 2, 7, 9}, {4, 5}}));
  CHECK(out.source == std::vector<Index>{0, 3});
}

TEST_CASE("joined ends with different items become neighbours") {
  const auto out = weld_chains(rows({{1, 2}, {3, 4}}), mates(2, {{1, 2}}));
  CHECK(out.chain == rows({{1, 2, 3, 4}}));
}

TEST_CASE("a path found from its middle starts at its end") {
  const auto out = weld_chains(rows({{2, 3}, {1, 2}, {3, 4}}), mates(3, {{0, 3}, {1, 4}}));
  CHECK(out.chain == rows({{1, 2, 3, 4}}));
  CHECK(out.source == std::vector<Index>{0});
}

TEST_CASE("closing one chain and several") {
  CHECK(weld_chains(rows({{1, 2, 3}}), mates(1, {{0, 1}})).chain == rows({{1, 2, 3, 1}}));
  CHECK(weld_chains(rows({{1, 2}, {3, 2}, {3, 1}}), mates(3, {{1, 3}, {2, 4}, {5, 0}})).chain == rows({{1, 2, 3, 1}}));
}
