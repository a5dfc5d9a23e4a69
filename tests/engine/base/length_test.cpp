#include "engine/base/length.h"

#include <doctest/doctest.h>

#include "engine/base/error.h"

using namespace intarsia;

TEST_CASE("three units") {
  CHECK(parse_length("1.5").in_diagonals(10, 0.01) == doctest::Approx(0.15));
  CHECK(parse_length("0.2%").in_diagonals(10, 0.01) == doctest::Approx(0.002));
  CHECK(parse_length("3e").in_diagonals(10, 0.01) == doctest::Approx(0.03));
  CHECK(parse_length("0").in_diagonals(10, 0.01) == 0);
  for (const char* text : {"1.5", "0.2%", "3e", "1e-05"}) CHECK(text_of(parse_length(text)) == text);
}

TEST_CASE("what is no length") {
  for (const char* text : {"", "x", "1.5mm", "-1", "nan", "inf", "1 %", "%", "2%%", "1,5"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_length(text), Error);
  }
}
