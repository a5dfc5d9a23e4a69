#include "engine/io/artefact_file.h"

#include <array>
#include <map>

#include <doctest/doctest.h>

#include "engine/data/curve_network.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

const Work kWork;  // outlives every reader and writer

struct Inner {
  std::uint8_t flag = 0;
  double value = 0;
};

struct Sample {
  std::string name;
  std::vector<std::uint32_t> numbers;
  std::vector<std::string> words;
  std::array<std::vector<float>, 2> pair;
  Vec3 place = Vec3::Zero();
  std::vector<Inner> inner;
  VertexOrigins origins;
  EdgeStrengths strengths;
  bool yes = false;
  CurveKind kind = CurveKind::ridge;
};

Sample make_sample(std::size_t large) {
  Sample s;
  s.name = "a name";
  for (std::size_t i = 0; i < large; ++i) s.numbers.push_back(static_cast<std::uint32_t>(i * i));
  s.words = {"", "one", std::string(1000, 'x')};
  s.pair[1] = {1, -2.5F};
  s.place = {1, 2, -0.0};
  s.inner = {{1, 0.1}, {2, 0.2}};
  s.origins.push_back(SurfacePoint::at_vertex(0));
  s.origins.push_back(SurfacePoint::on_edge(7, 0.25));
  s.strengths.resize(9);
  s.strengths.set(3, 0.5);
  s.yes = true, s.kind = CurveKind::border;
  return s;
}

void check_equal(const Sample& a, const Sample& b) {
  CHECK(a.name == b.name);
  CHECK(a.numbers == b.numbers);
  CHECK(a.words == b.words);
  CHECK(a.pair == b.pair);
  CHECK(a.place == b.place);
  REQUIRE(a.inner.size() == b.inner.size());
  for (std::size_t i = 0; i < a.inner.size(); ++i) {
    CHECK(a.inner[i].flag == b.inner[i].flag);
    CHECK(a.inner[i].value == b.inner[i].value);
  }
  CHECK(a.origins.originals() == b.origins.originals());
  CHECK(a.origins.added() == b.origins.added());
  CHECK(a.strengths.size() == b.strengths.size());
  CHECK(a.strengths.edges() == b.strengths.edges());
  CHECK(a.strengths.values() == b.strengths.values());
  CHECK(a.yes == b.yes);
  CHECK(a.kind == b.kind);
}

void write(const std::filesystem::path& path, const Sample& s) {
  ArtefactWriter to(kWork, path, 77, "a note");
  write_value(to, s);
  to.commit();
}

Sample read(const std::filesystem::path& path) {
  ArtefactReader from(kWork, path);
  Sample s;
  read_value(from, s);
  from.finish();
  return s;
}

}  // namespace

TEST_CASE("what goes into a file comes out of it, small and large") {
  const TemporaryFolder folder;
  for (const std::size_t large : {std::size_t{0}, std::size_t{10}, std::size_t{1'000'003}}) {
    const Sample s = make_sample(large);
    write(folder / "a.stage", s);
    check_equal(read(folder / "a.stage"), s);
    const ArtefactReader head(kWork, folder / "a.stage");
    CHECK(head.key() == 77);
    CHECK(head.note() == "a note");
  }
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("every single changed byte, and every cut, is noticed") {
  const TemporaryFolder folder;
  write(folder / "a.stage", make_sample(50));
  const std::string whole = get_file(folder / "a.stage");
  const auto refused = [&](const std::string& bytes) {
    put_file(folder / "b.stage", bytes);
    const auto error = error_of([&] {
      ArtefactReader head(kWork, folder / "b.stage");
      if (head.key() != 77) throw Error(ErrorCode::bad_file, "another key");
      read(folder / "b.stage");
    });
    return error && error->code() == ErrorCode::bad_file;
  };
  CHECK_FALSE(refused(whole));
  std::size_t unseen = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    unseen += refused(damaged) ? 0 : 1;
  }
  for (std::size_t size = 0; size < whole.size(); size += 13) unseen += refused(whole.substr(0, size)) ? 0 : 1;
  CHECK(refused(whole + "x"));
  CHECK(unseen == 0);
}

TEST_CASE("a large array is damaged in the middle") {
  const TemporaryFolder folder;
  write(folder / "a.stage", make_sample(1'000'000));
  std::string bytes = get_file(folder / "a.stage");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  put_file(folder / "a.stage", bytes);
  CHECK(error_of([&] { read(folder / "a.stage"); })->code() == ErrorCode::bad_file);
}

TEST_CASE("hashes of values see every field and every bit") {
  const std::uint64_t first = exact_hash(make_sample(10));
  CHECK(exact_hash(make_sample(10)) == first);
  Sample s = make_sample(10);
  s.place.z() = 0.0;  // was -0
  CHECK(exact_hash(s) != first);
  s = make_sample(10);
  s.strengths.set(3, 0.25);
  CHECK(exact_hash(s) != first);
  s = make_sample(10);
  s.words.emplace_back();
  CHECK(exact_hash(s) != first);
}

TEST_CASE("arrays are copied as bytes only where that means the same") {
  CHECK(is_plain<double>());
  CHECK(is_plain<CurveKind>());
  CHECK(is_plain<SurfacePoint>());
  CHECK_FALSE(is_packed<SurfacePoint>());
  CHECK_FALSE(is_plain<std::string>());
  CHECK_FALSE(is_plain<VertexOrigins>());
}
