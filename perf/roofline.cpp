// What this machine can do: bytes a second of the triad a = b + s c (McCalpin's STREAM) on arrays beyond every cache,
// and fused multiply-adds a second, double and single precision, from registers alone.
//
//   roofline [THREADS] [--json]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Wall time of `work(thread)` on all threads at once; the least of several rounds.
double least_time(int threads, int rounds, const std::function<void(int)>& work) {
  double least = 1e30;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::thread> team;
    const double begin = seconds();
    for (int t = 1; t < threads; ++t) team.emplace_back(work, t);
    work(0);
    for (std::thread& t : team) t.join();
    least = std::min(least, seconds() - begin);
  }
  return least;
}

double triad_bandwidth(int threads) {
  constexpr std::size_t kDoubles = std::size_t{1} << 25;  // 256 MB an array
  const std::unique_ptr<double[]> a(new double[kDoubles]), b(new double[kDoubles]), c(new double[kDoubles]);
  const auto part = [&](int t, const auto& body) {
    const std::size_t begin = kDoubles * static_cast<std::size_t>(t) / static_cast<std::size_t>(threads);
    const std::size_t end = kDoubles * static_cast<std::size_t>(t + 1) / static_cast<std::size_t>(threads);
    for (std::size_t i = begin; i < end; ++i) body(i);
  };
  least_time(threads, 1, [&](int t) { part(t, [&](std::size_t i) { a[i] = 0, b[i] = 1, c[i] = 2; }); });
  const double time = least_time(threads, 7, [&](int t) { part(t, [&](std::size_t i) { a[i] = b[i] + 3 * c[i]; }); });
  if (a[kDoubles / 2] != 7) std::abort();
  return 3.0 * sizeof(double) * static_cast<double>(kDoubles) / time;
}

constexpr long kSteps = 4'000'000;
constexpr int kChains = 12;    // independent sums: more than latency times units
thread_local double sink = 0;  // keeps the compiler from dropping the sums

// Each returns multiply-adds done; lanes * kChains a step.
double fma_plain() {
  double x[kChains];
  for (int i = 0; i < kChains; ++i) x[i] = i;
  for (long s = 0; s < kSteps / 4; ++s)
    for (double& v : x) v = v * 0.999999 + 1e-9;
  for (const double v : x) sink += v;
  return kChains * static_cast<double>(kSteps / 4);
}

#if defined(__x86_64__)
__attribute__((target("avx512f"))) double fma_double_512() {
  const __m512d m = _mm512_set1_pd(0.999999), a = _mm512_set1_pd(1e-9);
  __m512d x[kChains];
  for (__m512d& v : x) v = a;
  for (long s = 0; s < kSteps; ++s) {
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i) x[i] = _mm512_fmadd_pd(x[i], m, a);
  }
  for (const __m512d& v : x) sink += v[0];
  return 8.0 * kChains * static_cast<double>(kSteps);
}
__attribute__((target("avx512f"))) double fma_float_512() {
  const __m512 m = _mm512_set1_ps(0.9999f), a = _mm512_set1_ps(1e-6f);
  __m512 x[kChains];
  for (__m512& v : x) v = a;
  for (long s = 0; s < kSteps; ++s) {
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i) x[i] = _mm512_fmadd_ps(x[i], m, a);
  }
  for (const __m512& v : x) sink += v[0];
  return 16.0 * kChains * static_cast<double>(kSteps);
}
__attribute__((target("avx2,fma"))) double fma_double_256() {
  const __m256d m = _mm256_set1_pd(0.999999), a = _mm256_set1_pd(1e-9);
  __m256d x[kChains];
  for (__m256d& v : x) v = a;
  for (long s = 0; s < kSteps; ++s) {
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i) x[i] = _mm256_fmadd_pd(x[i], m, a);
  }
  for (const __m256d& v : x) sink += v[0];
  return 4.0 * kChains * static_cast<double>(kSteps);
}
__attribute__((target("avx2,fma"))) double fma_float_256() {
  const __m256 m = _mm256_set1_ps(0.9999f), a = _mm256_set1_ps(1e-6f);
  __m256 x[kChains];
  for (__m256& v : x) v = a;
  for (long s = 0; s < kSteps; ++s) {
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i) x[i] = _mm256_fmadd_ps(x[i], m, a);
  }
  for (const __m256& v : x) sink += v[0];
  return 8.0 * kChains * static_cast<double>(kSteps);
}
#endif

struct Peak {
  const char* level;
  double (*on_doubles)();
  double (*on_floats)();
};

std::vector<Peak> peaks() {
  std::vector<Peak> out;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) out.push_back({"avx512", fma_double_512, fma_float_512});
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    out.push_back({"avx2", fma_double_256, fma_float_256});
#endif
  if (out.empty()) out.push_back({"plain", fma_plain, fma_plain});
  return out;
}

double flops(int threads, double (*kernel)()) {
  std::vector<double> done(static_cast<std::size_t>(threads));
  const double time = least_time(threads, 9, [&](int t) { done[static_cast<std::size_t>(t)] = kernel(); });
  double all = 0;
  for (const double d : done) all += d;
  return 2 * all / time;
}

}  // namespace

int main(int argc, char** argv) {
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if ((threads = std::atoi(argv[i])) < 1)
      return std::fprintf(stderr, "roofline [THREADS] [--json]\n"), 2;
  }
  const double triad = triad_bandwidth(threads);
  std::printf(json ? "{\"threads\": %d, \"triad_bytes_per_second\": %.4g" : "%d threads: triad %.4g GB/s\n", threads,
              json ? triad : triad * 1e-9);
  for (const Peak& p : peaks()) {
    const double d = flops(threads, p.on_doubles), f = flops(threads, p.on_floats);
    if (json)
      std::printf(", \"%s\": {\"double_flops\": %.4g, \"float_flops\": %.4g}", p.level, d, f);
    else
      std::printf("%s: %.4g GFLOP/s double, %.4g GFLOP/s single; balance %.3g flops a byte of triad\n", p.level,
                  d * 1e-9, f * 1e-9, d / triad);
  }
  if (json) std::printf("}\n");
  return sink == 0.123 ? 1 : 0;
}
