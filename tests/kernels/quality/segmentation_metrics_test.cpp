#include "kernels/quality/segmentation_metrics.h"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "engine/parallel/connect_mesh.h"
#include "kernels/quality/geodesic_distance.h"
#include "kernels/quality/line_match.h"
#include "tests/support/run_with_threads.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using doctest::Approx;

namespace {

Mesh connected(const Soup& s) {
  Mesh mesh;
  mesh.x = s.x, mesh.y = s.y, mesh.z = s.z, mesh.corner = s.corner;
  connect_mesh(Work(), mesh);
  return mesh;
}

Mesh unit_square(Index cells) {
  Soup s;
  const Real step = 1.0 / cells;
  for (Index j = 0; j <= cells; ++j)
    for (Index i = 0; i <= cells; ++i) test::add_vertex(s, {i * step, j * step, 0});
  for (Index j = 0; j < cells; ++j)
    for (Index i = 0; i < cells; ++i) {
      const Index a = j * (cells + 1) + i, c = a + cells + 1;
      if ((i + j) % 2)
        test::add_face(s, a, a + 1, c + 1), test::add_face(s, a, c + 1, c);
      else
        test::add_face(s, a, a + 1, c), test::add_face(s, a + 1, c + 1, c);
    }
  return connected(s);
}

// Label 0 left of x, 1 right of it.
std::vector<Index> halves(const Mesh& mesh, Real x) {
  std::vector<Index> label;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.view().face(f);
    label.push_back((mesh.x[a] + mesh.x[b] + mesh.x[c]) / 3 < x ? 0 : 1);
  }
  return label;
}

LabelMetrics compared(const std::vector<Index>& a, Index na, const std::vector<Index>& b, Index nb,
                      std::vector<Real> area = {}) {
  if (area.empty()) area.assign(a.size(), 1);
  return compare_labels(Work(), area, {a, na}, {b, nb});
}

}  // namespace

TEST_CASE("equal segmentations differ in nothing, under any names") {
  const std::vector<Index> a{0, 0, 1, 2, 2, 1, 1, 0}, b{2, 2, 0, 1, 1, 0, 0, 2};
  const LabelMetrics m = compared(a, 3, b, 3, {1, 2, 3, 0, 5, 1, 0.5, 2});
  for (const Real v : {m.missing_rate, m.false_alarm, m.hamming, m.rand_error, m.gce, m.lce}) CHECK(v == 0);
}

TEST_CASE("one of two halves split again") {
  const std::vector<Index> candidate{0, 0, 1, 1, 2, 2, 2, 2}, reference{0, 0, 0, 0, 1, 1, 1, 1};
  const LabelMetrics m = compared(candidate, 3, reference, 2);
  CHECK(m.rand_error == Approx(0.142857).epsilon(1e-5));
  CHECK(m.gce == 0);
  CHECK(m.lce == 0);
  CHECK(m.missing_rate == Approx(0.25));
  CHECK(m.false_alarm == 0);
  CHECK(m.hamming == Approx(0.125));
  const LabelMetrics back = compared(reference, 2, candidate, 3);
  CHECK(back.missing_rate == 0);
  CHECK(back.false_alarm == Approx(0.25));
}

TEST_CASE("one segment against two halves") {
  const LabelMetrics m = compared(std::vector<Index>(8, 0), 1, {0, 0, 0, 0, 1, 1, 1, 1}, 2);
  CHECK(m.rand_error == Approx(0.571429).epsilon(1e-5));
  CHECK(m.gce == 0);
  CHECK(m.missing_rate == 0);
  CHECK(m.false_alarm == Approx(0.5));
}

TEST_CASE("crossing halves: every measure by hand, weights by area") {
  // Four faces, columns against rows, areas 1 2 3 4.
  const std::vector<Index> column{0, 1, 0, 1}, row{0, 0, 1, 1};
  const LabelMetrics m = compared(column, 2, row, 2, {1, 2, 3, 4});
  CHECK(m.missing_rate == Approx((1.0 + 3.0) / 10));
  CHECK(m.false_alarm == Approx((1.0 + 2.0) / 10));
  CHECK(m.rand_error == Approx(4.0 / 6));
  const Real forward = 1 * (3 / 4.0) + 2 * (4 / 6.0) + 3 * (1 / 4.0) + 4 * (2 / 6.0);
  const Real backward = 1 * (2 / 3.0) + 2 * (1 / 3.0) + 3 * (4 / 7.0) + 4 * (3 / 7.0);
  CHECK(m.gce == Approx(std::min(forward, backward) / 10));
  CHECK(m.lce == Approx((2 / 3.0 + 2 / 3.0 + 3 / 4.0 + 4 / 3.0) / 10));
}

