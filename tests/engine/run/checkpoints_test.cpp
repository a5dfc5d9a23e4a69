#include "engine/run/checkpoints.h"

#include <filesystem>
#include <fstream>
#include <map>

#include <doctest/doctest.h>
#include <unistd.h>

#include "engine/io/artefact_file.h"
#include "engine/run/node.h"

using namespace intarsia;
namespace fs = std::filesystem;

namespace toy_store {

struct Source {
  std::vector<double> value;
};
std::uint64_t hash_of(const Source& a) { return exact_hash(a); }
std::uint64_t exact_hash_of(const Source& a) { return exact_hash(a); }
std::size_t bytes_of(const Source& a) { return a.value.size() * sizeof(double); }
std::size_t items_of(const Source& a) { return a.value.size(); }

struct Kept {
  std::vector<double> value;
  std::vector<Warning> warnings;
};
std::uint64_t hash_of(const Kept& a) { return exact_hash(a.value); }
std::size_t bytes_of(const Kept& a) { return a.value.size() * sizeof(double); }
std::size_t items_of(const Kept& a) { return a.value.size(); }
std::vector<Warning> warnings_of(const Kept& a) { return a.warnings; }
void write_to(ArtefactWriter& to, const Kept& a) { write_value(to, a); }
void read_from(ArtefactReader& from, Kept& a) { read_value(from, a); }

}  // namespace toy_store

