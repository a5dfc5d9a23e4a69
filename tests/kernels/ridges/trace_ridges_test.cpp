#include "kernels/ridges/trace_ridges.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernels/ridges/chain_segments.h"
#include "tests/support/quadric_fields.h"

using namespace intarsia;
using namespace intarsia::test;
using kernels::RidgeOptions;
using kernels::trace_ridges;

namespace {

const Vec3 kAxes(3, 2, 1);
constexpr Real kPerimeter = 15.865;  // of the ellipse with semi-axes 3 and 2

int loose_ends(const FeatureCurves& curves) {
  std::vector<int> uses(curves.point_count(), 0);
  for (Index c = 0; c < curves.curve_count(); ++c) {
    for (Index p : curves.points_of(c)) uses[p] += 2;
    --uses[curves.points_of(c).front()], --uses[curves.points_of(c).back()];
  }
  return static_cast<int>(std::count(uses.begin(), uses.end(), 1));
}

// Turned so that no vertex lies in a plane of symmetry, then stretched.
Soup turned_ellipsoid(int level) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return transformed(icosphere(level), [&](const Vec3& p) -> Vec3 { return kAxes.cwiseProduct(turn * p); });
}

FeatureCurves ridges_of(const TestSurface& s, const CurvatureFields& f, CurveKind kind = CurveKind::ridge) {
  return trace_ridges({}, s.mesh, f, kind, {}, {});
}

bool share_face(const MeshView& mesh, const SurfacePoint& p, const SurfacePoint& q) {
  const auto holds = [&](Index f, const SurfacePoint& x) {
    if (x.kind == PointKind::vertex) return mesh.corner_of(f, x.element) < 3;
    if (x.kind == PointKind::edge) return mesh.edge_f0[x.element] == f || mesh.edge_f1[x.element] == f;
    return x.element == f;
  };
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (holds(f, p) && holds(f, q)) return true;
  return false;
}

}  // namespace

TEST_CASE("the exact fields of an ellipsoid have the known curvatures at its axes") {
  const auto at_a = quadric_at(Vec3(3, 0, 0), kAxes), at_b = quadric_at(Vec3(0, 2, 0), kAxes);
  CHECK(at_a.kmax == doctest::Approx(3));
  CHECK(at_a.kmin == doctest::Approx(0.75));
  CHECK(at_b.kmax == doctest::Approx(2));
  CHECK(at_b.kmin == doctest::Approx(2.0 / 9));
  // Along the section the derivative agrees with a difference quotient of the curvature.
  const Real step = 1e-5;
  const auto on = [&](Real phi) { return quadric_at(Vec3(3 * std::cos(phi), 0, std::sin(phi)), kAxes); };
  const Vec3 chord =
      Vec3(3 * std::cos(0.5 + step) - 3 * std::cos(0.5 - step), 0, std::sin(0.5 + step) - std::sin(0.5 - step));
  const auto q = on(0.5);
  const Real slope = (on(0.5 + step).kmax - on(0.5 - step).kmax) / chord.norm();
  CHECK(q.emax * (q.tmax.dot(chord) > 0 ? 1 : -1) == doctest::Approx(slope).epsilon(1e-6));
}

TEST_CASE("an ellipsoid has one ridge, closed, of the length of its largest section, and no valley") {
  for (const bool symmetric : {false, true}) {
    CAPTURE(symmetric);
    const TestSurface s = make_surface(symmetric ? ellipsoid(4, 3, 2, 1) : turned_ellipsoid(4));
    const CurvatureFields f = quadric_fields(s, kAxes);
    const FeatureCurves ridges = ridges_of(s, f);
    REQUIRE(ridges.curve_count() == 1);
    CHECK(ridges.net.is_closed(0));
    CHECK(loose_ends(ridges) == 0);
    CHECK(total_length(s.mesh, ridges.net) * s.box.diagonal == doctest::Approx(kPerimeter).epsilon(0.005));
    for (Index p : ridges.points_of(0)) {
      CHECK(std::abs(s.box.to_input(position(s.mesh, ridges.net.point[p])).z()) < 0.01);
      CHECK(std::abs(ridges.across[p].z()) > 0.99);
      CHECK(ridges.kd[p] == ridges.kmax[p]);
    }
    CHECK(ridges_of(s, f, CurveKind::valley).curve_count() == 0);
  }
}

