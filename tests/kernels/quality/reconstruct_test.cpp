#include "kernels/quality/reconstruct.h"

#include <cmath>
#include <numbers>

#include "engine/space/point_triangle.h"
#include "tests/kernels/quality/quality_case.h"

namespace intarsia {

using namespace test;

namespace {

// Distances of every inner point of a patch from its triangulation, in diagonals of its border; the largest.
Real farthest_from(const kernels::Reconstruction& r, const kernels::Reconstruction& flat, Index samples) {
  Real most = 0;
  for (std::size_t t = 0; t < r.patch.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = r.corner[3 * t + i];
      if (v < samples) continue;
      const Vec3 p = r.point[v];
      Real least = 1e300;
      Vec3 low = Vec3::Constant(1e300), high = -low;
      for (std::size_t u = 0; u < flat.patch.size(); ++u) {
        if (flat.patch[u] != r.patch[t]) continue;
        const Vec3 a = flat.point[flat.corner[3 * u]], b = flat.point[flat.corner[3 * u + 1]],
                   c = flat.point[flat.corner[3 * u + 2]];
        least = std::min(least, (closest_on_triangle(p, a, b, c) - p).norm());
        low = low.cwiseMin(a).cwiseMin(b).cwiseMin(c), high = high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
      }
      most = std::max(most, least / (high - low).norm());
    }
  return most;
}

// A square of the given width with n x n cells.
Soup plane_of(Real width, Index n) {
  return height_field(n, n, 0, width, 0, width, [](Real, Real) { return 0.0; });
}

LayoutCase tube_with_lids() {
  return identity_case(
      capped_cylinder(1, 3, 48, 20),
      [](const MeshView& m, Index f) {
        const Real z = centroid(m, f).z();
        return z < 1e-9 ? 0u : z > 3 - 1e-9 ? 2u : 1u;
      },
      CurveKind::sharp);
}

}  // namespace

TEST_CASE("a cube is rebuilt exactly") {
  const LayoutCase c = identity_case(cube(12), cube_side, CurveKind::sharp);
  const kernels::SampledLayout s = sampled(c, 40);
  const AllReconstructions all = reconstruct_all(s);
  for (const auto* r : {&all.triangulated, &all.transfinite, &all.filled}) {
    check_watertight(s, trace(c), *r);
    CHECK(r->failed_count() == 0);
    CHECK(r->bridged_count() == 0);
    CHECK(area_of(*r) == doctest::Approx(6).epsilon(1e-9));
    const auto off = deviation(*r, [](const Vec3& p) { return (p - Vec3(.5, .5, .5)).cwiseAbs().maxCoeff() - .5; });
    CHECK(off.second < 1e-10);
  }
  CHECK(all.triangulated.patch.size() == 6 * 38);
  CHECK(all.filled.patch.size() > 6 * 38);
}

TEST_CASE("octants of a sphere: the fill with tangents is nearly the sphere") {
  const LayoutCase c = identity_case(octasphere(32), octant, CurveKind::subdivision);
  const kernels::SampledLayout s = sampled(c, 90);
  const AllReconstructions all = reconstruct_all(s);
  const auto off = [](const Vec3& p) { return p.norm() - 1; };
  for (const auto* r : {&all.triangulated, &all.transfinite, &all.filled}) {
    check_watertight(s, trace(c), *r);
    CHECK(r->failed_count() == 0);
  }
  kernels::TransfiniteOptions whole;
  whole.guard = 1;
  const kernels::PatchTriangulations start = kernels::triangulate_patches(Work(), s, {});
  const kernels::Reconstruction uncut = kernels::reconstruct_transfinite(Work(), s, start, whole);
  check_watertight(s, trace(c), uncut);
  CHECK(uncut.cut_count() == 0);
  CHECK(all.transfinite.cut_count() == 8);  // an eighth of a sphere bulges by more than the guard allows
  const auto flat = deviation(all.triangulated, off), coons = deviation(uncut, off), plate = deviation(all.filled, off);
  CHECK(flat.first > .05);  // an octant's border says little about its inside
  CHECK(coons.first < .05);
  CHECK(plate.first < .02);
  CHECK(plate.second < .03);
}

TEST_CASE("quarters of a cylinder and sixteenths of a torus: the fill is nearer than the triangulation") {
  const auto quarter = [](const MeshView& m, Index f) {
    const Vec3 p = centroid(m, f);
    return (p.x() > 0 ? 1u : 0u) + (p.y() > 0 ? 2u : 0u);
  };
  const LayoutCase tube = identity_case(cylinder(1, 1, 1, 64, 16), quarter, CurveKind::subdivision);
  const kernels::SampledLayout t = sampled(tube, 120);
  const AllReconstructions a = reconstruct_all(t);
  const auto off_tube = [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 1; };
  check_watertight(t, trace(tube), a.filled);
  CHECK(deviation(a.triangulated, off_tube).first < 2e-3);  // ruled: cut across, it is rebuilt well
  CHECK(deviation(a.transfinite, off_tube).first < 2e-3);
  CHECK(deviation(a.filled, off_tube).first < .02);

  const LayoutCase ring = identity_case(
      torus(2, .7, 96, 48),
      [](const MeshView& m, Index f) {
        const Vec3 p = centroid(m, f);
        const Real around = std::atan2(p.y(), p.x()) + std::numbers::pi,
                   across = std::atan2(p.z(), std::hypot(p.x(), p.y()) - 2) + std::numbers::pi;
        const auto part = [](Real angle) { return std::min(3u, static_cast<Index>(angle / (std::numbers::pi / 2))); };
        return 4 * part(around) + part(across);
      },
      CurveKind::subdivision);
  REQUIRE(ring.count == 16);
  const kernels::SampledLayout s = sampled(ring, 100);
  const AllReconstructions b = reconstruct_all(s);
  const auto off_ring = [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 2, p.z()) - .7; };
  for (const auto* r : {&b.triangulated, &b.transfinite, &b.filled}) check_watertight(s, trace(ring), *r);
  const Real flat = deviation(b.triangulated, off_ring).first, plate = deviation(b.filled, off_ring).first;
  CHECK(plate < .5 * flat);
  CHECK(plate < .04);
}

