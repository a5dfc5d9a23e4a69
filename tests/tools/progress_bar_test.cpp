#include "tools/progress_bar.h"

#include <doctest/doctest.h>

using namespace intarsia::tools;

TEST_CASE("time left: in proportion to what is done, unknown at first") {
  CHECK(seconds_left(10, 0.25) == doctest::Approx(30));
  CHECK(seconds_left(10, 1) == 0);
  CHECK(seconds_left(10, 0.01) < 0);
  CHECK(seconds_left(0.1, 0.5) < 0);
}

TEST_CASE("durations in words") {
  CHECK(duration_text(0.2) == "1 s");
  CHECK(duration_text(42) == "42 s");
  CHECK(duration_text(180) == "3 min");
  CHECK(duration_text(9000) == "2.5 h");
}
