#include "tools/make/lattice.h"

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "tools/make/fields.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

// Waves much finer than the lattice: a nearly random set of inside points.
struct Rough {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T waves =
        sine(T(x * 40)) * cosine(T(y * 37)) + sine(T(y * 41)) * cosine(T(z * 43)) + sine(T(z * 39 + x * 11));
    return (length(x, y, z) - 1.0 + 0.2 * waves) / 40.0;
  }
};

bool inside(const Lattice& l, int i, int j, int k) { return l.inside_row(i - i % kBrick, j, k) >> (i % kBrick) & 1; }

struct Extent {
  int x = 0, y = 0, z = 0;
};
Extent extent(const Lattice& l) {
  Extent e;
  for (std::size_t b = 0; b < l.brick_count(); ++b) {
    const Point3i c = l.brick_corner(b);
    e.x = std::max(e.x, c[0] + kBrick), e.y = std::max(e.y, c[1] + kBrick), e.z = std::max(e.z, c[2] + kBrick);
  }
  return e;
}

}  // namespace

TEST_CASE("the bits of a lattice agree with the field at every point") {
  const auto field = part_field(0.1, 0.035);
  const Lattice l(Work(), *field, 0.05, 3);
  const Extent e = extent(l);
  int added = 0, lost = 0, in = 0;
  for (int k = 0; k < e.z; ++k)
    for (int j = 0; j < e.y; ++j)
      for (int i = 0; i < e.x; ++i) {
        const bool truth = field->value(l.frame().at(i, j, k)) < 0;
        in += truth;
        added += !truth && inside(l, i, j, k), lost += truth && !inside(l, i, j, k);
      }
  CHECK(in > 10000);
  CHECK(lost == 0);
  CHECK(added < in / 1000);  // to make the set well-composed
}

TEST_CASE("a rough set becomes well-composed, by adding points only") {
  const auto field = make_field(Rough{}, Vec3::Constant(-1.8), Vec3::Constant(1.8));
  const Lattice l(Work(), *field, 0.07, 1);
  const Extent e = extent(l);
  int squares = 0, cubes = 0, added = 0, lost = 0;
  std::uint64_t cells = 0, edges = 0;
  for (int k = 0; k + 1 < e.z; ++k)
    for (int j = 0; j + 1 < e.y; ++j)
      for (int i = 0; i + 1 < e.x; ++i) {
        bool c[8];
        int n = 0;
        for (int o = 0; o < 8; ++o) n += c[o] = inside(l, i + (o & 1), j + (o >> 1 & 1), k + (o >> 2));
        for (const auto& [a, b, d, f] : {std::array{0, 1, 2, 3}, std::array{0, 1, 4, 5}, std::array{0, 2, 4, 6}})
          squares += c[a] == c[f] && c[b] == c[d] && c[a] != c[b];
        for (int a = 0; a < 4; ++a) cubes += c[a] == c[7 - a] && (n == 2 ? c[a] : n == 6 ? !c[a] : false);
        cells += n > 0 && n < 8;
        edges += (c[0] != c[1]) + (c[0] != c[2]) + (c[0] != c[4]);
        const bool truth = field->value(l.frame().at(i, j, k)) < 0;
        added += c[0] && !truth, lost += truth && !c[0];
      }
  CHECK(squares == 0);
  CHECK(cubes == 0);
  CHECK(added > 0);  // there was something to mend
  CHECK(lost == 0);
  CHECK(cells == l.vertex_count());
  CHECK(edges == l.quad_count());
}

TEST_CASE("cells are numbered in the order of bricks, then z, y, x") {
  const auto field = sphere_field(1);
  const Lattice l(Work(), *field, 0.015, 5);
  CHECK(l.brick_count() > 8);
  std::uint64_t next = 0;
  for (std::size_t b = 0; b < l.brick_count(); ++b) {
    CHECK(l.first_vertex(b) == next);
    const Point3i c = l.brick_corner(b);
    for (int z = 0; z < kBrick; ++z)
      for (int y = 0; y < kBrick; ++y)
        for (int x = 0; x < kBrick; ++x)
          if (l.cell_row(c[0], c[1] + y, c[2] + z) >> x & 1)
            next += l.vertex_id(c[0] + x, c[1] + y, c[2] + z) == next ? 1 : 1'000'000;
  }
  CHECK(next == l.vertex_count());
}
