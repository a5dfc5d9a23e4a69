#include "kernels/surface/clean_soup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "kernels/surface/diagnose_soup.h"
#include "tests/support/shapes.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

Real signed_volume(const Soup& s) {
  Real volume = 0;
  for (std::size_t t = 0; t < s.corner.size(); t += 3) {
    const auto p = [&](std::size_t c) { return Vec3(s.x[s.corner[c]], s.y[s.corner[c]], s.z[s.corner[c]]); };
    volume += p(t).dot(p(t + 1).cross(p(t + 2))) / 6;
  }
  return volume;
}

// Every triangle with vertices of its own.
Soup unwelded(const Soup& s) {
  Soup out;
  for (const Index v : s.corner) {
    out.corner.push_back(out.vertex_count());
    add_vertex(out, {s.x[v], s.y[v], s.z[v]});
  }
  return out;
}

Soup half_turned(Soup s, std::uint64_t seed) {
  for (Index t = 0; t < s.face_count(); ++t)
    if (Random(seed, 0).bits(t) % 2) std::swap(s.corner[3 * t + 1], s.corner[3 * t + 2]);
  return s;
}

Soup moebius_strip(Index around, Index across) {
  Soup s;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j <= across; ++j) {
      const Real u = 2 * std::numbers::pi * i / around, w = Real(j) / across - 0.5;
      add_vertex(
          s, {(2 + w * std::cos(u / 2)) * std::cos(u), (2 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)});
    }
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const bool last = i + 1 == around;
      const auto next = [&](Index k) { return last ? across - k : (i + 1) * (across + 1) + k; };
      const Index a = i * (across + 1) + j, b = a + 1, c = next(j + 1), d = next(j);
      add_face(s, a, d, c), add_face(s, a, c, b);
    }
  return s;
}

Index done(const Cleaning& c, CleanAction a) { return static_cast<Index>(c.of(a).count); }

// The promises that hold whatever was cleaned.
void check_maps(const Soup& input, const Cleaning& c) {
  REQUIRE(c.changed);
  CHECK(diagnose_soup({}, c.soup).is_surface());
  REQUIRE(c.input_triangle.size() == c.soup.face_count());
  CHECK(std::is_sorted(c.input_triangle.begin(), c.input_triangle.end()));
  CHECK(c.soup.vertex_count() == input.vertex_count() + c.copy_of.size());
  for (Index t = 0; t < c.soup.face_count(); ++t) {
    CHECK(c.triangle_of[c.input_triangle[t]] == t);
    std::multiset<Real> here, there;  // a triangle keeps its place
    for (int i = 0; i < 3; ++i) {
      here.insert(c.soup.x[c.soup.corner[3 * t + i]]);
      there.insert(input.x[input.corner[3 * c.input_triangle[t] + i]]);
    }
    CHECK(here == there);
  }
  for (std::size_t i = 0; i < c.copy_of.size(); ++i) CHECK(c.soup.x[input.vertex_count() + i] == input.x[c.copy_of[i]]);
}

}  // namespace

TEST_CASE("surfaces stay as they are") {
  for (const Soup& soup : {icosphere(2), cube(3), plane(6, 5), torus(3, 1, 20, 12), cylinder(1, 2, 3, 20, 10),
                           joined(icosphere(1), cube(2))})
    CHECK_FALSE(clean_soup({}, soup, {}).changed);
}

TEST_CASE("triangles with a corner twice and repeated triangles are dropped") {
  Soup soup = cube(3);
  const Index faces = soup.face_count();
  add_face(soup, 5, 5, 6);
  for (Index t = 10; t < 15; ++t) add_face(soup, soup.corner[3 * t + 1], soup.corner[3 * t + 2], soup.corner[3 * t]);
  add_face(soup, soup.corner[2], soup.corner[1], soup.corner[0]);  // the other way round
  const Cleaning c = clean_soup({}, soup, {});
  check_maps(soup, c);
  CHECK(done(c, CleanAction::repeated_corners) == 1);
  CHECK(c.of(CleanAction::repeated_corners).first == std::vector<Index>{faces});
  CHECK(done(c, CleanAction::duplicates) == 6);
  CHECK(c.soup.face_count() == faces);
  CHECK(c.triangle_of[faces] == kNone);
  CHECK(c.triangle_of[faces + 3] == 12);
  CHECK(c.triangle_of[faces + 6] == 0);
  CHECK_THROWS_AS(clean_soup({}, soup, {.strict = true}), Error);
}

TEST_CASE("turned triangles find one orientation, and a closed one faces outwards") {
  for (const Soup& truth : {cube(4), icosphere(2), torus(3, 1, 24, 12)}) {
    const Soup soup = half_turned(truth, 7);
    const Cleaning c = clean_soup({}, soup, {});
    check_maps(soup, c);
    CHECK(signed_volume(c.soup) == doctest::Approx(signed_volume(truth)));
    CHECK(c.copy_of.empty());
  }
  const Soup inward = reversed(icosphere(2));
  const Cleaning c = clean_soup({}, inward, {});
  check_maps(inward, c);
  CHECK(done(c, CleanAction::turned_outward) == inward.face_count());
  CHECK_FALSE(clean_soup({}, inward, {.turn_outward = false}).changed);
}

