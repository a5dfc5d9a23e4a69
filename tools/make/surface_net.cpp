#include "tools/make/surface_net.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/random.h"
#include "tools/make/quad.h"

namespace intarsia::tools {

namespace {

constexpr int kSweeps = 6;          // relaxation sweeps
constexpr Real kRelax = 0.7;        // part of the way to the mean of the neighbours
constexpr int kHalo = kSweeps + 3;  // cells around a brick that its own vertices and triangles depend on
constexpr int kSide = kBrick + 2 * kHalo;

struct Cell {
  int x, y, z;                     // from -kHalo to kBrick + kHalo - 1
  std::array<Index, 6> neighbour;  // cells across the faces that the surface crosses, or kNone
};

// The cells of a brick and its halo.
class Patch {
 public:
  Patch(const Lattice& lattice, std::size_t brick) : lattice_(lattice), corner_(lattice.brick_corner(brick)) {
    index_.assign(std::size_t(kSide) * kSide * kSide, kNone);
    collect();
    for (Cell& c : cells) link(c);
  }

  Index find(int x, int y, int z) const {
    return index_[(std::size_t(z + kHalo) * kSide + (y + kHalo)) * kSide + (x + kHalo)];
  }
  std::uint64_t id(const Cell& c) const {
    return lattice_.vertex_id(corner_[0] + c.x, corner_[1] + c.y, corner_[2] + c.z);
  }
  Vec3 centre(const Cell& c) const {
    return lattice_.frame().at(corner_[0] + c.x + 0.5, corner_[1] + c.y + 0.5, corner_[2] + c.z + 0.5);
  }

  std::vector<Cell> cells;

 private:
  void collect() {
    for (int z = -kHalo; z < kBrick + kHalo; ++z)
      for (int y = -kHalo; y < kBrick + kHalo; ++y)
        for (int b = -1; b <= 1; ++b) {
          std::uint64_t row = lattice_.cell_row(corner_[0] + b * kBrick, corner_[1] + y, corner_[2] + z);
          if (b < 0) row &= ~std::uint64_t{0} << (kBrick - kHalo);
          if (b > 0) row &= (std::uint64_t{1} << kHalo) - 1;
          for (; row; row &= row - 1) {
            const int x = b * kBrick + std::countr_zero(row);
            index_[(std::size_t(z + kHalo) * kSide + (y + kHalo)) * kSide + (x + kHalo)] =
                static_cast<Index>(cells.size());
            cells.push_back({x, y, z, {}});
          }
        }
  }
  bool inside(int x, int y, int z) const {
    const int bx = x < 0 ? -kBrick : x >= kBrick ? kBrick : 0;
    return lattice_.inside_row(corner_[0] + bx, corner_[1] + y, corner_[2] + z) >> (x - bx) & 1;
  }
  void link(Cell& c) const {
    int in = 0;
    for (int o = 0; o < 8; ++o) in |= inside(c.x + (o & 1), c.y + (o >> 1 & 1), c.z + (o >> 2)) << o;
    constexpr int kFace[6] = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};  // corners of the faces -x +x -y +y -z +z
    for (int f = 0; f < 6; ++f) {
      c.neighbour[f] = kNone;
      if ((in & kFace[f]) == 0 || (in & kFace[f]) == kFace[f]) continue;
      const int d = f & 1 ? 1 : -1;
      const int x = c.x + (f / 2 == 0 ? d : 0), y = c.y + (f / 2 == 1 ? d : 0), z = c.z + (f / 2 == 2 ? d : 0);
      const auto within = [](int v) { return v >= -kHalo && v < kBrick + kHalo; };
      if (within(x) && within(y) && within(z)) c.neighbour[f] = find(x, y, z);
    }
  }

  const Lattice& lattice_;
  Point3i corner_;
  std::vector<Index> index_;
};

// Is the cell within `rings` of the brick's own cells?
bool near(const Cell& c, int rings) {
  const auto ok = [&](int v) { return v >= -rings && v < kBrick + rings; };
  return ok(c.x) && ok(c.y) && ok(c.z);
}

}  // namespace

SurfaceNet::SurfaceNet(const Work& work, std::shared_ptr<const Field> field, Real spacing,
                       const Disturbance& disturbance)
    : field_(std::move(field)), lattice_(work, *field_, spacing, disturbance.seed), disturbance_(disturbance) {}