using namespace toy_store;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("intarsia-checkpoints-" + std::to_string(getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

struct Settings {
  double start = 1, factor = 2, offset = 3;
  std::uint64_t program = 1;
  int threads = 2;
  bool pure = true;
};

struct Outcome {
  std::vector<double> result;
  std::map<std::string, int> computed;  // stage -> how often it ran
  std::vector<Warning> warnings;
  std::vector<std::uint64_t> hashes;
  std::map<std::string, bool> restored;
  bool operator==(const Outcome& o) const { return result == o.result && hashes == o.hashes; }
};

// read -> scaled -> shifted -> total, which nobody keeps; scaled is also used by total.
Outcome run(const fs::path& folder, const Settings& s) {
  Outcome out;
  RunContext context({s.threads, 0, Order::fixed});
  const Checkpoints checkpoints(folder, s.program);
  Flow flow(context);
  flow.use(checkpoints);
  const auto read = add_stage(flow, Stage<Source>{"read", 1, 0, [&](const Work&) {
                                                    ++out.computed["read"];
                                                    Source a{std::vector<double>(100'000)};
                                                    for (std::size_t i = 0; i < a.value.size(); ++i)
                                                      a.value[i] = s.start + static_cast<double>(i);
                                                    return a;
                                                  }});
  Hash factor, offset;
  factor.add(s.factor), offset.add(s.offset);
  Stage<Kept, Source> scale{"scaled", 1, factor.value(), [&](const Work&, const Source& a) {
                              ++out.computed["scaled"];
                              Kept k{a.value, {{"toy", "a warning of scaled", 7, {}}}};
                              for (double& v : k.value) v *= s.factor;
                              return k;
                            }};
  scale.is_pure = s.pure;
  const auto scaled = add_stage(flow, scale, read);
  const auto shifted = add_stage(flow,
                                 Stage<Kept, Kept>{"shifted", 1, offset.value(),
                                                   [&](const Work&, const Kept& a) {
                                                     ++out.computed["shifted"];
                                                     Kept k{a.value, {}};
                                                     for (double& v : k.value) v += s.offset;
                                                     return k;
                                                   },
                                                   "branch"},
                                 scaled);
  const auto total = add_stage(flow,
                               Stage<Kept, Kept, Kept>{"total", 1, 0,
                                                       [&](const Work&, const Kept& a, const Kept& b) {
                                                         ++out.computed["total"];
                                                         Kept k{a.value, {}};
                                                         for (std::size_t i = 0; i < k.value.size(); ++i)
                                                           k.value[i] += b.value[i];
                                                         return k;
                                                       }},
                               scaled, shifted);
  flow.run();
  out.result = fetch(total)->value;
  out.warnings = flow.record().warnings();
  for (const StageSummary& stage : flow.record().stages())
    out.hashes.push_back(stage.hash), out.restored[stage.name] = stage.restored;
  return out;
}

using Counts = std::map<std::string, int>;

void damage(const fs::path& file) {
  std::fstream f(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto at = static_cast<std::streamoff>(fs::file_size(file) / 2);
  f.seekg(at);
  const int byte = f.get();
  f.seekp(at);
  f.put(static_cast<char>(byte ^ 1));
}

}  // namespace

TEST_CASE("a second run computes nothing and tells the same") {
  const Folder dir;
  const Outcome fresh = run(dir.path, {});
  CHECK(fresh.computed == Counts{{"read", 1}, {"scaled", 1}, {"shifted", 1}, {"total", 1}});
  CHECK_FALSE(fresh.restored.at("total"));
  Settings more_threads;
  more_threads.threads = 3;
  const Outcome again = run(dir.path, more_threads);
  CHECK(again.computed == Counts{{"read", 1}});
  CHECK(again == fresh);
  CHECK(again.restored.at("total"));
  REQUIRE(again.warnings.size() == 1);  // of a stage that was not even read
  CHECK(again.warnings[0].message == fresh.warnings[0].message);
  CHECK(again.warnings[0].count == 7);
}

TEST_CASE("a change is followed by exactly the stages that depend on it") {
  const Folder dir;
  run(dir.path, {});
  Settings s;
  s.offset = 4;
  CHECK(run(dir.path, s).computed == Counts{{"read", 1}, {"shifted", 1}, {"total", 1}});
  s.factor = 5;
  CHECK(run(dir.path, s).computed == Counts{{"read", 1}, {"scaled", 1}, {"shifted", 1}, {"total", 1}});
  s.start = -1;
  CHECK(run(dir.path, s).computed == Counts{{"read", 1}, {"scaled", 1}, {"shifted", 1}, {"total", 1}});
  s.program = 2;
  CHECK(run(dir.path, s).computed == Counts{{"read", 1}, {"scaled", 1}, {"shifted", 1}, {"total", 1}});
  CHECK(run(dir.path, s).computed == Counts{{"read", 1}});
}

TEST_CASE("a missing or damaged file is made again, with those it needs and no others") {
  const Folder dir;
  const Outcome fresh = run(dir.path, {});
  fs::remove(dir.path / "shifted-branch.stage");
  Outcome again = run(dir.path, {});
  CHECK(again.computed == Counts{{"read", 1}, {"shifted", 1}});
  CHECK(again == fresh);
  damage(dir.path / "total.stage");
  again = run(dir.path, {});
  CHECK(again.computed == Counts{{"read", 1}, {"total", 1}});
  CHECK(again == fresh);
  CHECK(again.warnings.back().code == "checkpoint-damaged");
  damage(dir.path / "scaled.stage"), damage(dir.path / "total.stage");
  again = run(dir.path, {});
  CHECK(again.computed == Counts{{"read", 1}, {"scaled", 1}, {"total", 1}});
  CHECK(again == fresh);
  std::ofstream(dir.path / "total.stage") << "something else";
  CHECK(run(dir.path, {}) == fresh);
  CHECK(run(dir.path, {}).computed == Counts{{"read", 1}});
}

TEST_CASE("what depends on more than its inputs is never kept, nor what is made from it") {
  const Folder dir;
  Settings s;
  s.pure = false;
  run(dir.path, s);
  CHECK(fs::is_empty(dir.path));
  CHECK(run(dir.path, s).computed.size() == 4);
}

TEST_CASE("a stage that stopped early is not kept") {
  const Folder dir;
  for (const bool late : {true, false}) {
    RunContext context({2, 0, Order::fixed});
    if (late) context.hurry();
    const Checkpoints checkpoints(dir.path, 1);
    Flow flow(context);
    flow.use(checkpoints);
    const auto read =
        add_stage(flow, Stage<Source>{"read", 1, 0, [](const Work&) { return Source{std::vector<double>(10)}; }});
    const auto kept = add_stage(flow,
                                Stage<Kept, Source>{"improved", 1, 0,
                                                    [](const Work& work, const Source& a) {
                                                      Kept k{a.value, {}};
                                                      for (int round = 0; round < 3 && !work.is_late(); ++round)
                                                        for (double& v : k.value) v += 1;
                                                      return k;
                                                    }},
                                read);
    const auto next = add_stage(flow,
                                Stage<Kept, Kept>{"next", 1, 0,
                                                  [](const Work&, const Kept& a) {
                                                    return Kept{a.value, {}};
                                                  }},
                                kept);
    flow.run();
    CHECK(fetch(next)->value[0] == (late ? 0 : 3));
    CHECK(flow.record().stages()[1].shortened == late);
    CHECK(fs::is_empty(dir.path) == late);
  }
}

TEST_CASE("a folder that cannot be used is refused at once; one that fills up costs a warning") {
  const Folder dir;
  std::ofstream(dir.path.string()) << "a file";
  try {
    Checkpoints(dir.path, 1);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::write_failed);
  }
  fs::remove(dir.path);
  CHECK_THROWS_AS(Checkpoints(dir.path / "no" / "such", 1), Error);
  const Outcome fresh = run(dir.path, {});
  fs::remove(dir.path / "total.stage");
  fs::create_directory(dir.path / "total.stage");  // stands in its way
  const Outcome again = run(dir.path, {});
  CHECK(again == fresh);
  CHECK(again.warnings.back().code == "checkpoint-not-written");
}
