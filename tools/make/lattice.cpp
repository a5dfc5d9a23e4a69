#include "tools/make/lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/base/random.h"
#include "engine/parallel/compact.h"
#include "engine/parallel/for_each.h"

namespace intarsia::tools {

namespace {

constexpr int kMargin = 4;  // empty cells around the box; also how far from the surface bricks are kept, in spacings
constexpr int kLeaf = 4;    // boxes of at most this many points a side are sampled point by point

// The axes of the lattice turned so that the coordinate planes of the shape cut it at (2, 2, 1) / 3: there the quads
// are most even; then turned a little further, by the seed, so that no pattern repeats.
Eigen::Matrix3d lattice_axes(std::uint64_t seed) {
  Eigen::Matrix3d even;
  even << 2, -1, 2, 2, 2, -1, -1, 2, 2;
  const Random random(seed, 0x1a771ce);
  const Vec3 tilt(random.uniform(0) - 0.5, random.uniform(1) - 0.5, random.uniform(2) - 0.5);
  const Real angle = 0.3 * tilt.norm();
  return Eigen::AngleAxisd(angle, tilt.normalized()).toRotationMatrix() * (even / 3.0);
}

std::uint64_t bits(int count) { return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1; }

}  // namespace

Lattice::Lattice(const Work& work, const Field& field, Real spacing, std::uint64_t seed) {
  const Eigen::Matrix3d axes = lattice_axes(seed);
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);  // the field's box in lattice directions
  for (int c = 0; c < 8; ++c) {
    const Vec3 corner(c & 1 ? field.high.x() : field.low.x(), c & 2 ? field.high.y() : field.low.y(),
                      c & 4 ? field.high.z() : field.low.z());
    const Vec3 q = axes.transpose() * corner;
    low = low.cwiseMin(q), high = high.cwiseMax(q);
  }
  const Random random(seed, 0x0ff5e7);
  for (int a = 0; a < 3; ++a) {
    low[a] -= (kMargin + random.uniform(a)) * spacing;
    const Real points = std::ceil((high[a] - low[a]) / spacing) + kMargin + 2;
    if (!(points < 1e6))
      throw Error(ErrorCode::too_large, "the shape needs too fine a lattice: ask for fewer triangles");
    size_[a] = (static_cast<int>(points) + kBrick - 1) / kBrick;
  }
  if (Real(size_[0]) * size_[1] * size_[2] > 4e8)
    throw Error(ErrorCode::too_large, "the shape needs too fine a lattice: ask for fewer triangles");
  frame_.spacing = spacing;
  frame_.origin = axes * low;
  frame_.step_x = spacing * axes.col(0), frame_.step_y = spacing * axes.col(1), frame_.step_z = spacing * axes.col(2);

  find_bricks(work, field);
  inside_.assign(bricks_.size() * kRows, 0);
  for_each(work, Cost::single, bricks_.size(), [&](std::size_t b) { sample_brick(field, b); });
  make_well_composed(work, field);
  number(work);
}

Point3i Lattice::brick_corner(std::size_t brick) const {
  const std::size_t b = bricks_[brick], sx = size_[0], sy = size_[1];
  return {static_cast<int>(b % sx) * kBrick, static_cast<int>(b / sx % sy) * kBrick,
          static_cast<int>(b / (sx * sy)) * kBrick};
}

std::size_t Lattice::brick_of(int i, int j, int k) const {
  return (std::size_t(k / kBrick) * size_[1] + j / kBrick) * size_[0] + i / kBrick;
}

void Lattice::find_bricks(const Work& work, const Field& field) {
  const std::size_t total = std::size_t(size_[0]) * size_[1] * size_[2];
  solid_.assign(total, 0);
  std::vector<std::uint8_t> near(total);
  const Real reach = (0.5 * std::sqrt(3.0) * (kBrick - 1) + kMargin) * frame_.spacing;
  for_each(work, Cost::light, total, [&](std::size_t b) {
    const std::size_t sx = size_[0], sy = size_[1];
    const Real half = 0.5 * (kBrick - 1);
    const Real f = field.value(frame_.at(Real(b % sx) * kBrick + half, Real(b / sx % sy) * kBrick + half,
                                         Real(b / (sx * sy)) * kBrick + half));
    near[b] = std::abs(f) <= reach;
    solid_[b] = f < 0;
  });
  bricks_ = compact(work, total, [&](std::size_t b) { return near[b] != 0; });
  slot_.assign(total, kNone);
  for_each(work, Cost::light, bricks_.size(), [&](std::size_t s) { slot_[bricks_[s]] = static_cast<Index>(s); });
}

