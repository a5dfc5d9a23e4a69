// A short, repeatable run of the fuzz targets with a mutator of our own: no feedback, but in every test run.
#include <algorithm>
#include <exception>

#include <doctest/doctest.h>

#include "engine/base/hash.h"
#include "tests/fuzz/targets.h"

using namespace intarsia;
using namespace intarsia::fuzz;

namespace {

// A stream of numbers below a bound.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::size_t operator()(std::size_t bound) { return bound == 0 ? 0 : (state_ = mix64(state_)) % bound; }

 private:
  std::uint64_t state_;
};

constexpr const char* kWord[] = {"0",
                                 "-1",
                                 "1",
                                 "3",
                                 "255",
                                 "256",
                                 "4294967295",
                                 "99999999999999999999",
                                 "nan",
                                 "inf",
                                 "1e400",
                                 "-0",
                                 "1,5",
                                 "0x10",
                                 "\r\n",
                                 "\n",
                                 " ",
                                 "#",
                                 "\\\n",
                                 "f",
                                 "v ",
                                 "vertex 9",
                                 "list ",
                                 "element face 4000000000\n",
                                 "OFF",
                                 "ply\n",
                                 "end_header\n",
                                 "\t",
                                 "/",
                                 "//",
                                 "solid",
                                 "endfacet"};

void mutate(Dice& dice, std::string& bytes, const std::vector<std::string>& seeds) {
  const std::size_t at = dice(bytes.size() + 1), length = dice(1 + dice(16));
  switch (dice(9)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice(8)));
      break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(dice(256));
      break;
    case 2:
      bytes.erase(std::min(at, bytes.size()), length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(dice(bytes.size() + 1), length));
      break;
    case 4:
      bytes.resize(at);
      break;
    case 5:
      bytes.insert(at, kWord[dice(std::size(kWord))]);
      break;
    case 6: {
      const std::size_t end = std::min(bytes.size(), at + length);
      bytes.replace(at, end - at, kWord[dice(std::size(kWord))]);
      break;
    }
    case 7:
      for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i)
        bytes[i] = static_cast<char>(dice(2) ? 0xff : 0x7f);
      break;
    default: {
      const std::string& other = seeds[dice(seeds.size())];
      bytes.resize(at);
      bytes += other.substr(std::min(other.size(), dice(other.size() + 1)));
    }
  }
}

}  // namespace

TEST_CASE("seeds are read, or judged, without a broken promise") {
  for (const Target& target : targets())
    for (const std::string& seed : target.seeds()) {
      CAPTURE(target.name);
      CHECK_NOTHROW(target.run(seed));
    }
}

TEST_CASE("thousands of damaged files break no promise") {
  constexpr int kRounds = 6000;
  for (const Target& target : targets()) {
    const std::vector<std::string> seeds = target.seeds();
    Dice dice(mix64(seeds.size() + std::string_view(target.name).size()));
    int broken = 0;
    for (int round = 0; round < kRounds; ++round) {
      std::string bytes = seeds[dice(seeds.size())];
      for (std::size_t n = 1 + dice(6); n > 0; --n) mutate(dice, bytes, seeds);
      try {
        target.run(bytes);
      } catch (const std::exception& e) {
        if (++broken < 4) {
          CAPTURE(target.name);
          CAPTURE(round);
          FAIL_CHECK(std::string(e.what()));
        }
      }
    }
    CHECK(broken == 0);
  }
}
