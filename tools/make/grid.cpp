#include "tools/make/grid.h"

#include <algorithm>
#include <cmath>

#include "tools/make/quad.h"

namespace intarsia::tools {

namespace {

constexpr std::uint64_t kPiece = 16384;                       // vertices, and quads, of a piece
constexpr std::uint64_t kSteps = 0x717e12, kNoise = 0x2015e;  // random streams

class Grid : public MeshSource {
 public:
  explicit Grid(const Disturbance& d) : disturbance_(d) {}
  std::uint64_t vertex_count() const final { return vertices_; }
  std::uint64_t face_count() const final { return 2 * quads_; }
  std::size_t piece_count() const final { return (std::max(vertices_, quads_) + kPiece - 1) / kPiece; }
  std::uint64_t first_vertex(std::size_t piece) const final { return std::min(vertices_, piece * kPiece); }
  std::uint64_t first_face(std::size_t piece) const final { return 2 * std::min(quads_, piece * kPiece); }

  void make(const Work& work, std::size_t piece, Piece& out) const final {
    out.clear();
    const Random random(disturbance_.seed, kNoise);
    for (std::uint64_t v = first_vertex(piece); v < first_vertex(piece + 1); ++v) {
      if (v % 1024 == 0 && work.cancelled()) return;
      Vec3 p, normal;
      vertex(v, p, normal);
      if (disturbance_.noise > 0) p += disturbance_.noise * random.normal(v) * normal;
      out.point.push_back(p);
    }
    for (std::uint64_t q = first_face(piece) / 2; q < first_face(piece + 1) / 2; ++q) {
      if (q % 1024 == 0 && work.cancelled()) return;
      bool tie = false;
      const std::array<std::uint64_t, 4> c = quad(q, tie);
      std::array<Vec3, 4> p;
      Vec3 normal;
      for (int i = 0; i < 4; ++i) vertex(c[i], p[i], normal);
      const int r = better_diagonal(p, tie);
      for (const int k : {0, 1, 2, 0, 2, 3}) out.corner.push_back(static_cast<Index>(c[(k + r) % 4]));
    }
  }

 protected:
  // Position (without noise) and unit normal of a vertex.
  virtual void vertex(std::uint64_t v, Vec3& point, Vec3& normal) const = 0;
  // Corners counter-clockwise; `tie` alternates like a chequerboard.
  virtual std::array<std::uint64_t, 4> quad(std::uint64_t q, bool& tie) const = 0;

  // A random step in grid units.
  Vec3 random_step(std::uint64_t v) const {
    if (disturbance_.irregularity <= 0) return Vec3::Zero();
    return 0.5 * disturbance_.irregularity * random_direction(Random(disturbance_.seed, kSteps), v);
  }

  Disturbance disturbance_;
  std::uint64_t vertices_ = 0, quads_ = 0;
};

class SheetGrid final : public Grid {
 public:
  SheetGrid(const Sheet& sheet, std::uint64_t triangles, const Disturbance& d) : Grid(d), sheet_(sheet) {
    const Real quads = 0.5 * static_cast<Real>(triangles);
    const Real along = std::sqrt(quads * sheet.profile.length() / sheet.depth);
    n_ = std::max<std::uint64_t>(sheet.closed ? 3 : 1, std::llround(along));
    m_ = std::max<std::uint64_t>(1, std::llround(quads / static_cast<Real>(n_)));
    columns_ = sheet.closed ? n_ : n_ + 1;
    vertices_ = columns_ * (m_ + 1);
    quads_ = n_ * m_;
  }

 private:
  void vertex(std::uint64_t v, Vec3& point, Vec3& normal) const override {
    const std::uint64_t i = v % columns_, j = v / columns_;
    const Real ds = sheet_.profile.length() / static_cast<Real>(n_), dy = sheet_.depth / static_cast<Real>(m_);
    const Vec3 step = std::min(ds, dy) * random_step(v);
    Real s = ds * static_cast<Real>(i), y = dy * static_cast<Real>(j) - 0.5 * sheet_.depth;
    if (sheet_.closed || (i > 0 && i < n_)) s += step.x();
    if (j > 0 && j < m_) y += step.y();
    if (sheet_.closed && s < 0) s += sheet_.profile.length();
    sheet_.profile.at(s, point, normal);
    point.y() = y;
  }
  std::array<std::uint64_t, 4> quad(std::uint64_t q, bool& tie) const override {
    const std::uint64_t i = q % n_, j = q / n_, next = (i + 1) % columns_;
    tie = (i + j) & 1;
    return {j * columns_ + i, j * columns_ + next, (j + 1) * columns_ + next, (j + 1) * columns_ + i};
  }

  Sheet sheet_;
  std::uint64_t n_ = 1, m_ = 1, columns_ = 2;
};

class CubeGrid final : public Grid {
 public:
  CubeGrid(Real half, std::uint64_t triangles, const Disturbance& d) : Grid(d), half_(half) {
    n_ = std::max<std::uint64_t>(1, std::llround(std::sqrt(static_cast<Real>(triangles) / 12)));
    vertices_ = 6 * n_ * n_ + 2;
    quads_ = 6 * n_ * n_;
  }