void SurfaceNet::make(const Work& work, std::size_t piece, Piece& out) const {
  out.clear();
  if (lattice_.first_vertex(piece) == lattice_.first_vertex(piece + 1) &&
      lattice_.first_quad(piece) == lattice_.first_quad(piece + 1))
    return;
  const Patch patch(lattice_, piece);
  const std::vector<Cell>& cells = patch.cells;
  const Real h = lattice_.frame().spacing;
  const std::size_t n = cells.size();
  std::vector<Vec3> p(n), q(n);
  const auto over_cells = [&](int rings, const auto& body) {  // false if cancelled
    for (std::size_t i = 0; i < n; ++i) {
      if (i % 1024 == 0 && work.cancelled()) return false;
      if (near(cells[i], rings)) body(i);
    }
    return true;
  };
  const auto land = [&](Vec3& v) {  // onto the surface, to the last digits
    for (int step = 0; step < 12; ++step)
      if (std::abs(step_to_surface(*field_, v, 0.5 * h)) < 1e-15) break;
  };

  if (!over_cells(kHalo, [&](std::size_t i) {
        p[i] = patch.centre(cells[i]);
        step_to_surface(*field_, p[i], h);
        step_to_surface(*field_, p[i], h);
      }))
    return;
  for (int sweep = 1; sweep <= kSweeps; ++sweep) {
    if (!over_cells(kHalo - sweep, [&](std::size_t i) {
          Vec3 mean = Vec3::Zero();
          int count = 0;
          for (const Index k : cells[i].neighbour)
            if (k != kNone) mean += p[k], ++count;
          q[i] = p[i];
          if (count > 0) q[i] += kRelax * (mean / count - p[i]);
          step_to_surface(*field_, q[i], 0.5 * h);
        }))
      return;
    std::swap(p, q);
  }
  if (!over_cells(2, [&](std::size_t i) { land(p[i]); })) return;

  if (disturbance_.irregularity > 0) {
    const Random random(disturbance_.seed, 0x717e12);
    if (!over_cells(1, [&](std::size_t i) {
          Real nearest = 1e300;
          for (const Index k : cells[i].neighbour)
            if (k != kNone) nearest = std::min(nearest, (p[k] - p[i]).norm());
          Vec3 normal;
          field_->value(p[i], normal);
          normal.normalize();
          const std::uint64_t id = patch.id(cells[i]);
          const Vec3 d = random_direction(random, id);
          q[i] = p[i] + 0.5 * disturbance_.irregularity * nearest * (d - normal * normal.dot(d));
          land(q[i]);
        }))
      return;
    std::swap(p, q);
  }

  const Point3i o = lattice_.brick_corner(piece);
  std::vector<Index> id(n, kNone);
  over_cells(1, [&](std::size_t i) { id[i] = static_cast<Index>(patch.id(cells[i])); });
  out.corner.reserve(6 * (lattice_.first_quad(piece + 1) - lattice_.first_quad(piece)));
  const auto add_quad = [&](std::array<Index, 4> c, bool turned) {
    if (turned) std::swap(c[1], c[3]);
    const int r = better_diagonal({p[c[0]], p[c[1]], p[c[2]], p[c[3]]}, id[c[0]] & 1);
    for (const int k : {0, 1, 2, 0, 2, 3}) out.corner.push_back(id[c[(k + r) % 4]]);
  };
  for (int z = 0; z < kBrick; ++z)
    for (int y = 0; y < kBrick; ++y) {
      const std::uint64_t here = lattice_.inside_row(o[0], o[1] + y, o[2] + z);
      const std::uint64_t next = here >> 1 | lattice_.inside_row(o[0] + kBrick, o[1] + y, o[2] + z) << 63;
      const std::uint64_t ex = here ^ next, ey = here ^ lattice_.inside_row(o[0], o[1] + y + 1, o[2] + z),
                          ez = here ^ lattice_.inside_row(o[0], o[1] + y, o[2] + z + 1);
      for (std::uint64_t any = ex | ey | ez; any; any &= any - 1) {
        const int x = std::countr_zero(any);
        const bool in = here >> x & 1;  // the quad faces the outside end of its edge
        const auto at = [&](int dx, int dy, int dz) { return patch.find(x - dx, y - dy, z - dz); };
        if (ex >> x & 1) add_quad({at(0, 1, 1), at(0, 0, 1), at(0, 0, 0), at(0, 1, 0)}, !in);
        if (ey >> x & 1) add_quad({at(1, 0, 1), at(1, 0, 0), at(0, 0, 0), at(0, 0, 1)}, !in);
        if (ez >> x & 1) add_quad({at(1, 1, 0), at(0, 1, 0), at(0, 0, 0), at(1, 0, 0)}, !in);
      }
    }

  if (disturbance_.noise > 0) {
    const Random random(disturbance_.seed, 0x2015e);
    if (!over_cells(0, [&](std::size_t i) {
          Vec3 normal;
          field_->value(p[i], normal);
          p[i] += disturbance_.noise * random.normal(id[i]) * normal.normalized();
        }))
      return;
  }
  out.point.reserve(lattice_.first_vertex(piece + 1) - lattice_.first_vertex(piece));
  over_cells(0, [&](std::size_t i) { out.point.push_back(p[i]); });
}

}  // namespace intarsia::tools
