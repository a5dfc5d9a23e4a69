#include "engine/run/flow.h"

#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/engine/run/toy.h"

using namespace intarsia;
using namespace intarsia::toy;

namespace {

Error failure_of(Flow& flow) {
  try {
    flow.run();
  } catch (const Error& e) {
    return e;
  }
  FAIL("no error");
  return Error(ErrorCode::internal, "");
}

}  // namespace

TEST_CASE("a diamond computes what its stages say") {
  RunContext context({2, 0, Order::fixed});
  Flow flow(context, "toy");
  const Diamond d = add_diamond(flow, 10001);
  flow.run();
  CHECK(fetch(d.bottom)->sum == doctest::Approx(diamond_truth(10001)).epsilon(1e-12));
}

TEST_CASE("results and hashes do not depend on threads") {
  std::vector<std::uint64_t> first;
  double sum = 0;
  for (int threads : {1, 2, 3, 8}) {
    RunContext context({threads, 0, Order::fixed});
    CHECK(context.threads() == threads);
    Flow flow(context);
    const Diamond d = add_diamond(flow, 100003);
    flow.run();
    std::vector<std::uint64_t> hashes;
    for (const StageSummary& s : flow.record().stages()) hashes.push_back(s.hash);
    REQUIRE(hashes.size() == 3);
    if (first.empty()) first = hashes, sum = fetch(d.bottom)->sum;
    CHECK(hashes == first);
    CHECK(fetch(d.bottom)->sum == sum);
  }
}

TEST_CASE("an artefact dies with its last consumer, not before") {
  RunContext context({2, 0, Order::fixed});
  Flow flow(context);
  const Diamond d = add_diamond(flow, 5000);
  // The slot is asked from inside later stages.
  std::weak_ptr<const Numbers> top;
  bool alive_in_left = false, dead_at_end = false;
  const auto peek = add_stage(flow,
                              Stage<Total, Numbers>{"network", 1, 0,
                                                    [&](const Work&, const Numbers&) {
                                                      top = fetch(d.top);
                                                      alive_in_left = !top.expired();
                                                      return Total{};
                                                    }},
                              d.top);
  const auto last = add_stage(flow,
                              Stage<Total, Total, Total>{"layout", 1, 0,
                                                         [&](const Work&, const Total&, const Total&) {
                                                           dead_at_end = top.expired();
                                                           return Total{7};
                                                         }},
                              peek, d.bottom);
  flow.run();
  CHECK(alive_in_left);
  CHECK(dead_at_end);
  CHECK(fetch(d.top) == nullptr);
  CHECK(fetch(d.left) == nullptr);
  CHECK(fetch(d.bottom) == nullptr);
  CHECK(fetch(last)->sum == 7);
}

TEST_CASE("a kept artefact outlives its consumers") {
  RunContext context;
  Flow flow(context);
  const Diamond d = add_diamond(flow, 100);
  keep(d.left);
  flow.run();
  REQUIRE(fetch(d.left));
  CHECK(fetch(d.left)->value[10] == 2.0);
  CHECK(fetch(d.right) == nullptr);
}

TEST_CASE("a stage may take one artefact twice") {
  RunContext context;
  Flow flow(context);
  const auto top = add_stage(flow, count_to(10));
  const auto total = add_stage(flow, add_up(), top, top);
  flow.run();
  CHECK(fetch(total)->sum == doctest::Approx(0.01 * 285 - 0.3 * 4.5));
  CHECK(fetch(top) == nullptr);
}

TEST_CASE("a throw in each stage names that stage and stops the run") {
  const std::vector<std::string> names = {"read", "surface", "ridges", "ridges", "curves"};
  for (std::size_t bad = 0; bad < names.size(); ++bad)
    for (int kind = 0; kind < 3; ++kind) {
      RunContext context({2, 0, Order::fixed});
      Flow flow(context);
      std::vector<int> ran(names.size(), 0);
      const auto body = [&, bad, kind](std::size_t i) {
        ran[i] = 1;
        if (i != bad) return Total{};
        if (kind == 0) throw Error(ErrorCode::numeric, "left the domain", 42);
        if (kind == 1) throw std::bad_alloc();
        throw std::runtime_error("something else");
      };
      const auto one = [&](std::size_t i) {
        return Stage<Total, Total>{names[i], 1, 0, [=](const Work&, const Total&) { return body(i); }};
      };
      const auto read = add_stage(flow, Stage<Total>{names[0], 1, 0, [=](const Work&) { return body(0); }});
      const auto surface = add_stage(flow, one(1), read);
      const auto ridges = add_stage(flow, one(2), surface), valleys = add_stage(flow, one(3), surface);
      const auto curves = add_stage(
          flow,
          Stage<Total, Total, Total>{names[4], 1, 0, [=](const Work&, const Total&, const Total&) { return body(4); }},
          ridges, valleys);
      const Error e = failure_of(flow);
      CHECK(e.stage() == names[bad]);
      CHECK(e.code() == (kind == 0 ? ErrorCode::numeric : kind == 1 ? ErrorCode::no_memory : ErrorCode::internal));
      if (kind == 0) CHECK(e.element() == 42);
      if (kind == 2) CHECK(std::string(e.what()).find("something else") != std::string::npos);
      CHECK(ran[bad] == 1);
      if (bad < 4) CHECK(ran[4] == 0);
      if (bad == 0) CHECK(ran[1] == 0);
      CHECK(fetch(curves) == nullptr);
      CHECK(fetch(read) == nullptr);
      CHECK(flow.record().to_json()["error"]["stage"] == names[bad]);
    }
}

