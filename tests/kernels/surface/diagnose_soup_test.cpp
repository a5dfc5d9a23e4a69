#include "kernels/surface/diagnose_soup.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

Index vertex(Soup& soup, Real x, Real y, Real z) {
  soup.x.push_back(x), soup.y.push_back(y), soup.z.push_back(z);
  return static_cast<Index>(soup.x.size() - 1);
}
void triangle(Soup& soup, Index a, Index b, Index c) { soup.corner.insert(soup.corner.end(), {a, b, c}); }

Soup tetrahedron() {
  Soup s;
  vertex(s, 0.0, 0.0, 0.0), vertex(s, 1.0, 0.0, 0.0), vertex(s, 0.0, 1.0, 0.0), vertex(s, 0.0, 0.0, 1.0);
  triangle(s, 0, 2, 1), triangle(s, 0, 1, 3), triangle(s, 1, 2, 3), triangle(s, 0, 3, 2);
  return s;
}

// n x m quads, each of two triangles; closed in a direction where it wraps.
Soup grid(Index n, Index m, bool wrap) {
  Soup s;
  const Index rows = wrap ? n : n + 1, columns = wrap ? m : m + 1;
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) {
      const Real u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      if (wrap)
        vertex(s, (3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
      else
        vertex(s, Real(i), Real(j), Real(0));
    }
  const auto id = [&](Index i, Index j) { return i % rows * columns + j % columns; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < m; ++j) {
      triangle(s, id(i, j), id(i + 1, j), id(i + 1, j + 1));
      triangle(s, id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
  return s;
}

}  // namespace

TEST_CASE("a tetrahedron") {
  const SoupDiagnosis d = diagnose_soup(Work(), tetrahedron());
  CHECK(d.vertices == 4);
  CHECK(d.triangles == 4);
  CHECK(d.edges == 6);
  CHECK(d.components == 1);
  CHECK(d.border_edges == 0);
  CHECK(d.genus == 0);
  CHECK(d.is_surface());
  CHECK(d.diagonal == doctest::Approx(std::sqrt(3.0)));
  CHECK(d.area == doctest::Approx(1.5 + std::sqrt(3.0) / 2));
  CHECK(d.edge_least == doctest::Approx(1));
  CHECK(d.edge_most == doctest::Approx(std::sqrt(2.0)));
  CHECK(d.edge_mean == doctest::Approx((3 + 3 * std::sqrt(2.0)) / 6));
}

TEST_CASE("genus and border loops: torus, square, square with two holes, two components") {
  CHECK(diagnose_soup(Work(), grid(12, 8, true)).genus == 1);
  Soup square = grid(9, 9, false);
  SoupDiagnosis d = diagnose_soup(Work(), square);
  CHECK(d.genus == 0);
  CHECK(d.border_loops == 1);
  CHECK(d.border_edges == 36);
  CHECK(d.area == doctest::Approx(81));
  for (const std::size_t quad : {20u, 60u})
    for (std::size_t i = 0; i < 6; ++i) square.corner[6 * quad + i] = kNone;
  std::erase(square.corner, kNone);
  d = diagnose_soup(Work(), square);
  CHECK(d.genus == 0);
  CHECK(d.border_loops == 3);
  CHECK(d.border_edges == 44);
  Soup two = grid(12, 8, true);
  const Index first = static_cast<Index>(two.x.size());
  const Soup other = tetrahedron();
  for (Index v = 0; v < 4; ++v) vertex(two, other.x[v] + 9, other.y[v], other.z[v]);
  for (const Index v : other.corner) two.corner.push_back(first + v);
  d = diagnose_soup(Work(), two);
  CHECK(d.components == 2);
  CHECK(d.genus == 1);
}

TEST_CASE("every fault is counted and named") {
  Soup s = tetrahedron();
  vertex(s, 5.0, 5.0, 5.0);  // vertex 4: isolated
  triangle(s, 1, 1, 2);      // triangle 4: a corner twice
  triangle(s, 1, 2, 3);      // triangle 5: the same as 2
  SoupDiagnosis d = diagnose_soup(Work(), s);
  CHECK(d.isolated_vertices.count == 1);
  CHECK(d.isolated_vertices.first == std::vector<Index>{4});
  CHECK(d.repeated_corners.count == 1);
  CHECK(d.repeated_corners.first == std::vector<Index>{4});
  CHECK(d.duplicate_triangles.count == 1);
  CHECK(d.duplicate_triangles.first == std::vector<Index>{5});
  CHECK(d.non_manifold_edges.count == 3);
  CHECK(d.genus == -1);
  CHECK(!d.is_surface());
  CHECK(d.diagonal == doctest::Approx(std::sqrt(3.0)));  // unused vertices do not count

  Soup turned = tetrahedron();
  std::swap(turned.corner[0], turned.corner[1]);
  d = diagnose_soup(Work(), turned);
  CHECK(d.turned_edges.count == 3);
  CHECK(d.turned_edges.first.front() == 0);

  Soup bow = tetrahedron();  // two tetrahedra that touch in vertex 0
  const Index b = vertex(bow, -1.0, 0.0, 0.0), c = vertex(bow, 0.0, -1.0, 0.0), e = vertex(bow, 0.0, 0.0, -1.0);
  triangle(bow, 0, b, c), triangle(bow, 0, e, b), triangle(bow, b, e, c), triangle(bow, 0, c, e);
  d = diagnose_soup(Work(), bow);
  CHECK(d.several_fans.count == 1);
  CHECK(d.several_fans.first == std::vector<Index>{0});
  CHECK(d.components == 1);

  Soup needle = tetrahedron();
  needle.x[3] = 0.5, needle.y[3] = 0, needle.z[3] = 0;  // on the edge from 0 to 1
  CHECK(diagnose_soup(Work(), needle).zero_area.count == 1);
  CHECK(diagnose_soup(Work(), needle).zero_area.first == std::vector<Index>{1});
}

TEST_CASE("faces are named as in the file") {
  Soup s = tetrahedron();
  s.source_face = {0, 0, 7, 9};
  triangle(s, 1, 2, 3);
  s.source_face.push_back(11);
  const SoupDiagnosis d = diagnose_soup(Work(), s);
  CHECK(d.duplicate_triangles.first == std::vector<Index>{11});
}
