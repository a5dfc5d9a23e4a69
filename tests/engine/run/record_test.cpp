#include "engine/run/record.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/run/trace.h"
#include "tests/engine/run/toy.h"

using namespace intarsia;
using namespace intarsia::toy;

TEST_CASE("nodes of one stage are summed, overlapping time once") {
  RunRecord r;
  r.add({"ridges", "valleys", 2, 2.0, 2.0, 1.5, 7, 70, 22, 1});
  r.add({"ridges", "ridges", 1, 1.0, 2.0, 0.5, 5, 50, 11, 0});
  r.add({"read", "", 0, 0.0, 1.0, 0.25, 3, 30, 33, 0});
  const auto s = r.stages();
  REQUIRE(s.size() == 2);
  CHECK(s[0].name == "read");
  CHECK(s[0].hash == 33);
  CHECK(s[1].name == "ridges");
  CHECK(s[1].wall == doctest::Approx(3));
  CHECK(s[1].cpu == doctest::Approx(2));
  CHECK(s[1].items == 12);
  CHECK(s[1].bytes == 120);

  RunRecord other;  // the order of arrival does not show
  other.add({"ridges", "ridges", 1, 1.0, 2.0, 0.5, 5, 50, 11, 0});
  other.add({"ridges", "valleys", 2, 2.0, 2.0, 1.5, 7, 70, 22, 1});
  CHECK(other.stages()[0].hash == s[1].hash);
}

TEST_CASE("the record of a run") {
  RunContext context({2, 0, Order::fixed});
  Flow flow(context, "toy");
  const Diamond d = add_diamond(flow, 20000);
  add_stage(flow,
            Stage<Numbers, Total>{"network", 1, 0,
                                  [](const Work&, const Total&) {
                                    return Numbers{{1, 2}, {{"few-points", "there are few points", 2, ""}}};
                                  }},
            d.bottom);
  flow.record().add(Warning{"odd-input", "the input is odd", 1, ""});
  flow.run();

  const auto nodes = flow.record().nodes();
  REQUIRE(nodes.size() == 5);
  CHECK(nodes[1].branch == "ridges");
  CHECK(nodes[2].branch == "valleys");
  CHECK(nodes[3].start >= nodes[1].start + nodes[1].wall);
  CHECK(nodes[3].start >= nodes[2].start + nodes[2].wall);
  const auto s = flow.record().stages();
  REQUIRE(s.size() == 4);
  CHECK(s[0].items == 20000);
  CHECK(s[1].items == 40000);
  CHECK(s[1].bytes == 40000 * 8);
  Numbers top{std::vector<double>(20000)};
  for (std::size_t i = 0; i < 20000; ++i) top.value[i] = 0.1 * static_cast<double>(i);
  CHECK(s[0].hash == hash_of(top));
  CHECK(flow.record().wall() > 0);

  const auto w = flow.record().warnings();
  REQUIRE(w.size() == 2);
  CHECK(w[0].code == "few-points");
  CHECK(w[0].stage == "network");
  CHECK(w[1].code == "odd-input");

  const auto json = nlohmann::json::parse(flow.record().to_json().dump());
  std::vector<std::string> names;
  for (const auto& stage : json["stages"]) {
    names.push_back(stage["name"]);
    CHECK(stage["seconds"].get<double>() >= 0);
    CHECK(stage["cpu_seconds"].get<double>() >= 0);
    CHECK(stage["hash"].get<std::string>().size() == 16);
  }
  CHECK(names == std::vector<std::string>{"read", "ridges", "curves", "network"});
  CHECK(json["warnings"][0]["count"] == 2);
  CHECK_FALSE(json.contains("error"));
  CHECK(json["peak_memory_bytes"].get<std::uint64_t>() > 1000000);
}

TEST_CASE("processor time is shared out without loss") {
  CpuMeter meter;
  CpuMeter::Share a, b;
  const auto burn = [] {
    const Real until = process_cpu_seconds() + 0.02;
    while (process_cpu_seconds() < until) {
    }
  };
  const Real before = process_cpu_seconds();
  meter.begin(a);
  burn();
  const Real alone = process_cpu_seconds() - before;
  meter.begin(b);
  burn();
  meter.end(a);
  burn();
  meter.end(b);
  const Real all = process_cpu_seconds() - before;
  CHECK(a.seconds + b.seconds <= all);
  CHECK(a.seconds + b.seconds > 0.95 * all - 0.001);
  CHECK(a.seconds > alone);
  CHECK(b.seconds >= 0.02);
}

TEST_CASE("the trace is JSON with monotone times") {
  RunContext context({2, 0, Order::fixed});
  Flow a(context, "a"), b(context, "b");
  add_diamond(a, 50000), add_diamond(b, 50000);
  a.start(), b.start();
  a.wait(), b.wait();
  const auto trace = nlohmann::json::parse(chrome_trace({{"a", &a.record()}, {"b", &b.record()}}).dump());
  double last = 0;
  std::size_t complete = 0;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] != "X") continue;
    ++complete;
    CHECK(event["ts"].get<double>() >= last);
    last = event["ts"];
    CHECK(event["dur"].get<double>() >= 0);
    CHECK(event["tid"].get<int>() >= 0);
    CHECK(event["pid"].get<int>() < 2);
  }
  CHECK(complete == 8);
  CHECK(trace["traceEvents"][0]["args"]["name"] == "a");
}