TEST_CASE("sharpness on the ridge of an ellipsoid is that of its cross sections") {
  // An ellipse with semi-axes a > b has -k'' / k^3 = 3 (1 - b^2 / a^2) at its vertex on the long axis.
  const TestSurface s = make_surface(turned_ellipsoid(5));
  const FeatureCurves ridges = ridges_of(s, quadric_fields(s, kAxes));
  REQUIRE(ridges.curve_count() == 1);
  int seen = 0;
  for (Index p : ridges.points_of(0)) {
    const Vec3 x = s.box.to_input(position(s.mesh, ridges.net.point[p]));
    if (std::min(std::abs(x.x()), std::abs(x.y())) > 0.05) continue;
    const Real ratio = std::abs(x.y()) < 0.05 ? 1.0 / 3 : 1.0 / 2;
    CHECK(ridges.sharpness[p] == doctest::Approx(3 * (1 - ratio * ratio)).epsilon(0.05));
    ++seen;
  }
  CHECK(seen >= 4);
}

TEST_CASE("the reversed surface has its ridges as valleys, at the same places") {
  const TestSurface s = make_surface(turned_ellipsoid(3));
  const CurvatureFields f = quadric_fields(s, kAxes);
  const FeatureCurves ridges = ridges_of(s, f), valleys = ridges_of(s, reversed(f), CurveKind::valley);
  CHECK(valleys.net.point == ridges.net.point);
  CHECK(valleys.net.curve == ridges.net.curve);
  CHECK(valleys.kd == ridges.kd);
  CHECK(valleys.sharpness == ridges.sharpness);
  CHECK(std::all_of(valleys.concave.begin(), valleys.concave.end(), [](auto c) { return c == 1; }));
  CHECK(ridges_of(s, reversed(f)).curve_count() == 0);
}

TEST_CASE("an elliptic cylinder has two straight ridges, also where vertices lie exactly on them") {
  for (const Index around : {48u, 46u, 50u}) {  // a vertex on x = +-2 always; on y = +-1 (curvature minimum) for 48
    CAPTURE(around);
    const TestSurface s = make_surface(cylinder(2, 1, 3, around, 20));
    CurvatureFields f = quadric_fields(s, Vec3(2, 1, kInfinite));
    // As rounding would leave it, e is not exactly zero on the planes of symmetry.
    for (Index v = 0; v < s.mesh.vertex_count(); ++v) f.emax[v] += v % 2 ? 1e-12 : -1e-12;
    const FeatureCurves ridges = ridges_of(s, f);
    CHECK(ridges.curve_count() >= 2);
    CHECK(total_length(s.mesh, ridges.net) * s.box.diagonal == doctest::Approx(6).epsilon(0.1));
    for (Index p : ridges.net.curve.item) {
      const Vec3 x = s.box.to_input(position(s.mesh, ridges.net.point[p]));
      CHECK(std::abs(x.x()) > 1.99);
      CHECK(ridges.sharpness[p] == doctest::Approx(3 * 0.75).epsilon(0.2));
    }
    CHECK(ridges_of(s, f, CurveKind::valley).curve_count() == 0);
  }
}

TEST_CASE("strict signs break a ridge that runs through vertices") {
  const TestSurface s = make_surface(ellipsoid(4, 3, 2, 1));
  CurvatureFields f = quadric_fields(s, kAxes);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v)
    if (std::abs(s.mesh.z[v]) < 1e-12) f.emax[v] = 0;
  RidgeOptions strict;
  strict.crossing.symbolic_zeros = false;
  const FeatureCurves broken = trace_ridges({}, s.mesh, f, CurveKind::ridge, {}, strict);
  const FeatureCurves whole = ridges_of(s, f);
  CHECK(whole.curve_count() == 1);
  CHECK(loose_ends(whole) == 0);
  CHECK((broken.curve_count() > 1 || loose_ends(broken) > 0 ||
         total_length(s.mesh, broken.net) < 0.9 * total_length(s.mesh, whole.net)));
}

TEST_CASE("an even number of sign changes in every triangle whose directions agree") {
  const TestSurface s = make_surface(turned_ellipsoid(4));
  const CurvatureFields f = quadric_fields(s, kAxes);
  int irregular = 0;
  for (Index face = 0; face < s.mesh.face_count(); ++face) {
    const auto v = s.view().face(face);
    Real product = 1;
    int changes = 0;
    for (int i = 0; i < 3; ++i) {
      const Index a = v[static_cast<std::size_t>(i)], b = v[static_cast<std::size_t>((i + 1) % 3)];
      const Real dot = f.tmax[a].dot(f.tmax[b]);
      product *= dot;
      changes += f.emax[a] * f.emax[b] * (dot < 0 ? -1 : 1) < 0;
    }
    CHECK(changes % 2 == (product > 0 ? 0 : 1));
    irregular += product <= 0;
  }
  CHECK(irregular == 4);  // the four umbilics
}

TEST_CASE("a sphere, a plane and a round cylinder have no ridges where directions mean nothing or e vanishes") {
  const TestSurface sphere = make_surface(icosphere(4));
  CHECK(ridges_of(sphere, quadric_fields(sphere, Vec3(1, 1, 1))).curve_count() == 0);
  const TestSurface tube = make_surface(cylinder(1, 1, 3, 40, 20));
  CHECK(ridges_of(tube, quadric_fields(tube, Vec3(1, 1, kInfinite))).curve_count() == 0);
}

