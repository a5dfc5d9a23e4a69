#include "tools/make/shape.h"

#include <atomic>
#include <cmath>
#include <cstring>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "engine/parallel/connect_mesh.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

constexpr Real kPi = 3.141592653589793;

MakeOptions options(const std::string& shape, std::uint64_t triangles) {
  MakeOptions o;
  o.shape = shape;
  o.triangles = triangles;
  return o;
}

Mesh connected(const Soup& soup) {
  Mesh mesh;
  mesh.x = soup.x, mesh.y = soup.y, mesh.z = soup.z, mesh.corner = soup.corner;
  connect_mesh(Work(), mesh);
  return mesh;
}

struct Numbers {
  long euler = 0, border_edges = 0, border_loops = 0, components = 0, pinched = 0;
  Real volume = 0, area = 0, mean_edge = 0, edge_cv = 0, smallest_angle = 180, diagonal = 0;
};

Numbers numbers(const Mesh& mesh) {
  Numbers n;
  const MeshView m = mesh.view();
  n.euler = long(m.vertex_count()) - long(m.edge_count()) + long(m.face_count());
  Real s = 0, ss = 0;
  std::vector<Index> set(m.vertex_count()), rim(m.vertex_count());
  for (Index v = 0; v < m.vertex_count(); ++v) set[v] = rim[v] = v;
  const auto root = [](std::vector<Index>& p, Index v) {
    while (p[v] != v) v = p[v] = p[p[v]];
    return v;
  };
  std::vector<std::uint8_t> on_rim(m.vertex_count());
  for (Index e = 0; e < m.edge_count(); ++e) {
    const Real l = (m.point(m.edge_v0[e]) - m.point(m.edge_v1[e])).norm();
    s += l, ss += l * l;
    set[root(set, m.edge_v0[e])] = root(set, m.edge_v1[e]);
    if (!m.is_boundary_edge(e)) continue;
    ++n.border_edges;
    on_rim[m.edge_v0[e]] = on_rim[m.edge_v1[e]] = 1;
    rim[root(rim, m.edge_v0[e])] = root(rim, m.edge_v1[e]);
  }
  n.mean_edge = s / m.edge_count();
  n.edge_cv = std::sqrt(ss / m.edge_count() - n.mean_edge * n.mean_edge) / n.mean_edge;
  Vec3 low = m.point(0), high = low;
  for (Index v = 0; v < m.vertex_count(); ++v) {
    n.components += root(set, v) == v;
    n.border_loops += on_rim[v] && root(rim, v) == v;
    low = low.cwiseMin(m.point(v)), high = high.cwiseMax(m.point(v));
    // One fan: turning from triangle to triangle around v meets all of them.
    const auto star = m.vertex_faces.row(v);
    if (star.empty()) {
      ++n.pinched;
      continue;
    }
    std::size_t seen = 1;
    for (const int side : {1, 2}) {
      Index f = star[0];
      for (std::size_t guard = 0; guard <= star.size(); ++guard) {
        const int c = m.corner_of(f, v);
        f = m.other_face(m.face_edge[3 * f + (c + side) % 3], f);
        if (f == kNone || f == star[0]) break;
        ++seen;
      }
      if (f == star[0]) break;
    }
    n.pinched += seen != star.size();
  }
  n.diagonal = (high - low).norm();
  for (Index f = 0; f < m.face_count(); ++f) {
    const auto [i, j, k] = m.face(f);
    const Vec3 p[3] = {m.point(i), m.point(j), m.point(k)};
    n.volume += p[0].dot(p[1].cross(p[2])) / 6;
    n.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (int c = 0; c < 3; ++c) {
      const Vec3 u = p[(c + 1) % 3] - p[c], v = p[(c + 2) % 3] - p[c];
      n.smallest_angle = std::min(n.smallest_angle, std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / kPi);
    }
  }
  return n;
}

bool same_bits(const Soup& a, const Soup& b) {
  const auto same = [](const std::vector<Real>& u, const std::vector<Real>& v) {
    return u.size() == v.size() && std::memcmp(u.data(), v.data(), u.size() * sizeof(Real)) == 0;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && a.corner == b.corner;
}

}  // namespace