void Lattice::sample_brick(const Field& field, std::size_t brick) { sample_box(field, brick, {0, 0, 0}, kBrick); }

void Lattice::sample_box(const Field& field, std::size_t brick, const Point3i& local, int size) {
  const Point3i c = brick_corner(brick);
  std::uint64_t* rows = inside_.data() + brick * kRows;
  const Real half = 0.5 * (size - 1);
  const Real f = field.value(frame_.at(c[0] + local[0] + half, c[1] + local[1] + half, c[2] + local[2] + half));
  if (std::abs(f) > std::sqrt(3.0) * half * frame_.spacing) {
    if (f < 0)
      for (int z = local[2]; z < local[2] + size; ++z)
        for (int y = local[1]; y < local[1] + size; ++y) rows[z * kBrick + y] |= bits(size) << local[0];
    return;
  }
  if (size > kLeaf) {
    const int s = size / 2;
    for (int o = 0; o < 8; ++o)
      sample_box(field, brick, {local[0] + (o & 1 ? s : 0), local[1] + (o & 2 ? s : 0), local[2] + (o & 4 ? s : 0)}, s);
    return;
  }
  for (int z = local[2]; z < local[2] + size; ++z)
    for (int y = local[1]; y < local[1] + size; ++y)
      for (int x = local[0]; x < local[0] + size; ++x)
        if (field.value(frame_.at(c[0] + x, c[1] + y, c[2] + z)) < 0) rows[z * kBrick + y] |= std::uint64_t{1} << x;
}

std::uint64_t Lattice::inside_row(int i, int j, int k) const {
  if (i < 0 || j < 0 || k < 0 || i >= size_[0] * kBrick || j >= size_[1] * kBrick || k >= size_[2] * kBrick) return 0;
  const std::size_t b = brick_of(i, j, k);
  if (slot_[b] == kNone) return solid_[b] ? ~std::uint64_t{0} : 0;
  return inside_[slot_[b] * kRows + (k % kBrick) * kBrick + j % kBrick];
}

std::uint64_t Lattice::cell_row(int i, int j, int k) const {
  if (i < 0 || j < 0 || k < 0 || i >= size_[0] * kBrick || j >= size_[1] * kBrick || k >= size_[2] * kBrick) return 0;
  const std::size_t b = brick_of(i, j, k);
  return slot_[b] == kNone ? 0 : cells_[slot_[b] * kRows + (k % kBrick) * kBrick + j % kBrick];
}

std::uint64_t Lattice::vertex_id(int i, int j, int k) const {
  const std::size_t s = slot_[brick_of(i, j, k)], row = s * kRows + (k % kBrick) * kBrick + j % kBrick;
  return vertex_offset_[s] + rank_[row] + std::popcount(cells_[row] & bits(i % kBrick));
}

bool Lattice::inside(int i, int j, int k) const { return inside_row(i - i % kBrick, j, k) >> (i % kBrick) & 1; }

// The eight corners of the 64 cells that start at (i, j, k): bit x of word c belongs to corner (c & 1, c >> 1 & 1, c >>
// 2).
std::array<std::uint64_t, 8> Lattice::corners_row(int i, int j, int k) const {
  std::array<std::uint64_t, 8> c;
  for (int o = 0; o < 4; ++o) {
    const std::uint64_t row = inside_row(i, j + (o & 1), k + (o >> 1));
    c[2 * o] = row;
    c[2 * o + 1] = row >> 1 | inside_row(i + kBrick, j + (o & 1), k + (o >> 1)) << 63;
  }
  return c;
}

