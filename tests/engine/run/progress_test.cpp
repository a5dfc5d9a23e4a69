#include "engine/run/progress.h"

#include <map>

#include <doctest/doctest.h>

#include "tests/engine/run/toy.h"

using namespace intarsia;
using namespace intarsia::toy;

namespace {

// Remembers per run; the calls of one run must not overlap.
struct Recorder : ProgressListener {
  struct Seen {
    int begins = 0, ends = 0, advances = 0;
    bool monotone = true, in_range = true;
    Real overall = 0;
  };
  std::map<std::string, Seen> seen;

  void note(const ProgressEvent& e, int Seen::*what) {
    Seen& s = seen[e.run];
    ++(s.*what);
    s.monotone = s.monotone && e.overall >= s.overall;
    s.overall = e.overall;
    s.in_range = s.in_range && e.overall >= 0 && e.overall <= 1 && e.stage_fraction >= 0 && e.stage_fraction <= 1;
  }
  void stage_begin(const ProgressEvent& e) override { note(e, &Seen::begins); }
  void advance(const ProgressEvent& e) override { note(e, &Seen::advances); }
  void stage_end(const ProgressEvent& e) override { note(e, &Seen::ends); }
};

}  // namespace

TEST_CASE("the fraction of a run never goes back and ends at one") {
  Recorder recorder;
  RunContext context({2, 0, Order::fixed});
  context.add_listener(recorder);
  Flow flow(context, "toy");
  const Diamond d = add_diamond(flow, 200000);
  add_stage(flow,
            Stage<Total, Total>{"layout",
                                1,
                                0,
                                [&](const Work& work, const Total&) {
                                  // Polled here as the run's own clock would, so that the test needs no waiting.
                                  for (int i = 0; i < 50; ++i) work.tick(1), flow.progress().poll();
                                  return Total{};
                                },
                                {},
                                10},
            d.bottom);
  flow.run();
  const auto& s = recorder.seen["toy"];
  CHECK(s.begins == 5);
  CHECK(s.ends == 5);
  CHECK(s.advances >= 50);
  CHECK(s.monotone);
  CHECK(s.in_range);
  CHECK(s.overall == 1);
}

TEST_CASE("a failed run does not reach one") {
  Recorder recorder;
  RunContext context({2, 0, Order::fixed});
  context.add_listener(recorder);
  Flow flow(context, "toy");
  const auto top = add_stage(flow, count_to(100));
  add_stage(flow,
            Stage<Total, Numbers>{"surface", 1, 0,
                                  [](const Work&, const Numbers&) -> Total { throw Error(ErrorCode::rejected, "no"); }},
            top);
  CHECK_THROWS_AS(flow.run(), Error);
  CHECK(recorder.seen["toy"].ends == 1);
  CHECK(recorder.seen["toy"].overall < 1);
}

TEST_CASE("weights and ticks") {
  Progress p("run", {});
  const Index a = p.add("read", "", 1), b = p.add("scale", "", 3);
  CHECK(p.overall() == 0);
  p.begin(a, 100);
  CHECK(p.overall() == 0);
  p.ticks(a) += 100;
  CHECK(p.overall() == doctest::Approx(0.125));
  p.end(a);
  CHECK(p.overall() == doctest::Approx(0.25));
  p.begin(b, 10);
  p.ticks(b) += 1000000000;
  CHECK(p.overall() < 1);
  p.end(b);
  CHECK(p.overall() == 1);
}

TEST_CASE("a listener may cancel the run") {
  RunContext context({2, 0, Order::fixed});
  struct Impatient : ProgressListener {
    RunContext* context = nullptr;
    void stage_end(const ProgressEvent&) override { context->cancel(); }
  } impatient;
  impatient.context = &context;
  context.add_listener(impatient);
  Flow flow(context);
  const Diamond d = add_diamond(flow, 100);
  CHECK_THROWS_AS(flow.run(), Error);
  CHECK(fetch(d.bottom) == nullptr);
}
