#include "kernels/scale/select_scale.h"

#include <vector>

#include <doctest/doctest.h>

using namespace intarsia;
using namespace intarsia::kernels;

namespace {
using Row = std::vector<Real>;
int robust(const Row& w) { return choose_ring(w, SelectOptions{}).ring; }
int paper(const Row& w) { return choose_ring(w, SelectOptions::paper()).ring; }
}  // namespace

TEST_CASE("flat, bent and the third case") {
  const SelectOptions o;
  CHECK(choose_ring(Row{0, 0, .05, .09, .12, .3}, o).bend == Bend::flat);
  CHECK(choose_ring(Row{0, 0, 0, .12, .2, .3}, o).bend == Bend::between);
  CHECK(choose_ring(Row{0, 0, .108, .239, .340, .420}, o).bend == Bend::bent);
  CHECK(robust(Row{0, 0, .05, .09, .12, .3}) == 1);
  CHECK(paper(Row{0, 0, .05, .09, .12, .3}) == 1);
}

TEST_CASE("a right-angled crease seen from 0 to 4 edges away") {
  const Row row[5] = {{.722, .792, .855, .886, .908, .922},
                      {0, .289, .462, .571, .644, .697},
                      {0, 0, .108, .239, .340, .420},
                      {0, 0, 0, .056, .138, .224},
                      {0, 0, 0, 0, .05, .11}};
  const int expected[5] = {1, 2, 4, 1, 1};
  for (int d = 0; d < 5; ++d) {
    CHECK(robust(row[d]) == expected[d]);
    CHECK(paper(row[d]) == expected[d]);
  }
}

TEST_CASE("the third case: jump, or the letter") {
  CHECK(robust(Row{0, 0, 0, .12, .2, .3}) == 4);
  CHECK(paper(Row{0, 0, 0, .12, .2, .3}) == 5);
  CHECK(robust(Row{.5, .4, .3, .02, .02, .02}) == 3);
  CHECK(paper(Row{.5, .4, .3, .02, .02, .02}) == 3);
}

TEST_CASE("ties go to the smallest ring, thresholds count as reached") {
  CHECK(robust(Row{.1, .1, .1, .1, .1, .1}) == 1);
  CHECK(paper(Row{.1, .1, .1, .1, .1, .1}) == 1);
  CHECK(choose_ring(Row{.1, .1, .1, .1, .1, .1}, SelectOptions{}).bend == Bend::bent);
}

TEST_CASE("slack prefers small rings where omega saturates below the target") {
  const Row on{.165, .168, .170, .171, .171, .1715};
  CHECK(paper(on) == 6);
  CHECK(robust(on) == 1);
}

TEST_CASE("fillets of 1 to 8 edges: 1, 2, 4 and flat") {
  CHECK(robust(Row{.27, .50, .63, .71, .76, .80}) == 1);
  CHECK(robust(Row{.07, .27, .43, .53, .61, .66}) == 2);
  CHECK(robust(Row{.02, .07, .17, .28, .37, .44}) == 4);
  CHECK(robust(Row{.00, .02, .04, .07, .12, .17}) == 1);
}

TEST_CASE("discs: the closest to the target, none where nothing bends") {
  const SelectOptions o;
  CHECK(choose_disc(Row{.11, .22, .40}, 9, o) == 10);
  CHECK(choose_disc(Row{.02, .05, .09}, 9, o) == 0);
  CHECK(choose_disc(Row{.4}, 9, o) == 9);
  CHECK(choose_disc(Row{}, 9, o) == 0);
}

TEST_CASE("lower median over the closed neighbourhood, zeros left out") {
  // A path 0 - 1 - 2 - 3 - 4.
  const Csr path{{0, 1, 3, 5, 7, 8}, {1, 0, 2, 1, 3, 2, 4, 3}};
  std::vector<std::uint8_t> out(5);
  median_over_neighbours(Work{}, path, std::vector<std::uint8_t>{5, 1, 6, 2, 3}, out);
  CHECK(out == std::vector<std::uint8_t>{1, 5, 2, 3, 2});
  median_over_neighbours(Work{}, path, std::vector<std::uint8_t>{0, 9, 0, 7, 11}, out);
  CHECK(out == std::vector<std::uint8_t>{0, 9, 0, 7, 7});
}
