// The program's own new and delete for large arrays (tools/large_memory.cpp is linked into this test).
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/parallel_for.h>

namespace {

// An array that knows what it should hold.
class Marked {
 public:
  Marked(std::size_t bytes, unsigned char mark) : bytes_(bytes), mark_(mark), data_(new unsigned char[bytes]) {
    for (std::size_t i = 0; i < bytes_; i += 4096) data_[i] = mark_;
    data_[bytes_ - 1] = mark_;
  }
  bool intact() const {
    for (std::size_t i = 0; i < bytes_; i += 4096)
      if (data_[i] != mark_) return false;
    return data_[bytes_ - 1] == mark_;
  }

 private:
  std::size_t bytes_;
  unsigned char mark_;
  std::unique_ptr<unsigned char[]> data_;
};

// Takes and frees at random; returns whether everything was found as it was left.
bool churn(unsigned seed, int rounds) {
  std::mt19937 random(seed);
  std::vector<Marked> held;
  for (int i = 0; i < rounds; ++i) {
    if (held.size() > 40 || (!held.empty() && random() % 3 == 0)) {
      const std::size_t k = random() % held.size();
      if (!held[k].intact()) return false;
      std::swap(held[k], held.back());
      held.pop_back();
    } else {
      held.emplace_back((std::size_t{200} << 10) + random() % (std::size_t{3} << 20),
                        static_cast<unsigned char>(random()));
    }
  }
  for (const Marked& m : held)
    if (!m.intact()) return false;
  return true;
}

}  // namespace

TEST_CASE("arrays never share memory, whatever the order of taking and freeing") { CHECK(churn(1, 4000)); }

TEST_CASE("nor with several threads, arrays of one thread freed by another included") {
  bool good[3] = {};
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 3; ++t) threads.emplace_back([&, t] { good[t] = churn(t + 10, 1500); });
  for (std::thread& t : threads) t.join();
  for (const bool g : good) CHECK(g);
  std::vector<Marked> made;
  std::thread([&] {
    for (int i = 0; i < 50; ++i) made.emplace_back(std::size_t{1} << 20, static_cast<unsigned char>(i));
  }).join();
  for (const Marked& m : made) CHECK(m.intact());
}

TEST_CASE("more arrays than the table has room for, then every other one freed: the rest stay whole") {
  std::vector<std::unique_ptr<Marked>> many;
  for (int i = 0; i < 2600; ++i)
    many.push_back(std::make_unique<Marked>(std::size_t{257} << 10, static_cast<unsigned char>(i)));
  for (std::size_t i = 0; i < many.size(); i += 2) many[i].reset();
  for (int i = 0; i < 2000; ++i)
    many.push_back(std::make_unique<Marked>(std::size_t{600} << 10, static_cast<unsigned char>(i)));
  bool whole = true;
  for (const auto& m : many) whole = whole && (!m || m->intact());
  CHECK(whole);
}

TEST_CASE("alignment is kept") {
  struct alignas(64) Pack {
    double value[8];
  };
  for (const std::size_t n : {10u, 10000u, 100000u}) {
    const std::vector<Pack> packs(n);
    CHECK(reinterpret_cast<std::uintptr_t>(packs.data()) % 64 == 0);
  }
}

TEST_CASE("fresh memory is zero, from inside parallel loops too, where it is fetched by several threads") {
  constexpr std::size_t kBytes = std::size_t{24} << 20;
  std::atomic<int> bad{0};
  tbb::parallel_for(0, 6, [&](int) {
    const std::unique_ptr<unsigned char[]> data(new unsigned char[kBytes]());
    for (std::size_t i = 0; i < kBytes; i += 1024) bad += data[i] != 0;
    bad += data[kBytes - 1] != 0;
  });
  CHECK(bad.load() == 0);
}
