// Small inputs whose layouts are known, through all stages.
#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::test;

TEST_CASE("a box of twelve triangles has six sides") {
  for (const Index n : {1, 2, 4}) {
    const LayoutRun run = run_layout(cube(n), graph::robust_options());
    CHECK(run.layout->labels.count == 6);
    CHECK(run.layout->graph.arc_count() == 12);
    CHECK(run.layout->graph.node_count() == 8);
    CHECK(run.layout->checks.is_valid());
  }
}
