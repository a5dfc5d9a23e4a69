// A run can be stopped in every stage; nothing is published then.
#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tools/make/shape.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

// Cancels when the given stage begins.
class CancelAt : public ProgressListener {
 public:
  CancelAt(RunContext& context, std::string stage) : context_(context), stage_(std::move(stage)) {}
  void stage_begin(const ProgressEvent& event) override {
    if (event.stage == stage_) context_.cancel();
  }

 private:
  RunContext& context_;
  std::string stage_;
};

}  // namespace

TEST_CASE("cancelling in any stage ends the run with ErrorCode::cancelled and publishes no layout") {
  tools::MakeOptions o;
  o.shape = "part", o.triangles = 12'000;
  const auto soup = std::make_shared<Soup>(tools::make_shape(Work(), o));
  for (const char* stage :
       {"read", "surface", "scale", "curvature", "ridges", "curves", "network", "patches", "layout"}) {
    CAPTURE(stage);
    RunContext context;
    CancelAt listener(context, stage);
    context.add_listener(listener);
    Flow flow(context);
    const auto source = [soup](const Work&) { return *soup; };
    const auto ports =
        graph::add_layout_stages(flow, add_stage(flow, Stage<Soup>{"read", 1, 0, source}), graph::robust_options());
    try {
      flow.run();
      FAIL("the run went on");
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::cancelled);
    }
    CHECK(fetch(ports.layout) == nullptr);
  }
}
