#include "kernels/surface/canonical_order.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernels/surface/duplicate_rank.h"
#include "kernels/surface/kd_order.h"
#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

Soup wavy(Index n) {
  return height_field(n, n, -1, 1, -1, 1, [](Real x, Real y) { return 0.3 * std::sin(3 * x) * std::cos(2 * y); });
}

void check_same(const Mesh& a, const Mesh& b) {
  CHECK(a.x == b.x);
  CHECK(a.y == b.y);
  CHECK(a.z == b.z);
  CHECK(a.corner == b.corner);
  CHECK(a.edge_v0 == b.edge_v0);
  CHECK(a.edge_f1 == b.edge_f1);
  CHECK(a.face_edge == b.face_edge);
}

// Two sheets that meet in a seam without sharing its vertices: every seam position occurs twice.
Soup seam(Index n) {
  const auto left = height_field(n, n, -1, 0, 0, 1, [](Real x, Real y) { return x * y; });
  return joined(left, height_field(n, n, 0, 1, 0, 1, [](Real x, Real y) { return x * y; }));
}

bool is_permutation_of_all(std::vector<Index> p, Index n) {
  std::sort(p.begin(), p.end());
  for (Index i = 0; i < n; ++i)
    if (p[i] != i) return false;
  return p.size() == n;
}

}  // namespace

TEST_CASE("any order of the input gives the same mesh") {
  for (const Soup& soup : {icosphere(4), wavy(70), cube(9), torus(2, 0.7, 90, 40), seam(20), joined(cube(3), cube(3)),
                           joined(icosphere(2), reversed(icosphere(2)))}) {
    const TestSurface base = make_surface(soup);
    CHECK(is_permutation_of_all(base.order.face, soup.face_count()));
    CHECK(is_permutation_of_all(base.order.vertex, soup.vertex_count()));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const TestSurface other = make_surface(shuffle(soup, seed));
      check_same(base.mesh, other.mesh);
      CHECK(base.vertex_normal.x == other.vertex_normal.x);
      CHECK(base.faces.area == other.faces.area);
      CHECK(base.mean_edge == other.mean_edge);
    }
  }
}

TEST_CASE("any number of threads gives the same mesh") {
  const Soup soup = joined(seam(60), transformed(icosphere(5), [](const Vec3& p) { return Vec3(p + Vec3(5, 0, 0)); }));
  const TestSurface one = run_with_threads(1, [&] { return make_surface(soup); });
  for (int threads : {2, 3, 8}) {
    const TestSurface many = run_with_threads(threads, [&] { return make_surface(soup); });
    check_same(one.mesh, many.mesh);
    CHECK(one.order.vertex == many.order.vertex);
    CHECK(one.order.face == many.order.face);
    CHECK(one.vertex_normal.y == many.vertex_normal.y);
    CHECK(one.mean_edge == many.mean_edge);
  }
}

TEST_CASE("the maps lead back to the input") {
  const Soup soup = shuffle(seam(12), 5);
  const TestSurface s = make_surface(soup);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v)
    CHECK((s.input_point(v) - point(soup, s.order.vertex[v])).norm() < 1e-14);
  for (Index f = 0; f < s.mesh.face_count(); ++f) {
    const auto k = s.mesh.view().face(f);
    CHECK(k[0] == std::min({k[0], k[1], k[2]}));
    std::array<Index, 3> mine, theirs;
    for (std::size_t i = 0; i < 3; ++i) {
      mine[i] = s.order.vertex[k[i]];
      theirs[i] = soup.corner[3 * std::size_t{s.order.face[f]} + i];
    }
    std::rotate(theirs.begin(), std::find(theirs.begin(), theirs.end(), mine[0]), theirs.end());
    CHECK(mine == theirs);
    if (f > 0) CHECK(s.mesh.view().face(f - 1) < k);
  }
}

TEST_CASE("vertices without faces are dropped and do not change the scale") {
  Soup soup = wavy(10);
  const TestSurface clean = make_surface(soup);
  const Index last = soup.vertex_count();
  add_vertex(soup, {1000, 0, 0});
  soup.x.insert(soup.x.begin(), -7), soup.y.insert(soup.y.begin(), -7), soup.z.insert(soup.z.begin(), -7);
  for (Index& c : soup.corner) ++c;
  const TestSurface padded = make_surface(soup);
  check_same(clean.mesh, padded.mesh);
  CHECK(padded.mesh.vertex_count() == last);
  const auto number = kernels::inverse_order({}, padded.order.vertex, soup.vertex_count());
  CHECK(number.front() == kNone);
  CHECK(number.back() == kNone);
  for (Index v = 0; v < last; ++v) CHECK(number[padded.order.vertex[v]] == v);
}

TEST_CASE("aligned runs of the kd order are compact") {
  const Index n = 1000;
  Vec3Array p(n);
  for (Index i = 0; i < n; ++i) p.set(i, Vec3(i, 0.1 * (i % 2), 0));
  Vec3Array mixed(n);
  for (Index i = 0; i < n; ++i) mixed.set(i, p[(i * 377u) % n]);
  std::vector<Index> order(n);
  CHECK(kernels::kd_order({}, mixed, {}, order));
  // Along a line the order must be the line's own: median splits and sorted leaves leave no other.
  for (Index i = 0; i < n; ++i) CHECK(mixed.x[order[i]] == i);
}

TEST_CASE("every aligned run of a square grid covers few cells") {
  const TestSurface s = make_surface(plane(63, 63));  // 64 x 64 vertices
  for (Index run : {8u, 16u, 64u, 256u})
    for (Index begin = 0; begin < s.mesh.vertex_count(); begin += run) {
      Vec3 low = s.point(begin), high = low;
      for (Index v = begin; v < begin + run; ++v) low = low.cwiseMin(s.point(v)), high = high.cwiseMax(s.point(v));
      const Real cell = 1 / (63 * std::sqrt(2.0));
      const Real cells = ((high.x() - low.x()) / cell + 1) * ((high.y() - low.y()) / cell + 1);
      CHECK(std::lround(cells) == run);  // a full rectangle
      CHECK((high - low).maxCoeff() / cell < 2 * std::sqrt(Real(run)));
    }
}

TEST_CASE("points that cannot be told apart are reported") {
  Vec3Array p(20);
  for (Index i = 0; i < 20; ++i) p.set(i, Vec3(i / 2, 1, 2));
  std::vector<Index> order(20), rank(20);
  CHECK_FALSE(kernels::kd_order({}, p, {}, order));
  for (Index i = 0; i < 20; ++i) rank[i] = 1 - i % 2;
  CHECK(kernels::kd_order({}, p, rank, order));
  for (Index i = 0; i < 20; ++i) CHECK(order[i] == (i ^ 1u));
}

TEST_CASE("a doubled sheet is told apart by what lies at its border") {
  // Two coincident sheets, one of them with an extra triangle: their vertices differ only by what is far away.
  Soup sheets = joined(plane(6, 6), plane(6, 6));
  const Index extra = add_vertex(sheets, {-1, 0.5, 0.3});
  add_face(sheets, 0, 7, extra);
  const TestSurface base = make_surface(sheets);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) check_same(base.mesh, make_surface(shuffle(sheets, seed)).mesh);
}

TEST_CASE("a cancelled order does not return") {
  std::atomic<bool> cancel{true};
  const Work work(&cancel, nullptr, Order::fixed);
  const Soup soup = icosphere(3);
  Mesh mesh;
  CHECK_THROWS_AS(kernels::canonical_order(work, soup, kernels::BoxTransform{}, mesh), Error);
}