namespace {

// Cells among 64 whose eight corners, or one of the three faces at their first corner, break well-composedness.
std::uint64_t critical_cells(const std::array<std::uint64_t, 8>& c) {
  const auto square = [&](int a, int b, int d, int e) { return ~(c[a] ^ c[e]) & ~(c[b] ^ c[d]) & (c[a] ^ c[b]); };
  std::uint64_t bad = square(0, 1, 2, 3) | square(0, 1, 4, 5) | square(0, 2, 4, 6);
  for (int a = 0; a < 4; ++a) {  // corners a and 7 - a alone
    std::uint64_t alone = ~(c[a] ^ c[7 - a]);
    for (int o = 0; o < 8; ++o)
      if (o != a && o != 7 - a) alone &= c[a] ^ c[o];
    bad |= alone;
  }
  return bad;
}

}  // namespace

// Adds points to the inside only, so it ends; of the points that would mend a cell, the one nearest to the surface.
void Lattice::make_well_composed(const Work& work, const Field& field) {
  std::vector<std::vector<Point3i>> found(bricks_.size());
  for_each(work, Cost::single, bricks_.size(), [&](std::size_t b) {
    const Point3i o = brick_corner(b);
    for (int z = 0; z < kBrick; ++z)
      for (int y = 0; y < kBrick; ++y)
        for (std::uint64_t bad = critical_cells(corners_row(o[0], o[1] + y, o[2] + z)); bad; bad &= bad - 1)
          found[b].push_back({o[0] + std::countr_zero(bad), o[1] + y, o[2] + z});
  });
  std::vector<Point3i> todo;
  for (const auto& f : found) todo.insert(todo.end(), f.begin(), f.end());
  for (std::size_t n = 0; n < todo.size(); ++n) {
    if (n % 1024 == 0) work.check();
    const auto [i, j, k] = todo[n];
    std::array<std::uint64_t, 8> c;
    for (int o = 0; o < 8; ++o) c[o] = inside(i + (o & 1), j + (o >> 1 & 1), k + (o >> 2));
    if (!(critical_cells(c) & 1)) continue;
    Point3i best{};
    Real nearest = 1e300;
    for (int o = 0; o < 8; ++o) {
      if (c[o]) continue;
      std::array<std::uint64_t, 8> mended = c;
      mended[o] = 1;
      const Point3i p{i + (o & 1), j + (o >> 1 & 1), k + (o >> 2)};
      const Real f = std::abs(field.value(frame_.at(p[0], p[1], p[2]))) + (critical_cells(mended) & 1 ? 1e100 : 0);
      if (f < nearest) nearest = f, best = p;
    }
    const std::size_t s = slot_[brick_of(best[0], best[1], best[2])];
    if (s == kNone) throw Error(ErrorCode::internal, "a lattice point far from the surface had to be changed");
    inside_[s * kRows + (best[2] % kBrick) * kBrick + best[1] % kBrick] |= std::uint64_t{1} << (best[0] % kBrick);
    for (int o = 0; o < 8; ++o) todo.push_back({best[0] - (o & 1), best[1] - (o >> 1 & 1), best[2] - (o >> 2)});
    todo.push_back(todo[n]);  // one point may not be enough
  }
}

void Lattice::number(const Work& work) {
  cells_.assign(bricks_.size() * kRows, 0);
  rank_.assign(bricks_.size() * kRows, 0);
  vertex_offset_.assign(bricks_.size() + 1, 0);
  quad_offset_.assign(bricks_.size() + 1, 0);
  for_each(work, Cost::single, bricks_.size(), [&](std::size_t b) {
    const Point3i o = brick_corner(b);
    std::uint32_t vertices = 0, quads = 0;
    for (int z = 0; z < kBrick; ++z)
      for (int y = 0; y < kBrick; ++y) {
        const auto c = corners_row(o[0], o[1] + y, o[2] + z);
        std::uint64_t any = 0, all = ~std::uint64_t{0};
        for (const std::uint64_t w : c) any |= w, all &= w;
        const std::size_t row = b * kRows + z * kBrick + y;
        cells_[row] = any & ~all;
        rank_[row] = vertices;
        vertices += std::popcount(any & ~all);
        quads += std::popcount(c[0] ^ c[1]) + std::popcount(c[0] ^ c[2]) + std::popcount(c[0] ^ c[4]);
      }
    vertex_offset_[b + 1] = vertices;
    quad_offset_[b + 1] = quads;
  });
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    vertex_offset_[b + 1] += vertex_offset_[b];
    quad_offset_[b + 1] += quad_offset_[b];
  }
}

}  // namespace intarsia::tools
