// Same input and options: the same bits on any number of threads, stage by stage, and for any order of the input.
#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tests/support/shapes.h"
#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

Soup sample(const char* shape, std::uint64_t triangles) {
  tools::MakeOptions o;
  o.shape = shape, o.triangles = triangles, o.irregularity = 0.4, o.noise_edges = 0.05;
  return tools::make_shape(Work(), o);
}

std::string first_difference(const LayoutRun& a, const LayoutRun& b) {
  REQUIRE(a.stages.size() == b.stages.size());
  for (std::size_t i = 0; i < a.stages.size(); ++i)
    if (a.stages[i].hash != b.stages[i].hash) return a.stages[i].name;
  return "none";
}

}  // namespace

TEST_CASE("1, 2, 3 and 8 threads give the same bits in every stage") {
  for (const char* shape : {"part", "star", "head", "half-pipe"}) {
    CAPTURE(shape);
    const Soup soup = sample(shape, 12'000);
    for (const Index patches : {0u, 30u}) {
      CAPTURE(patches);
      graph::LayoutOptions options = graph::robust_options();
      options.patches = patches;
      RunSettings one;
      one.threads = 1;
      const LayoutRun reference = run_layout(soup, options, one);
      CHECK(reference.layout->checks.is_valid());
      for (const int threads : {2, 3, 8}) {
        CAPTURE(threads);
        RunSettings many;
        many.threads = threads;
        CHECK(first_difference(reference, run_layout(soup, options, many)) == "none");
      }
    }
  }
}

TEST_CASE("paper mode is reproducible too, and its seed matters only there") {
  const Soup soup = sample("part", 12'000);
  RunSettings one, three;
  one.threads = 1, three.threads = 3;
  const LayoutRun a = run_layout(soup, graph::paper_options(1), one);
  CHECK(a.layout->checks.is_valid());
  CHECK(first_difference(a, run_layout(soup, graph::paper_options(1), three)) == "none");
}

TEST_CASE("vertices and faces of the input in any order: the same surface and the same layout") {
  for (const char* shape : {"part", "star", "head", "half-pipe"}) {
    CAPTURE(shape);
    const Soup soup = sample(shape, 12'000);
    const LayoutRun a = run_layout(soup, graph::robust_options());
    const LayoutRun b = run_layout(shuffle(soup, 7), graph::robust_options());
    CHECK(hash_of(*a.layout) == hash_of(*b.layout));
    CHECK(a.surface->mesh.x == b.surface->mesh.x);
    CHECK(a.surface->mesh.corner == b.surface->mesh.corner);
  }
}