TEST_CASE("cancelling in each stage stops before the next") {
  for (std::size_t at = 0; at < 4; ++at) {
    RunContext context({2, 0, Order::fixed});
    Flow flow(context);
    std::vector<int> ran(4, 0);
    const auto body = [&](std::size_t i) {
      ran[i] = 1;
      if (i == at) context.cancel();
      return Total{};
    };
    Port<Total> port = add_stage(flow, Stage<Total>{"read", 1, 0, [&](const Work&) { return body(0); }});
    for (std::size_t i = 1; i < 4; ++i)
      port = add_stage(flow,
                       Stage<Total, Total>{"stage " + std::to_string(i), 1, 0,
                                           [&, i](const Work&, const Total&) { return body(i); }},
                       port);
    CHECK(failure_of(flow).code() == ErrorCode::cancelled);
    CHECK(fetch(port) == nullptr);
    for (std::size_t i = 0; i < 4; ++i) CHECK(ran[i] == (i <= at ? 1 : 0));
  }
}

TEST_CASE("cancelling inside a long loop stops it, from a flag outside") {
  for (int threads : {1, 2, 8}) {
    std::atomic<bool> signal{false};
    RunContext context({threads, 0, Order::fixed}, &signal);
    Flow flow(context);
    std::atomic<std::size_t> visited{0};
    constexpr std::size_t kItems = 1000000;
    add_stage(flow, Stage<Total>{"scale", 1, 0, [&](const Work& work) {
                                   for_each(work, Cost::heavy, kItems, [&](std::size_t) {
                                     if (visited.fetch_add(1) == 100) signal.store(true);
                                   });
                                   return Total{};
                                 }});
    const Error e = failure_of(flow);
    CHECK(e.code() == ErrorCode::cancelled);
    CHECK(e.stage() == "scale");
    CHECK(visited.load() > 100);
    CHECK(visited.load() < kItems);
  }
}

TEST_CASE("a failed branch stops the other, and is named as the cause") {
  RunContext context({2, 0, Order::fixed});
  Flow flow(context);
  std::atomic<bool> started{false};
  std::atomic<std::size_t> visited{0};
  const auto top = add_stage(flow, count_to(10));
  // The long one is declared first: the cause must still win.
  add_stage(flow,
            Stage<Total, Numbers>{"ridges", 1, 0,
                                  [&](const Work& work, const Numbers&) {
                                    started = true;
                                    for (;; ++visited) work.check();
                                    return Total{};
                                  }},
            top);
  add_stage(flow,
            Stage<Total, Numbers>{"valleys", 1, 0,
                                  [&](const Work&, const Numbers&) -> Total {
                                    while (!started) std::this_thread::yield();
                                    throw Error(ErrorCode::numeric, "no");
                                  }},
            top);
  CHECK(failure_of(flow).stage() == "valleys");
}

TEST_CASE("two graphs at once in one arena, one of them failing") {
  for (int threads : {1, 2, 8}) {
    RunContext context({threads, 0, Order::fixed});
    Flow a(context, "a"), b(context, "b"), c(context, "c");
    const Diamond da = add_diamond(a, 50000), dc = add_diamond(c, 30000);
    const auto top = add_stage(b, count_to(1000));
    add_stage(b,
              Stage<Total, Numbers>{
                  "surface", 1, 0,
                  [](const Work&, const Numbers&) -> Total { throw Error(ErrorCode::rejected, "not a surface"); }},
              top);
    a.start(), b.start(), c.start();
    a.wait();
    CHECK_THROWS_AS(b.wait(), Error);
    c.wait();
    CHECK(fetch(da.bottom)->sum == doctest::Approx(diamond_truth(50000)).epsilon(1e-12));
    CHECK(fetch(dc.bottom)->sum == doctest::Approx(diamond_truth(30000)).epsilon(1e-12));
  }
}

TEST_CASE("runs from several threads share one context") {
  RunContext context({3, 0, Order::fixed});
  std::vector<double> sum(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < sum.size(); ++i)
    threads.emplace_back([&, i] {
      Flow flow(context);
      const Diamond d = add_diamond(flow, 20000 + i);
      flow.run();
      sum[i] = fetch(d.bottom)->sum;
    });
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < sum.size(); ++i)
    CHECK(sum[i] == doctest::Approx(diamond_truth(20000 + double(i))).epsilon(1e-12));
}

TEST_CASE("a flow runs once") {
  RunContext context;
  Flow flow(context);
  add_diamond(flow, 10);
  flow.run();
  CHECK_THROWS_AS(flow.run(), Error);
  CHECK_THROWS_AS(flow.wait(), Error);
}

TEST_CASE("a flow that was started may be destroyed") {
  RunContext context({2, 0, Order::fixed});
  {
    Flow flow(context);
    add_diamond(flow, 100000);
    flow.start();
  }
  { const Flow never(context); }
  CHECK_THROWS_AS(RunContext({-1, 0, Order::fixed}), Error);
  CHECK(RunContext().threads() >= 1);
}