TEST_CASE("a tube between two loops stays a tube in every reconstruction") {
  const LayoutCase c = tube_with_lids();
  const kernels::SampledLayout s = sampled(c, 90);
  const AllReconstructions all = reconstruct_all(s);
  const Real side = 2 * std::numbers::pi * 3;
  Index tube = kNone;
  for (Index p = 0; p < 3; ++p)
    if (s.patch_loops.row(p).size() == 2) tube = p;
  REQUIRE(tube != kNone);
  for (const auto* r : {&all.triangulated, &all.transfinite, &all.filled}) {
    check_watertight(s, trace(c), *r);
    CHECK(r->bridged_count() == 1);
    CHECK(r->bridged[tube] == 1);
    CHECK(area_of(*r, tube) == doctest::Approx(side).epsilon(.05));
    for (Index p = 0; p < 3; ++p)
      if (p != tube) CHECK(area_of(*r, p) == doctest::Approx(std::numbers::pi).epsilon(.02));
  }
  const auto off = [](const Vec3& p) {
    const Real r = std::hypot(p.x(), p.y());
    return std::min({std::abs(r - 1), std::abs(p.z()), std::abs(p.z() - 3)});
  };
  CHECK(deviation(all.filled, off).second < .15);
}

TEST_CASE("patches of a random partition of a closed surface fit together") {
  for (const Index seeds : {2u, 9u, 40u}) {
    const LayoutCase c = identity_case(torus(2, .8, 64, 32), Nearest{seeds, seeds}, CurveKind::subdivision);
    for (const Index samples : {12u, 80u}) {
      const kernels::SampledLayout s = sampled(c, samples);
      const AllReconstructions all = reconstruct_all(s);
      for (const auto* r : {&all.triangulated, &all.transfinite, &all.filled}) check_watertight(s, trace(c), *r);
    }
  }
}