 private:
  using Point = std::array<std::uint64_t, 3>;

  // Layer by layer from below; the layers between lid and floor are rings.
  std::uint64_t id(const Point& p) const {
    const std::uint64_t n = n_, side = n + 1;
    const auto [i, j, k] = p;
    if (k == 0) return j * side + i;
    if (k == n) return side * side + (n - 1) * 4 * n + j * side + i;
    const std::uint64_t ring = j == 0 ? i : i == n ? n + j : j == n ? 3 * n - i : 4 * n - j;
    return side * side + (k - 1) * 4 * n + ring;
  }
  Point lattice_point(std::uint64_t v) const {
    const std::uint64_t n = n_, side = n + 1;
    if (v < side * side) return {v % side, v / side, 0};
    v -= side * side;
    if (v >= (n - 1) * 4 * n) {
      v -= (n - 1) * 4 * n;
      return {v % side, v / side, n};
    }
    const std::uint64_t k = v / (4 * n) + 1, r = v % (4 * n), part = r / n, at = r % n;
    if (part == 0) return {at, 0, k};
    if (part == 1) return {n, at, k};
    if (part == 2) return {n - at, n, k};
    return {0, n - at, k};
  }
  void vertex(std::uint64_t v, Vec3& point, Vec3& normal) const override {
    const Point p = lattice_point(v);
    const Vec3 step = random_step(v);
    for (int a = 0; a < 3; ++a) {
      const bool low = p[a] == 0, high = p[a] == n_;
      normal[a] = low ? -1 : high ? 1 : 0;
      point[a] = low    ? -half_
                 : high ? half_
                        : half_ * (2 * (static_cast<Real>(p[a]) + step[a]) / static_cast<Real>(n_) - 1);
    }
    normal.normalize();
  }
  std::array<std::uint64_t, 4> quad(std::uint64_t q, bool& tie) const override {
    const std::uint64_t side = q / (n_ * n_), a = q % n_, b = q / n_ % n_;
    const int axis = static_cast<int>(side / 2), u = (axis + 1) % 3, w = (axis + 2) % 3;
    const bool high = side & 1;
    tie = (a + b) & 1;
    std::array<std::uint64_t, 4> c;
    for (int i = 0; i < 4; ++i) {
      Point p;
      p[axis] = high ? n_ : 0;
      p[u] = a + (i == 1 || i == 2);
      p[w] = b + (i >= 2);
      c[high ? i : 3 - i] = id(p);
    }
    return c;
  }

  Real half_;
  std::uint64_t n_ = 1;
};

}  // namespace

void Profile::add(Real length, Real turn) {
  parts_.push_back({length_, length, turn, x_, z_, angle_});
  joints_.push_back(length_);
  Vec3 point, normal;
  length_ += length;
  at(length_, point, normal);
  x_ = point.x(), z_ = point.z(), angle_ += turn;
}

void Profile::at(Real s, Vec3& point, Vec3& normal) const {
  std::size_t i = 0;
  while (i + 1 < parts_.size() && s >= parts_[i + 1].start) ++i;
  const Part& part = parts_[i];
  const Real t = s - part.start, angle = part.angle + part.turn * t / part.length;
  normal = Vec3(-std::sin(angle), 0, std::cos(angle));
  if (part.turn == 0) {
    point = Vec3(part.x + t * std::cos(angle), 0, part.z + t * std::sin(angle));
  } else {
    const Real radius = part.length / part.turn;  // signed: the centre is to the left for positive turns
    point = Vec3(part.x + radius * (std::sin(angle) - std::sin(part.angle)), 0,
                 part.z - radius * (std::cos(angle) - std::cos(part.angle)));
  }
}

Real Profile::distance(const Vec3& p) const {
  Real best = 1e300;
  for (const Part& part : parts_) {
    const Real c = std::cos(part.angle), s = std::sin(part.angle), dx = p.x() - part.x, dz = p.z() - part.z;
    const Real along = c * dx + s * dz, left = c * dz - s * dx;  // in the frame of the part's start
    Real d;
    if (part.turn == 0) {
      d = std::hypot(along - std::clamp(along, 0.0, part.length), left);
    } else {
      const Real radius = part.length / part.turn;
      const Real sweep = std::abs(part.turn), full = 6.283185307179586, r = std::abs(radius);
      Real angle = std::atan2(along, radius > 0 ? r - left : r + left);  // 0 at the start, growing along the arc
      if (angle < -1e-9) angle += full;
      const Real over = angle > sweep ? (angle - sweep < full - angle ? sweep : 0) : angle;
      const Real ex = r * std::sin(over), ez = r - r * std::cos(over);
      d = std::hypot(along - ex, (radius > 0 ? left : -left) - ez);
    }
    best = std::min(best, d);
  }
  return best;
}

std::unique_ptr<MeshSource> sheet_grid(const Sheet& sheet, std::uint64_t triangles, const Disturbance& disturbance) {
  return std::make_unique<SheetGrid>(sheet, triangles, disturbance);
}

std::unique_ptr<MeshSource> cube_grid(Real half, std::uint64_t triangles, const Disturbance& disturbance) {
  return std::make_unique<CubeGrid>(half, triangles, disturbance);
}

}  // namespace intarsia::tools
