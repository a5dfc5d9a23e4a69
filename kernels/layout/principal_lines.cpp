#include "kernels/layout/principal_lines.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::kernels {
namespace {

Real confidence(const CurvatureFields& fields, std::size_t v) {
  if (!fields.direction_ok[v] || fields.status[v] == FitStatus::invalid) return 0;
  const Real a = std::abs(fields.kmax[v]), b = std::abs(fields.kmin[v]), high = std::max(a, b);
  if (!(high > 0) || !std::isfinite(high)) return 0;
  return std::abs(a - b) / high * std::min(Real{1}, high / 2);
}

}  // namespace

PrincipalLines principal_lines(const Work& work, const CurvatureFields& fields) {
  const std::size_t n = fields.vertex_count();
  PrincipalLines out;
  for (auto* lines : {&out.tmax, &out.tmin})
    for (auto& coordinate : *lines) coordinate.resize(n);
  out.confidence.resize(n);
  for_each(work, Cost::light, n, [&](std::size_t v) {
    const Vec3 high = fields.tmax[v], low = fields.tmin[v];
    for (int i = 0; i < 3; ++i) {
      out.tmax[static_cast<std::size_t>(i)][v] = static_cast<float>(high[i]);
      out.tmin[static_cast<std::size_t>(i)][v] = static_cast<float>(low[i]);
    }
    out.confidence[v] = static_cast<float>(confidence(fields, v));
  });
  return out;
}

}  // namespace intarsia::kernels