TEST_CASE("a bent strip is cut into parts that do not fold") {
  // An L of width 1 and length 4 in the plane: the transfinite patch of its six sides leaves it.
  const auto inside = [](const Vec3& p) { return p.x() < 1 || p.y() < 1; };
  const LayoutCase c = identity_case(
      plane_of(4, 32), [&](const MeshView& m, Index f) { return inside(centroid(m, f)) ? 0u : 1u; }, CurveKind::sharp);
  const kernels::SampledLayout s = sampled(c, 100);
  const kernels::PatchTriangulations start = kernels::triangulate_patches(Work(), s, {});
  const auto cut = kernels::reconstruct_transfinite(Work(), s, start, {});
  kernels::TransfiniteOptions whole;
  whole.guard = 1;
  const auto uncut = kernels::reconstruct_transfinite(Work(), s, start, whole);
  check_watertight(s, trace(c), cut);
  check_watertight(s, trace(c), uncut);
  CHECK(cut.cut_count() == 1);
  CHECK(area_of(cut, 0) < 7.2);  // 7 without folds
  CHECK(area_of(uncut, 0) > 7.5);
}

TEST_CASE("fills that go astray fall back") {
  // Normals that are wrong by far: along the arcs, turned over, and at random.
  const LayoutCase c = identity_case(octasphere(24), octant, CurveKind::subdivision);
  const kernels::SampledLayout good = sampled(c, 90);
  const Random random(3, 4);
  for (int kind = 0; kind < 3; ++kind) {
    kernels::SampledLayout s = good;
    for (int side = 0; side < 2; ++side)
      for (Index i = s.nodes; i < s.point.size(); ++i) {
        const Vec3 noise(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
        const Vec3 n = kind == 0 ? Vec3(-s.normal[side][i]) : kind == 1 ? noise.normalized() : Vec3(0, 0, 1);
        s.normal[side].set(i, n);
      }
    const kernels::PatchTriangulations start = kernels::triangulate_patches(Work(), s, {});
    const auto flat = kernels::reconstruct_triangulated(Work(), s, start);
    const auto filled = kernels::reconstruct_filled(Work(), s, start, {});
    check_watertight(s, trace(c), filled);
    CHECK(farthest_from(filled, flat, Index(s.point.size())) <= .25 + 1e-9);
    // With no room at all every fill falls back to the triangulation itself.
    kernels::FillOptions none;
    none.guard = 0;
    const auto stuck = kernels::reconstruct_filled(Work(), s, start, none);
    CHECK(stuck.failed_count() == 8);
    CHECK(stuck.corner == flat.corner);
  }
}

TEST_CASE("samples in one place and on one line give numbers") {
  const LayoutCase c = identity_case(octasphere(8), octant, CurveKind::subdivision);
  for (int kind = 0; kind < 2; ++kind) {
    kernels::SampledLayout s = sampled(c, 30);
    for (Index i = 0; i < s.point.size(); ++i) s.point.set(i, kind == 0 ? Vec3(1, 1, 1) : Vec3(s.point[i].x(), 0, 0));
    const AllReconstructions all = reconstruct_all(s);
    for (const auto* r : {&all.triangulated, &all.transfinite, &all.filled}) {
      bool finite = true;
      for (std::size_t i = 0; i < r->point.size(); ++i) finite = finite && r->point[i].allFinite();
      CHECK(finite);
    }
  }
}

TEST_CASE("a surface without curves cannot be rebuilt") {
  const LayoutCase c = identity_case(
      icosphere(2), [](const MeshView&, Index) { return 0u; }, CurveKind::sharp);
  const kernels::SampledLayout s = sampled(c, 50);
  const AllReconstructions all = reconstruct_all(s);
  CHECK(all.triangulated.failed_count() == 1);
  CHECK(all.triangulated.corner.empty());
  CHECK(all.filled.corner.empty());
}

TEST_CASE("reconstructions do not depend on threads") {
  const LayoutCase c = identity_case(torus(2, .8, 64, 32), Nearest{23}, CurveKind::subdivision);
  const kernels::SampledLayout s = sampled(c, 70);
  const AllReconstructions one = run_with_threads(1, [&] { return reconstruct_all(s); });
  const AllReconstructions four = run_with_threads(4, [&] { return reconstruct_all(s); });
  CHECK(same(one.triangulated, four.triangulated));
  CHECK(same(one.transfinite, four.transfinite));
  CHECK(same(one.filled, four.filled));
}

}  // namespace intarsia
