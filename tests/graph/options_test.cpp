#include <set>
#include <string>

#include <doctest/doctest.h>

#include "graph/layout_graph.h"
#include "graph/visit_options.h"

using namespace intarsia;
using namespace intarsia::graph;

TEST_CASE("every option has a name of its own, help, and a default inside its range in both modes") {
  for (LayoutOptions options : {robust_options(), paper_options(1)}) {
    std::set<std::string> names;
    visit_options(options, [&](const char* name, const auto&, const char* help, auto least, auto most) {
      CAPTURE(name);
      CHECK(names.insert(name).second);
      CHECK(std::string(help).size() > 10);
      CHECK(static_cast<Real>(least) < static_cast<Real>(most));
    });
    CHECK_NOTHROW(check_options(options));
  }
}

TEST_CASE("a value out of range is refused by name") {
  LayoutOptions options = robust_options();
  options.extension.cone = 200;
  try {
    check_options(options);
    FAIL("accepted");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    CHECK(std::string(e.what()).find("extend.cone") != std::string::npos);
  }
}

TEST_CASE("paper mode sets the bracketed values") {
  const LayoutOptions o = paper_options(3);
  CHECK(o.scale.select.slack == 0);
  CHECK_FALSE(o.scale.discs);
  CHECK_FALSE(o.curvature.fit.refine_normals);
  CHECK_FALSE(o.sharp.enabled);
  CHECK(o.extension.feedback == 0);
  CHECK(o.extension.paper_queue);
  CHECK_FALSE(o.subdivide.discs);
  CHECK(o.subdivide.split.literal);
  CHECK(o.subdivide.split.random_seeds);
}
