// What a run will cost, before it is begun: linear in the vertices, with coefficients measured on two cores of an AMD
// EPYC server (Zen 4) over scans of 10 000 to 2 100 000 vertices, November 2026. Another machine needs other seconds;
// bytes are the same everywhere.
#pragma once

#include <cstdint>

namespace intarsia::graph {

struct Forecast {
  double cpu_seconds = 0;         // of all threads
  std::uint64_t peak_memory = 0;  // bytes
};

// Linear in vertices and triangles.
struct CostModel {
  double base_seconds, vertex_seconds, triangle_seconds;
  double base_bytes, vertex_bytes, triangle_bytes;

  Forecast operator()(std::uint64_t vertices, std::uint64_t triangles) const {
    const double v = static_cast<double>(vertices), t = static_cast<double>(triangles);
    return {base_seconds + vertex_seconds * v + triangle_seconds * t,
            static_cast<std::uint64_t>(base_bytes + vertex_bytes * v + triangle_bytes * t)};
  }
};

// Default options, with preview and page. Small meshes and CAD parts, which are divided inside, set the base.
inline constexpr CostModel kRunCost{0.45, 7.5e-6, 3.75e-6, 9e7, 370, 185};
inline constexpr CostModel kFeaturesCost{0.02, 3.1e-6, 1.55e-6, 14e6, 255, 125};

}  // namespace intarsia::graph
