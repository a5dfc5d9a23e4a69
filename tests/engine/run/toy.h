// Artefacts and stages without geometry, for the tests of runs.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/parallel/for_each.h"
#include "engine/parallel/hash_array.h"
#include "engine/parallel/reduce.h"
#include "engine/run/node.h"

namespace intarsia::toy {

struct Numbers {
  std::vector<double> value;
  std::vector<Warning> warnings = {};
};
inline std::uint64_t hash_of(const Numbers& n) { return hash_array(Work{}, n.value); }
inline std::size_t bytes_of(const Numbers& n) { return n.value.size() * sizeof(double); }
inline std::size_t items_of(const Numbers& n) { return n.value.size(); }
inline const std::vector<Warning>& warnings_of(const Numbers& n) { return n.warnings; }

struct Total {
  double sum = 0;
};
inline std::uint64_t hash_of(const Total& t) {
  Hash h;
  h.add(t.sum);
  return h.value();
}
inline std::size_t bytes_of(const Total&) { return sizeof(Total); }
inline std::size_t items_of(const Total&) { return 1; }

inline Stage<Numbers> count_to(std::size_t n) {
  return {"read", 1, n, [n](const Work& work) {
            Numbers out{std::vector<double>(n)};
            for_each(work, Cost::light, n, [&](std::size_t i) { out.value[i] = 0.1 * static_cast<double>(i); });
            return out;
          }};
}

// branch is also the factor's name.
inline Stage<Numbers, Numbers> times(double factor, std::string branch) {
  return {"ridges", 1, 0,
          [factor](const Work& work, const Numbers& in) {
            Numbers out{std::vector<double>(in.value.size())};
            for_each(work, Cost::light, in.value.size(), [&](std::size_t i) { out.value[i] = factor * in.value[i]; });
            return out;
          },
          std::move(branch)};
}

inline Stage<Total, Numbers, Numbers> add_up() {
  return {"curves", 1, 0, [](const Work& work, const Numbers& a, const Numbers& b) {
            return Total{sum(work, Cost::light, a.value.size(), 0.0,
                             [&](std::size_t i) { return a.value[i] * a.value[i] - 0.3 * b.value[i]; })};
          }};
}

struct Diamond {
  Port<Numbers> top, left, right;
  Port<Total> bottom;
};

inline Diamond add_diamond(Flow& flow, std::size_t n) {
  Diamond d;
  d.top = add_stage(flow, count_to(n));
  d.left = add_stage(flow, times(2, "ridges"), d.top);
  d.right = add_stage(flow, times(-3, "valleys"), d.top);
  d.bottom = add_stage(flow, add_up(), d.left, d.right);
  return d;
}

// sum over i < n of (0.2 i)^2 + 0.09 i
inline double diamond_truth(double n) { return 0.04 * (n - 1) * n * (2 * n - 1) / 6 + 0.09 * n * (n - 1) / 2; }

}  // namespace intarsia::toy
