// The three ways of reaching a wanted number of patches: exactly that many discs, and the same bits on any number of
// threads.
#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::test;
using graph::SubdivideForm;

namespace {

Soup sample(const char* shape) {
  tools::MakeOptions o;
  o.shape = shape, o.triangles = 3'000, o.irregularity = 0.4, o.noise_edges = 0.05;
  return tools::make_shape(Work(), o);
}

LayoutRun run_form(const Soup& soup, SubdivideForm form, Index patches, int threads) {
  graph::LayoutOptions options = graph::robust_options();
  options.form = form, options.patches = patches;
  options.refine.rounds = 1, options.refine.swap.sweeps = 2, options.refine.even.per_patch = 5;  // quick
  RunSettings settings;
  settings.threads = threads;
  return run_layout(soup, options, settings);
}

}  // namespace

TEST_CASE("compact, quality and faithful give exactly the wanted number of discs, the same for 1 and 3 threads") {
  for (const char* shape : {"part", "star"}) {
    const Soup soup = sample(shape);
    for (const auto& [form, word] :
         {std::pair{SubdivideForm::compact, "compact"}, std::pair{SubdivideForm::quality, "quality"},
          std::pair{SubdivideForm::faithful, "faithful"}}) {
      const char* name = word;
      CAPTURE(shape);
      CAPTURE(name);
      const Index wanted = 14;
      const LayoutRun one = run_form(soup, form, wanted, 1), three = run_form(soup, form, wanted, 3);
      CHECK(one.layout->labels.count == wanted);
      CHECK(one.layout->checks.is_valid());
      for (Index p = 0; p < one.layout->table.count(); ++p) CHECK(one.layout->table.is_disc(p));
      REQUIRE(one.stages.size() == three.stages.size());
      for (std::size_t i = 0; i < one.stages.size(); ++i) {
        CAPTURE(one.stages[i].name);
        CHECK(one.stages[i].hash == three.stages[i].hash);
      }
    }
  }
}

TEST_CASE("without a number the forms agree with the checks and quality keeps to what the rules ask for") {
  const Soup soup = sample("part");
  const Index asked = run_form(soup, SubdivideForm::faithful, 0, 2).layout->labels.count;
  for (const SubdivideForm form : {SubdivideForm::compact, SubdivideForm::quality}) {
    const LayoutRun run = run_form(soup, form, 0, 2);
    CHECK(run.layout->checks.is_valid());
    CHECK(run.layout->labels.count == asked);
  }
}