TEST_CASE("every shape is a manifold of the stated kind, even, on the surface, of the size asked for") {
  for (const ShapeInfo& info : shapes())
    for (const std::uint64_t triangles : {10'000u, 40'000u}) {
      CAPTURE(info.name);
      CAPTURE(triangles);
      const MakeOptions o = options(info.name, triangles);
      const Mesh mesh = connected(make_shape(Work(), o));
      const Numbers n = numbers(mesh);
      CHECK(n.euler == info.euler);
      CHECK(n.border_loops == info.boundary_loops);
      CHECK(n.components == 1);
      CHECK(n.pinched == 0);
      CHECK(std::abs(Real(mesh.face_count()) / Real(triangles) - 1) < 0.03);
      CHECK(n.edge_cv <= 0.25);
      CHECK(n.smallest_angle > 12);
      const ShapeDistance distance(o);
      Real worst = 0;
      for (Index v = 0; v < mesh.vertex_count(); ++v) worst = std::max(worst, distance(mesh.view().point(v)));
      CHECK(worst < 1e-9 * n.diagonal);
      CHECK(worst < 1e-13 * n.diagonal);  // in fact to the last digits
    }
}

TEST_CASE("volume and area converge to the exact ones with order 2, so triangles face outward") {
  const Real r = 0.25, a = 2 - 2 * r;  // the rounded box: its flat sides are a x a
  struct Known {
    const char* name;
    Real volume, area;
  };
  const Known known[] = {
      {"sphere", 4 * kPi / 3, 4 * kPi},
      {"torus", 4 * kPi * kPi, 8 * kPi * kPi},
      {"ellipsoid", 8 * kPi, 48.882154},  // 3, 2, 1: elliptic integrals to 8 digits
      {"rounded-box", a * a * a + 6 * a * a * r + 3 * a * kPi * r * r + 4 * kPi / 3 * r * r * r,
       6 * a * a + 6 * a * kPi * r + 4 * kPi * r * r},
  };
  for (const Known& k : known) {
    CAPTURE(k.name);
    const Numbers coarse = numbers(connected(make_shape(Work(), options(k.name, 8'000))));
    const Numbers fine = numbers(connected(make_shape(Work(), options(k.name, 32'000))));
    CHECK(fine.volume == doctest::Approx(k.volume).epsilon(0.005));
    CHECK(fine.area == doctest::Approx(k.area).epsilon(0.005));
    const Real order_volume = std::log2((k.volume - coarse.volume) / (k.volume - fine.volume));
    const Real order_area = std::log2((k.area - coarse.area) / (k.area - fine.area));
    CHECK(order_volume > 1.7);
    CHECK(order_volume < 2.3);
    CHECK(order_area > 1.6);
    CHECK(order_area < 2.4);
  }
  const Numbers cube = numbers(connected(make_shape(Work(), options("cube", 5'000))));
  CHECK(cube.volume == doctest::Approx(8).epsilon(1e-12));
  CHECK(cube.area == doctest::Approx(24).epsilon(1e-12));
  for (const char* name : {"part", "star", "head"})
    CHECK(numbers(connected(make_shape(Work(), options(name, 10'000)))).volume > 0);
}

TEST_CASE("open sheets face the stated way") {
  const Soup plane = make_shape(Work(), options("plane", 1'000));
  const Soup pipe = make_shape(Work(), options("half-pipe", 1'000));
  const Soup tube = make_shape(Work(), options("cylinder", 1'000));
  const auto count_against = [](const Soup& s, const auto& direction) {
    int against = 0;
    for (Index f = 0; f < s.face_count(); ++f) {
      Vec3 p[3];
      for (int i = 0; i < 3; ++i) {
        const Index v = s.corner[3 * f + i];
        p[i] = Vec3(s.x[v], s.y[v], s.z[v]);
      }
      const Vec3 centre = (p[0] + p[1] + p[2]) / 3;
      against += (p[1] - p[0]).cross(p[2] - p[0]).dot(direction(centre)) < -1e-9;
    }
    return against;
  };
  CHECK(count_against(plane, [](const Vec3&) { return Vec3::UnitZ().eval(); }) == 0);
  CHECK(count_against(pipe, [](const Vec3&) { return Vec3::UnitZ().eval(); }) == 0);
  CHECK(count_against(tube, [](const Vec3& c) { return Vec3(c.x(), 0, c.z()); }) == 0);
}

TEST_CASE("irregular vertices stay on the surface and no triangle collapses") {
  for (const ShapeInfo& info : shapes()) {
    CAPTURE(info.name);
    MakeOptions o = options(info.name, 20'000);
    const Numbers even = numbers(connected(make_shape(Work(), o)));
    o.irregularity = 0.6;
    const Mesh mesh = connected(make_shape(Work(), o));
    const Numbers n = numbers(mesh);
    CHECK(n.euler == info.euler);
    CHECK(n.pinched == 0);
    CHECK(n.edge_cv > even.edge_cv + 0.03);
    CHECK(n.edge_cv < 0.35);
    CHECK(n.smallest_angle > 5);
    const ShapeDistance distance(o);
    Real worst = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) worst = std::max(worst, distance(mesh.view().point(v)));
    CHECK(worst < 1e-13 * n.diagonal);
    if (info.name == "cube") CHECK(n.volume == doctest::Approx(8).epsilon(1e-12));  // edges and corners kept
  }
}

TEST_CASE("noise has the stated deviation, mean 0, and no memory from vertex to vertex") {
  for (const bool by_edge : {true, false}) {
    MakeOptions o = options("sphere", 60'000);
    const Numbers clean = numbers(connected(make_shape(Work(), o)));
    (by_edge ? o.noise_edges : o.noise_diagonal) = by_edge ? 0.2 : 0.001;
    const Mesh mesh = connected(make_shape(Work(), o));
    const Index n = mesh.vertex_count();
    Real sum = 0, squares = 0, product = 0;
    for (Index v = 0; v < n; ++v) {
      const Real d = mesh.view().point(v).norm() - 1;
      sum += d, squares += d * d;
    }
    const Real deviation = std::sqrt(squares / n), expected = by_edge ? 0.2 * clean.mean_edge : 0.001 * std::sqrt(12.0);
    CHECK(deviation == doctest::Approx(expected).epsilon(0.03));  // 0.4 % is chance, 2 % the foretold edge length
    CHECK(std::abs(sum / n) < 4 * deviation / std::sqrt(Real(n)));
    for (Index e = 0; e < mesh.edge_count(); ++e)
      product += (mesh.view().point(mesh.edge_v0[e]).norm() - 1) * (mesh.view().point(mesh.edge_v1[e]).norm() - 1);
    CHECK(std::abs(product / mesh.edge_count()) < 0.02 * deviation * deviation);
  }
}

TEST_CASE("noise on a sheet and on the cube is of the same kind") {
  MakeOptions o = options("plane", 40'000);
  o.noise_edges = 0.1;
  const Soup soup = make_shape(Work(), o);
  Real squares = 0;
  for (const Real z : soup.z) squares += z * z;
  // A grid of squares: sides d, diagonals d sqrt(2), in the ratio 2 : 1 but for the border.
  const Real side = 2 / std::sqrt(20'000.0), mean = side * (2 + std::sqrt(2.0)) / 3;
  CHECK(std::sqrt(squares / soup.vertex_count()) == doctest::Approx(0.1 * mean).epsilon(0.03));
}

TEST_CASE("the same bits with 1 and with 3 threads, another mesh with another seed") {
  for (const char* name : {"part", "half-pipe", "cube"}) {
    CAPTURE(name);
    MakeOptions o = options(name, 60'000);
    o.irregularity = 0.4, o.noise_edges = 0.1, o.seed = 11;
    Soup one, three;
    {
      const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
      one = make_shape(Work(), o);
    }
    {
      const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
      three = make_shape(Work(), o);
    }
    CHECK(same_bits(one, three));
    o.seed = 12;
    CHECK(!same_bits(one, make_shape(Work(), o)));
  }
}

TEST_CASE("wrong options are refused with the cause") {
  const auto code = [](const MakeOptions& o) {
    try {
      make_shape(Work(), o);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::internal;
  };
  CHECK(code(options("teapot", 1000)) == ErrorCode::bad_argument);
  CHECK(code(options("sphere", 10)) == ErrorCode::bad_argument);
  CHECK(code(options("sphere", 5'000'000'000)) == ErrorCode::too_large);
  MakeOptions o = options("sphere", 1000);
  o.parameters["fillet"] = 1;
  CHECK(code(o) == ErrorCode::bad_argument);
  o = options("torus", 1000);
  o.parameters["tube"] = 3;
  CHECK(code(o) == ErrorCode::bad_argument);
  o = options("sphere", 1000);
  o.irregularity = std::nan("");
  CHECK(code(o) == ErrorCode::bad_argument);
  std::atomic<bool> stop{true};
  try {
    make_shape(Work(&stop, nullptr, Order::fixed), options("sphere", 100'000));
    FAIL("ran although cancelled");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::cancelled);
  }
}
