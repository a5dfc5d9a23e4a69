#include "engine/base/nearest_word.h"

#include <doctest/doctest.h>

using namespace intarsia;

TEST_CASE("the nearest word is the one with the fewest changed letters") {
  CHECK(nearest_word("htlm", {"vtp", "html", "seg"}) == "html");
  CHECK(nearest_word("b", {"a", "c"}) == "a");
  CHECK(nearest_word("a", {}).empty());
}

TEST_CASE("a likely word is near or holds what was typed; else there is none") {
  const std::vector<std::string> known = {"--patches", "--scale.flat", "--extend.max-length", "--seed"};
  CHECK(likely_word("--pathces", known) == "--patches");
  CHECK(likely_word("--patch", known) == "--patches");
  CHECK(likely_word("--max-length", known) == "--extend.max-length");
  CHECK(likely_word("--banana", known).empty());
}