TEST_CASE("the Rand index agrees with counting all pairs") {
  const Random random(3, 9);
  std::vector<Index> a(70), b(70);
  for (Index f = 0; f < 70; ++f) a[f] = random.bits(f, 0) % 5, b[f] = random.bits(f, 1) % 4;
  Real wrong = 0;
  for (Index i = 0; i < 70; ++i)
    for (Index j = 0; j < i; ++j) wrong += (a[i] == a[j]) != (b[i] == b[j]) ? 1 : 0;
  CHECK(compared(a, 5, b, 4).rand_error == Approx(wrong / (35 * 69)));
}

TEST_CASE("parallel cuts of a square are their distance apart") {
  const Mesh square = unit_square(40);
  const std::vector<Index> a = halves(square, 0.3), b = halves(square, 0.7);
  const auto cut = cut_discrepancy(Work(), square, {a, 2}, {b, 2});
  REQUIRE(cut);
  CHECK(cut->forward == Approx(0.4).epsilon(1e-12));
  CHECK(cut->backward == Approx(0.4).epsilon(1e-12));
  CHECK(cut->radius == Approx((std::sqrt(2) + std::log(1 + std::sqrt(2))) / 6).epsilon(1e-4));
  CHECK(cut->unreached == 0);
  CHECK(cut_discrepancy(Work(), square, {a, 2}, {a, 2})->value() == 0);
  const std::vector<Index> whole(square.face_count(), 0);
  CHECK_FALSE(cut_discrepancy(Work(), square, {whole, 1}, {a, 2}));
}

TEST_CASE("geodesic distances: straight in the plane, along great circles on the sphere") {
  const Mesh square = unit_square(60);
  const Index corner = 0;
  const std::vector<Real> d = geodesic_distance(Work(), square, std::span(&corner, 1));
  Real worst = 0;
  for (Index v = 0; v < square.vertex_count(); ++v)
    worst = std::max(worst, std::abs(d[v] - std::hypot(square.x[v], square.y[v])));
  CHECK(worst < 0.03);  // a point source is the worst case of fast marching: O(h log h)
  const Mesh sphere = connected(test::icosphere(5));
  const std::vector<Real> e = geodesic_distance(Work(), sphere, std::span(&corner, 1));
  worst = 0;
  for (Index v = 0; v < sphere.vertex_count(); ++v)
    worst = std::max(
        worst, std::abs(e[v] - std::acos(std::clamp(sphere.view().point(v).dot(sphere.view().point(0)), -1.0, 1.0))));
  CHECK(worst < 0.06);
}

TEST_CASE("pieces without a border of the other are left out and counted") {
  const Soup one = test::icosphere(2);
  const Mesh two =
      connected(test::joined(one, test::transformed(one, [](const Vec3& p) { return Vec3(p + Vec3(5, 0, 0)); })));
  std::vector<Index> both(two.face_count()), first(two.face_count());
  for (Index f = 0; f < two.face_count(); ++f) {
    const Index a = two.corner[3 * f];
    both[f] = two.z[a] > 0 ? 0 : 1, first[f] = two.x[a] < 2 && two.z[a] > 0 ? 0 : 1;
  }
  const auto cut = cut_discrepancy(Work(), two, {both, 2}, {first, 2});
  REQUIRE(cut);
  CHECK(cut->value() == 0);
  CHECK(cut->unreached == Approx(1.0 / 3));
}

TEST_CASE("lines that run beside others") {
  Segments a, b;
  a.point.resize(3), b.point.resize(2);
  a.point.set(0, {0, 0, 0}), a.point.set(1, {1, 0, 0}), a.point.set(2, {1, 1, 0});
  a.end = {0, 1, 1, 2};
  b.point.set(0, {0, 0.05, 0}), b.point.set(1, {0.5, 0.05, 0});
  b.end = {0, 1};
  const LineMatch match = match_lines(Work(), a, b, 0.1), back = match_lines(Work(), b, a, 0.1);
  CHECK(match.length == Approx(2));
  CHECK(match.near == Approx(0.5 + std::sqrt(0.01 - 0.0025)).epsilon(0.01));
  CHECK(back.share() == Approx(1));
  CHECK(match_lines(Work(), a, Segments{}, 0.1).share() == 0);
  CHECK(match_lines(Work(), Segments{}, a, 0.1).share() == 0);
}

TEST_CASE("any number of threads gives the same measures") {
  const Mesh mesh = connected(test::icosphere(5));
  std::vector<Index> a(mesh.face_count()), b(mesh.face_count());
  std::vector<Real> area(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index v = mesh.corner[3 * f];
    a[f] = static_cast<Index>((mesh.x[v] + 1) * 3), b[f] = static_cast<Index>((mesh.y[v] + mesh.z[v] + 2) * 2);
    area[f] = 1 + mesh.z[v] * 0.3;
  }
  const auto run = [&] {
    const LabelMetrics m = compare_labels(Work(), area, {a, 7}, {b, 9});
    return std::array<Real, 5>{m.hamming, m.rand_error, m.gce, m.lce,
                               cut_discrepancy(Work(), mesh, {a, 7}, {b, 9})->value()};
  };
  CHECK(test::run_with_threads(1, run) == test::run_with_threads(4, run));
}