TEST_CASE("the wall of a cavity keeps facing inwards") {
  Soup hole = reversed(icosphere(2));
  for (auto* a : {&hole.x, &hole.y, &hole.z})
    for (Real& r : *a) r *= 0.5;
  const Soup hollow = joined(icosphere(2), hole);
  CHECK_FALSE(clean_soup({}, hollow, {}).changed);
  const Soup inside_out = reversed(hollow);
  const Cleaning c = clean_soup({}, inside_out, {});
  check_maps(inside_out, c);
  CHECK(signed_volume(c.soup) == doctest::Approx(signed_volume(hollow)));
}

TEST_CASE("seams are welded") {
  const Soup truth = icosphere(2), soup = unwelded(truth);
  const Cleaning c = clean_soup({}, soup, {});
  check_maps(soup, c);
  const SoupDiagnosis d = diagnose_soup({}, c.soup);
  CHECK(d.components == 1);
  CHECK(d.border_loops == 0);
  CHECK(d.genus == 0);
  CHECK(d.vertices - d.isolated_vertices.count == truth.vertex_count());
  CHECK(done(c, CleanAction::welded) == soup.vertex_count() - truth.vertex_count());
  Soup apart = soup;  // farther than the distance: left alone
  for (Index v = 0; v < apart.vertex_count(); ++v) apart.x[v] += 1e-3 * v;
  CHECK_FALSE(clean_soup({}, apart, {.speck_area = 0, .turn_outward = false}).changed);
  CHECK_FALSE(clean_soup({}, soup, {.weld_distance = 0, .speck_area = 0}).changed);
}

TEST_CASE("sheets that meet in a line are cut there, surfaces that touch in a point are parted") {
  Soup sheets;  // three half planes around the z axis
  const Index rows = 6;
  for (Index i = 0; i <= rows; ++i) add_vertex(sheets, {0, 0, Real(i)});
  for (int k = 0; k < 3; ++k) {
    const Index base = sheets.vertex_count();
    const Real angle = 2 * std::numbers::pi * k / 3;
    for (Index i = 0; i <= rows; ++i) add_vertex(sheets, {std::cos(angle), std::sin(angle), Real(i)});
    for (Index i = 0; i < rows; ++i)
      add_face(sheets, i, base + i, base + i + 1), add_face(sheets, i, base + i + 1, i + 1);
  }
  const Cleaning c = clean_soup({}, sheets, {});
  check_maps(sheets, c);
  CHECK(done(c, CleanAction::cut_crowded) == rows);
  CHECK(c.copy_of.size() == 2 * (rows + 1));
  CHECK(diagnose_soup({}, c.soup).components == 3);

  Soup touching = joined(cube(2), cube(2));  // the second moved so that one corner meets
  const Index n = cube(2).vertex_count();
  Vec3 high = Vec3::Constant(-1e9), low = -high;
  for (Index v = 0; v < n; ++v) {
    const Vec3 p(touching.x[v], touching.y[v], touching.z[v]);
    high = high.cwiseMax(p), low = low.cwiseMin(p);
  }
  const auto at = [&](Index v, const Vec3& p) {
    return (Vec3(touching.x[v], touching.y[v], touching.z[v]) - p).norm() < 1e-9;
  };
  Index first = kNone, second = kNone;
  for (Index v = 0; v < n; ++v)
    if (at(v, high)) first = v;
  for (Index v = n; v < 2 * n; ++v) {
    touching.x[v] += high.x() - low.x(), touching.y[v] += high.y() - low.y(), touching.z[v] += high.z() - low.z();
    if (at(v, high)) second = v;
  }
  REQUIRE(first != kNone);
  REQUIRE(second != kNone);
  for (Index& v : touching.corner) v = v == second ? first : v;
  const Cleaning parted = clean_soup({}, touching, {});
  check_maps(touching, parted);
  CHECK(parted.copy_of == std::vector<Index>{first});
}

TEST_CASE("a one-sided strip is cut once across") {
  const Index across = 4;
  const Soup strip = moebius_strip(60, across);
  const Cleaning c = clean_soup({}, strip, {});
  check_maps(strip, c);
  const SoupDiagnosis d = diagnose_soup({}, c.soup);
  CHECK(d.components == 1);
  CHECK(d.border_loops == 1);
  CHECK(d.genus == 0);  // a disc
  CHECK(done(c, CleanAction::cut_unorientable) >= across);
  CHECK(done(c, CleanAction::cut_unorientable) <= 3 * across);
}

TEST_CASE("specks are left out, many small pieces are not") {
  Soup speck = icosphere(1);
  for (auto* a : {&speck.x, &speck.y, &speck.z})
    for (Real& r : *a) r *= 0.005;
  for (Real& r : speck.x) r += 3;
  const Soup soup = joined(icosphere(3), speck);
  const Cleaning c = clean_soup({}, soup, {});
  check_maps(soup, c);
  CHECK(c.speck_pieces == 1);
  CHECK(c.soup.face_count() == icosphere(3).face_count());
  CHECK_FALSE(clean_soup({}, soup, {.speck_area = 0}).changed);
  CHECK_FALSE(clean_soup({}, speck, {}).changed);
}

TEST_CASE("nothing left is an error") {
  Soup soup;
  for (int i = 0; i < 3; ++i) add_vertex(soup, {Real(i), Real(i * i), 0});
  add_face(soup, 0, 1, 1);
  CHECK_THROWS_AS(clean_soup({}, soup, {}), Error);
}
