#include "tools/picture/raster.h"

#include <atomic>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {
namespace {

constexpr std::int64_t kUnit = 256;     // fixed-point steps a sample
constexpr Real kLimit = Real(1 << 20);  // samples; larger corners are not drawn, so that products fit 64 bits
constexpr int kNarrow = 10;             // samples; wider faces solve for the span of each row instead of testing

// Edge function of a -> b, positive inside. zero_inside makes the top-left rule exact in integers.
struct Edge {
  std::int64_t at_origin, step_x, step_y;
  Edge(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t px, std::int64_t py) {
    const std::int64_t dx = bx - ax, dy = by - ay;
    at_origin = dx * (py - ay) - dy * (px - ax);
    if (!(-dy > 0 || (dy == 0 && dx > 0))) --at_origin;
    step_x = -dy * kUnit, step_y = dx * kUnit;
  }
};

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
  const std::int64_t q = a / b;
  return q - (a % b < 0 ? 1 : 0);
}

// Shrinks [first, last] to the columns where the edge function e + i * step is not negative.
void clip_span(std::int64_t e, std::int64_t step, std::int64_t& first, std::int64_t& last) {
  if (step > 0) {
    first = std::max(first, -floor_div(e, step));
  } else if (step < 0) {
    last = std::min(last, floor_div(e, -step));
  } else if (e < 0) {
    last = first - 1;
  }
}

void keep_smallest(std::uint64_t& slot, std::uint64_t key) {
  std::atomic_ref<std::uint64_t> cell(slot);
  std::uint64_t seen = cell.load(std::memory_order_relaxed);
  while (key < seen && !cell.compare_exchange_weak(seen, key, std::memory_order_relaxed)) {
  }
}

std::int64_t to_fixed(Real v) {  // rounds to nearest; the shift keeps the cast on positive numbers
  constexpr std::int64_t shift = std::int64_t{1} << 30;
  return static_cast<std::int64_t>(v * kUnit + static_cast<Real>(shift) + 0.5) - shift;
}

void draw_face(const Shape& shape, Index f, Frame& frame) {
  std::int64_t x[3], y[3];
  Real d[3];
  for (int i = 0; i < 3; ++i) {
    const Projected p = frame.camera.project(shape.point(shape.corner[3 * std::size_t{f} + static_cast<unsigned>(i)]));
    const Real sx = p.x * frame.samples, sy = p.y * frame.samples;
    if (!(std::abs(sx) < kLimit && std::abs(sy) < kLimit)) return;
    x[i] = to_fixed(sx), y[i] = to_fixed(sy), d[i] = p.depth;
  }
  const std::int64_t low_x = std::min({x[0], x[1], x[2]}), high_x = std::max({x[0], x[1], x[2]});
  const std::int64_t low_y = std::min({y[0], y[1], y[2]}), high_y = std::max({y[0], y[1], y[2]});
  constexpr std::int64_t half = kUnit / 2;
  const std::int64_t c0 = std::max<std::int64_t>(0, (low_x + half - 1) >> 8),
                     r0 = std::max<std::int64_t>(0, (low_y + half - 1) >> 8);
  const std::int64_t c1 = std::min<std::int64_t>(frame.columns - 1, (high_x - half) >> 8);
  const std::int64_t r1 = std::min<std::int64_t>(frame.rows - 1, (high_y - half) >> 8);
  if (c0 > c1 || r0 > r1) return;  // between the samples: most faces of a large mesh
  std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  if (area == 0) return;
  if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]), std::swap(d[1], d[2]), area = -area;

  const std::int64_t px = c0 * kUnit + half, py = r0 * kUnit + half;
  Edge e[3] = {{x[0], y[0], x[1], y[1], px, py}, {x[1], y[1], x[2], y[2], px, py}, {x[2], y[2], x[0], y[0], px, py}};

  // Depth as a plane over the picture, clamped to the corners' range because slivers extrapolate wildly.
  const Real a1 = d[1] - d[0], a2 = d[2] - d[0], inverse = 1 / static_cast<Real>(area);
  const Real slope_x = (a1 * static_cast<Real>(y[2] - y[0]) - a2 * static_cast<Real>(y[1] - y[0])) * inverse;
  const Real slope_y = (a2 * static_cast<Real>(x[1] - x[0]) - a1 * static_cast<Real>(x[2] - x[0])) * inverse;
  const Real base = d[0] + slope_x * static_cast<Real>(px - x[0]) + slope_y * static_cast<Real>(py - y[0]);
  const Real near = std::clamp(std::min({d[0], d[1], d[2]}), Real(0), Real(1));
  const Real far = std::clamp(std::max({d[0], d[1], d[2]}), Real(0), Real(1));
  const Real dx = slope_x * kUnit, dy = slope_y * kUnit;
  constexpr Real full = 4294967294.0;  // the largest depth stays below kEmpty

  const std::int64_t wide = c1 - c0;
  std::uint64_t* row = frame.key.data() + r0 * frame.columns + c0;
  for (std::int64_t r = 0; r <= r1 - r0; ++r, row += frame.columns) {
    const std::int64_t e0 = e[0].at_origin + r * e[0].step_y, e1 = e[1].at_origin + r * e[1].step_y,
                       e2 = e[2].at_origin + r * e[2].step_y;
    const Real row_depth = base + static_cast<Real>(r) * dy;
    const auto put = [&](std::int64_t c) {
      const Real depth = std::min(far, std::max(near, row_depth + static_cast<Real>(c) * dx));
      const auto high = static_cast<std::uint64_t>(static_cast<std::int64_t>(depth * full));
      keep_smallest(row[c], high << 32 | f);
    };
    if (wide < kNarrow) {
      for (std::int64_t c = 0; c <= wide; ++c)
        if (((e0 + c * e[0].step_x) | (e1 + c * e[1].step_x) | (e2 + c * e[2].step_x)) >= 0) put(c);
    } else {
      std::int64_t first = 0, last = wide;
      clip_span(e0, e[0].step_x, first, last);
      clip_span(e1, e[1].step_x, first, last);
      clip_span(e2, e[2].step_x, first, last);
      for (std::int64_t c = first; c <= last; ++c) put(c);
    }
  }
}

}  // namespace

void rasterise(const Work& work, const Shape& shape, const Camera& camera, int samples, Frame& frame) {
  if (samples < 1 || samples > 8) throw Error(ErrorCode::bad_argument, "samples per pixel side must lie in 1 to 8");
  frame.camera = camera;
  frame.samples = samples;
  frame.columns = camera.width * samples, frame.rows = camera.height * samples;
  frame.key.resize(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows));
  for_each_block(work, Cost::light, frame.key.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    std::fill(frame.key.begin() + static_cast<std::ptrdiff_t>(begin),
              frame.key.begin() + static_cast<std::ptrdiff_t>(end), Frame::kEmpty);
  });
  for_each_block(work, Cost::medium, shape.face_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t f = begin; f < end; ++f) draw_face(shape, static_cast<Index>(f), frame);
  });
}

}  // namespace intarsia::tools
