#include "kernels/surface/check_soup.h"

#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

struct Refusal {
  bool refused = false;
  ErrorCode code = ErrorCode::internal;
  Index element = kNone;
  std::string message;
  bool says(const std::string& part) const { return message.find(part) != std::string::npos; }
};

Refusal refusal(const Soup& soup) {
  try {
    kernels::check_soup({}, soup);
  } catch (const Error& e) {
    return {true, e.code(), e.element(), e.what()};
  }
  return {};
}

}  // namespace

TEST_CASE("surfaces pass") {
  for (const Soup& soup : {icosphere(3), cube(5), torus(3, 1, 30, 20), cylinder(1, 2, 3, 20, 10), plane(9, 7),
                           plane(8, 8, Diagonals::alternating), reversed(cube(2)), joined(cube(2), icosphere(1))}) {
    CHECK_FALSE(refusal(soup).refused);
    CHECK_FALSE(refusal(shuffle(soup, 3)).refused);
  }
}

TEST_CASE("isolated vertices and flat faces pass") {
  Soup soup = plane(4, 4);
  add_vertex(soup, {9, 9, 9});
  add_vertex(soup, {std::numeric_limits<Real>::quiet_NaN(), 0, 0});  // no face uses it
  soup.x[6] = soup.x[7], soup.y[6] = soup.y[7];                      // two corners of some faces at one place
  CHECK_FALSE(refusal(soup).refused);
}

TEST_CASE("a vertex of very high valence is judged quickly") {
  Soup fan;
  add_vertex(fan, {0, 0, 1});
  const Index n = 100000;
  for (Index i = 0; i < n; ++i) add_vertex(fan, {std::cos(6.28 * i / n), std::sin(6.28 * i / n), 0});
  for (Index i = 1; i < n; ++i) add_face(fan, 0, i, i + 1);
  CHECK_FALSE(refusal(fan).refused);
}

TEST_CASE("a face with a repeated corner") {
  Soup soup = plane(4, 4);
  soup.corner[3 * 11 + 2] = soup.corner[3 * 11];
  soup.corner[3 * 20 + 1] = soup.corner[3 * 20];
  const Refusal r = refusal(soup);
  CHECK(r.code == ErrorCode::rejected);
  CHECK(r.element == 11);
  CHECK(r.says("face 11"));
}

TEST_CASE("faces are named as the file numbers them") {
  Soup soup = plane(4, 4);
  for (Index f = 0; f < soup.face_count(); ++f) soup.source_face.push_back(f / 2);
  soup.corner[3 * 11 + 2] = soup.corner[3 * 11];
  CHECK(refusal(soup).element == 5);
}

TEST_CASE("a corner that does not exist") {
  Soup soup = cube(2);
  soup.corner[3 * 7] = 1000;
  CHECK(refusal(soup).element == 7);
}

TEST_CASE("no faces, no area") {
  CHECK(refusal(Soup{}).code == ErrorCode::rejected);
  Soup needle;
  for (int i = 0; i < 4; ++i) add_vertex(needle, {Real(i), 2.0 * i, 0});
  add_face(needle, 0, 1, 2);
  add_face(needle, 1, 3, 2);
  CHECK(refusal(needle).says("area"));
  CHECK_FALSE(refusal(scaled(cube(1), 1e-200)).refused);
}

TEST_CASE("a coordinate that is no number") {
  Soup soup = cube(2);
  soup.z[9] = std::numeric_limits<Real>::infinity();
  const Refusal r = refusal(soup);
  CHECK(r.element == 9);
  CHECK(r.says("vertex 9"));
}

TEST_CASE("an edge with three faces") {
  Soup soup = plane(4, 4);
  const Index v = add_vertex(soup, {0.5, 0.5, 1});
  const Index a = soup.corner[3 * 8], b = soup.corner[3 * 8 + 1], c = soup.corner[3 * 8 + 2];
  add_face(soup, a, c, v);  // the diagonal that faces 8 and 9 share
  const Refusal r = refusal(soup);
  CHECK(r.code == ErrorCode::rejected);
  CHECK(r.element == 8);
  CHECK(r.says("more than two faces (8, 9, 32)"));
  CHECK(b != v);
}

TEST_CASE("a face turned over") {
  Soup soup = icosphere(2);
  std::swap(soup.corner[3 * 40 + 1], soup.corner[3 * 40 + 2]);
  const Refusal r = refusal(soup);
  CHECK(r.code == ErrorCode::rejected);
  CHECK(r.says("40"));
  CHECK(r.says("same direction"));
}

TEST_CASE("the same face twice") {
  Soup soup = plane(3, 3);
  add_face(soup, soup.corner[12], soup.corner[13], soup.corner[14]);
  CHECK(refusal(soup).refused);
}

TEST_CASE("vertices where parts touch") {
  Soup open = joined(plane(1, 1), plane(1, 1));  // two border fans on one vertex
  for (Index& c : open.corner)
    if (c == 4) c = 3;
  CHECK(refusal(open).element == 3);
  CHECK(refusal(open).says("vertex 3"));

  Soup closed = joined(icosphere(1), icosphere(1));  // two closed fans
  for (Index& c : closed.corner)
    if (c == 42 + 17) c = 17;
  CHECK(refusal(closed).element == 17);

  Soup mixed = joined(icosphere(1), plane(2, 2));  // one closed, one open
  for (Index& c : mixed.corner)
    if (c == 42) c = 30;
  CHECK(refusal(mixed).element == 30);
}

TEST_CASE("the refusal does not depend on threads") {
  Soup soup = plane(100, 100);
  for (Index f : {15000u, 700u, 9000u}) std::swap(soup.corner[3 * f + 1], soup.corner[3 * f + 2]);
  const Index one = run_with_threads(1, [&] { return refusal(soup).element; });
  for (int threads : {2, 3, 8}) CHECK(run_with_threads(threads, [&] { return refusal(soup).element; }) == one);
}
