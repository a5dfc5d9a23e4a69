#include "tools/picture/lines.h"

#include <array>
#include <atomic>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {
namespace {

// Painted from left to right.
constexpr std::array<CurveKind, kCurveKinds> kPaintOrder = {
    CurveKind::subdivision, CurveKind::extension, CurveKind::valley, CurveKind::ridge,
    CurveKind::sharp,       CurveKind::border,    CurveKind::given};

void keep_largest(std::uint32_t& slot, std::uint32_t value) {
  std::atomic_ref<std::uint32_t> cell(slot);
  std::uint32_t seen = cell.load(std::memory_order_relaxed);
  while (value > seen && !cell.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

// A capsule around a -> b in sample units.
void draw_segment(const Frame& frame, const Vec3& from, const Vec3& to, float width, std::uint32_t id,
                  std::vector<std::uint32_t>& line) {
  const Projected a = frame.camera.project(from), b = frame.camera.project(to);
  const Real n = frame.samples, half = 0.5 * static_cast<Real>(width) * n;
  const Real ax = a.x * n, ay = a.y * n, dx = b.x * n - ax, dy = b.y * n - ay;
  const Real low_x = std::min(ax, ax + dx) - half - 0.5, high_x = std::max(ax, ax + dx) + half - 0.5;
  const Real low_y = std::min(ay, ay + dy) - half - 0.5, high_y = std::max(ay, ay + dy) + half - 0.5;
  if (!(high_x >= 0 && high_y >= 0 && low_x < frame.columns && low_y < frame.rows)) return;
  const int c0 = static_cast<int>(std::max(Real(0), std::ceil(low_x)));
  const int c1 = static_cast<int>(std::min(Real(frame.columns - 1), std::floor(high_x)));
  const int r0 = static_cast<int>(std::max(Real(0), std::ceil(low_y)));
  const int r1 = static_cast<int>(std::min(Real(frame.rows - 1), std::floor(high_y)));
  const Real square = dx * dx + dy * dy, inverse = square > 0 ? 1 / square : 0;
  // The surface beside a curve may rise towards the viewer: by up to two on one for the half width, plus a pixel.
  const Real bias = (1 + static_cast<Real>(width)) * frame.camera.depth_per_pixel();
  for (int r = r0; r <= r1; ++r) {
    const Real py = r + 0.5 - ay;
    // The infinite line's band in this row bounds the columns worth testing.
    int first = c0, last = c1;
    if (std::abs(dy) > 1e-9 && c1 - c0 > 8) {
      const Real reach = half * std::sqrt(square) / std::abs(dy), middle = ax + dx * py / dy - 0.5;
      const Real lo = std::max(Real(c0), std::floor(middle - reach)),
                 hi = std::min(Real(c1), std::ceil(middle + reach));
      if (lo > hi) continue;
      first = static_cast<int>(lo), last = static_cast<int>(hi);
    }
    for (int c = first; c <= last; ++c) {
      const Real px = c + 0.5 - ax;
      const Real t = std::clamp((px * dx + py * dy) * inverse, Real(0), Real(1));
      const Real ox = px - t * dx, oy = py - t * dy;
      if (ox * ox + oy * oy > half * half) continue;
      const Real depth = a.depth + t * (b.depth - a.depth) - bias;
      const std::uint64_t key = frame.at(c, r);
      if (key != Frame::kEmpty && depth > static_cast<Real>(key >> 32) * 0x1p-32) continue;
      keep_largest(
          line[static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) + static_cast<std::size_t>(c)],
          id);
    }
  }
}

}  // namespace

LineStyle style_of(CurveKind kind) {
  switch (kind) {
    case CurveKind::ridge:
      return {{208, 32, 38}, 2.2f};
    case CurveKind::valley:
      return {{28, 78, 190}, 2.2f};
    case CurveKind::sharp:
      return {{178, 58, 0}, 2.4f};
    case CurveKind::border:
      return {{0, 98, 58}, 2.6f};
    case CurveKind::extension:
      return {{38, 38, 42}, 1.9f};
    case CurveKind::subdivision:
      return {{92, 92, 100}, 1.3f};
    case CurveKind::given:
      return {{140, 40, 160}, 2.6f};
  }
  return {};
}

Lines lines_of(const MeshView& mesh, const CurveNetwork& network) {
  Lines lines;
  std::vector<Vec3> points;
  for (CurveKind kind : kPaintOrder)
    for (Index c = 0; c < network.curve_count(); ++c) {
      if (network.kind[c] != kind) continue;
      points.clear();
      for (Index p : network.curve.row(c)) points.push_back(position(mesh, network.point[p]));
      lines.add(points, style_of(kind));
    }
  return lines;
}

Lines lines_of(const MeshView& refined, std::span<const std::uint8_t> on_network,
               std::span<const CurveKind> edge_kind) {
  Lines lines;
  for (CurveKind kind : kPaintOrder)
    for (Index e = 0; e < refined.edge_count(); ++e) {
      if (!on_network[e] || edge_kind[e] != kind) continue;
      const Vec3 ends[2] = {refined.point(refined.edge_v0[e]), refined.point(refined.edge_v1[e])};
      lines.add(ends, style_of(kind));
    }
  return lines;
}

Lines restyled(Lines lines, const LineStyle& style) {
  std::fill(lines.style.begin(), lines.style.end(), style);
  return lines;
}

void draw_lines(const Work& work, const Frame& frame, const Lines& lines, std::vector<std::uint32_t>& line) {
  line.assign(frame.key.size(), 0);
  for_each(work, Cost::heavy, lines.count(), [&](std::size_t i) {
    const std::size_t begin = lines.offset[i], end = lines.offset[i + 1];
    for (std::size_t k = begin; k + 1 < end; ++k)
      draw_segment(frame, lines.point[k], lines.point[k + 1], lines.style[i].width, static_cast<std::uint32_t>(i + 1),
                   line);
  });
}

}  // namespace intarsia::tools