TEST_CASE("random extremalities: points have at most two segments, chains use every segment once and stay in faces") {
  const TestSurface s = make_surface(turned_ellipsoid(3));
  CurvatureFields f = quadric_fields(s, kAxes);
  const Random random(3, 1);
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
    const Real a = 3 * random.uniform(v, 7);
    f.emax[v] = random.normal(v) * 10;
    f.tmax.set(v, std::cos(a) * f.tmax[v] + std::sin(a) * f.tmin[v]);
  }
  const kernels::CrestFields crest(f, CurveKind::ridge);
  const auto crossings = kernels::edge_crossings({}, s.mesh, crest, {}, {});
  const auto graph = kernels::face_segments({}, s.mesh, crossings.edge);
  REQUIRE(graph.segment_count() > 100);
  CHECK(!graph.centre_face.empty());
  std::vector<int> degree(graph.node_count(), 0);
  for (Index i = 0; i < graph.segment_count(); ++i) ++degree[graph.a[i]], ++degree[graph.b[i]];
  for (Index n = 0; n < graph.node_count(); ++n) {
    if (n < graph.crossing_count) CHECK(degree[n] <= 2);
    if (n >= graph.crossing_count) CHECK(degree[n] == 3);
  }
  const Csr chains = kernels::chain_segments({}, graph.node_count(), graph.a, graph.b, {});
  std::vector<std::pair<Index, Index>> expected, found;
  for (Index i = 0; i < graph.segment_count(); ++i) expected.push_back(std::minmax(graph.a[i], graph.b[i]));
  for (Index c = 0; c < chains.rows(); ++c) {
    const auto row = chains.row(c);
    for (std::size_t i = 1; i < row.size(); ++i) found.push_back(std::minmax(row[i - 1], row[i]));
    for (std::size_t i = 1; i + 1 < row.size(); ++i) CHECK(degree[row[i]] == 2);
  }
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  CHECK(expected == found);

  const FeatureCurves curves = ridges_of(s, f);
  for (Index c = 0; c < curves.curve_count(); ++c) {
    const auto row = curves.points_of(c);
    for (std::size_t i = 1; i < row.size(); ++i)
      CHECK(share_face(s.mesh, curves.net.point[row[i - 1]], curves.net.point[row[i]]));
  }
}

TEST_CASE("chains of loops, stars and marked stops") {
  using kernels::chain_segments;
  const auto rows = [](const Csr& c) {
    std::vector<std::vector<Index>> r;
    for (Index i = 0; i < c.rows(); ++i) r.emplace_back(c.row(i).begin(), c.row(i).end());
    return r;
  };
  using Rows = std::vector<std::vector<Index>>;
  const std::vector<Index> a{3, 1, 2, 4, 5, 6}, b{1, 2, 3, 5, 6, 7};  // loop 1-2-3, path 4-5-6-7
  CHECK(rows(chain_segments({}, 8, a, b, {})) == Rows{{4, 5, 6, 7}, {1, 2, 3, 1}});
  const std::vector<std::uint8_t> stop{0, 0, 1, 0, 0, 0, 1, 0};
  CHECK(rows(chain_segments({}, 8, a, b, stop)) == Rows{{2, 1, 3, 2}, {4, 5, 6}, {6, 7}});
  CHECK(rows(chain_segments({}, 4, std::vector<Index>{0, 1, 2}, std::vector<Index>{3, 3, 3}, {})) ==
        Rows{{0, 3}, {1, 3}, {2, 3}});
}

TEST_CASE("scaling, thread counts and suppression") {
  const TestSurface s = make_surface(turned_ellipsoid(4));
  const CurvatureFields f = quadric_fields(s, kAxes);
  const auto one = run_with_threads(1, [&] { return ridges_of(s, f); });
  const auto three = run_with_threads(3, [&] { return ridges_of(s, f); });
  CHECK(one.net.point == three.net.point);
  CHECK(one.net.curve == three.net.curve);
  CHECK(one.sharpness == three.sharpness);

  const TestSurface large = make_surface(scaled(turned_ellipsoid(4), 1024));
  const FeatureCurves scaled_up = ridges_of(large, quadric_fields(large, 1024 * kAxes));
  CHECK(scaled_up.net.curve == one.net.curve);

  std::vector<std::uint8_t> half(s.mesh.vertex_count());
  for (Index v = 0; v < s.mesh.vertex_count(); ++v) half[v] = s.mesh.x[v] > 0;
  const FeatureCurves left = trace_ridges({}, s.mesh, f, CurveKind::ridge, half, {});
  CHECK(total_length(s.mesh, left.net) == doctest::Approx(0.5 * total_length(s.mesh, one.net)).epsilon(0.05));
}
