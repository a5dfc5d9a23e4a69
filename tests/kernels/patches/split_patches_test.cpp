#include "kernels/patches/split_patches.h"

#include <numbers>

#include "kernels/patches/flood_patches.h"
#include "kernels/patches/measure_patches.h"
#include "kernels/patches/normal_spread.h"
#include "tests/kernels/patches/patch_checks.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {
constexpr Real kPi = std::numbers::pi;

// Energy of the best approximation of a whole surface by k proxies.
Real energy_of(const Soup& soup, Index k, bool area_in_key = false) {
  const auto t = test::identity_refinement(soup, test::nowhere);
  const auto s = test::surface_of(t);
  std::vector<Index> faces(s.mesh.face_count());
  for (Index f = 0; f < faces.size(); ++f) faces[f] = f;
  Regions regions(flood_patches(Work(), s.mesh, t.refined.on_network));
  const auto graph = make_region_graph(Work(), s, {0, 0, faces}, 1, s.normal, regions);
  ProxyOptions options;
  options.grow.area_in_key = area_in_key;
  return fit_proxies(Work(), graph, farthest_normals(graph, k), {}, options).total();
}

struct Split {
  PatchLabels labels;
  PatchTable table;
  bool connected;
};
Split split(const Soup& soup, const SplitOptions& options, Real sharp = 10) {
  const auto t = test::sharp_refinement(soup, sharp);
  const auto s = test::surface_of(t);
  Split r;
  r.labels = split_patches(Work(), s, flood_patches(Work(), s.mesh, t.refined.on_network), options);
  r.table = measure_patches(Work(), s, r.labels);
  r.connected = test::is_connected(s.mesh, r.labels);
  return r;
}
Soup hemisphere(int level) {
  Soup s = test::icosphere(level), half = s;
  half.corner.clear();
  for (Index f = 0; f < s.face_count(); ++f) {
    const Real z = s.z[s.corner[3 * f]] + s.z[s.corner[3 * f + 1]] + s.z[s.corner[3 * f + 2]];
    if (z > 0) half.corner.insert(half.corner.end(), s.corner.begin() + 3 * f, s.corner.begin() + 3 * f + 3);
  }
  return half;
}
Soup half_cylinder() {
  return test::grid(48, 40, false, false, test::Diagonals::regular,
                    [](Real u, Real v) { return Vec3(std::cos(kPi * u), std::sin(kPi * u), 3 * v); });
}
}  // namespace

TEST_CASE("a cube is six proxies without any error") {
  CHECK(energy_of(test::cube(6), 6) == 0);
  CHECK(energy_of(test::cube(6), 6, true) == 0);
  CHECK(energy_of(test::plane(9, 9), 2) == 0);
}

TEST_CASE("energies of one proxy: closed surface 2 A, hemisphere 2 pi, a fold 2 A (1 - cos(theta / 2))") {
  const auto one = [](const Soup& soup) {
    const auto t = test::identity_refinement(soup, test::nowhere);
    const auto s = test::surface_of(t);
    return std::pair{energy_of(soup, 1), s.total_area};
  };
  const auto [closed, area] = one(test::icosphere(3));
  CHECK(closed == doctest::Approx(2 * area).epsilon(1e-12));
  CHECK(one(hemisphere(5)).first == doctest::Approx(6.198).epsilon(0.005));
  const auto [fold, fold_area] = one(test::height_field(10, 10, -1, 1, 0, 1, [](Real x, Real) { return std::abs(x); }));
  CHECK(fold == doctest::Approx(2 * fold_area * (1 - std::cos(kPi / 4))).epsilon(1e-9));
}

TEST_CASE("spheres by six and eight proxies come within 2 % of what is known") {
  const Soup sphere = test::icosphere(4);
  CHECK(energy_of(sphere, 6) < 4.2366 * 1.02);
  CHECK(energy_of(sphere, 8) < 3.3622 * 1.02);
  CHECK(energy_of(sphere, 8, true) < 3.3622 * 1.02);
  CHECK(energy_of(sphere, 8) > 3.3);
}

TEST_CASE("the pi/2 rule: strips on a cylinder, nothing on a plane") {
  const Soup side = test::cylinder(1, 1, 3, 96, 40);
  for (const auto& options : {SplitOptions{}, [] {
                                SplitOptions o;
                                o.literal = true;
                                return o;
                              }()}) {
    const auto tube = split(side, options);
    CHECK(tube.labels.count >= 4);
    CHECK(tube.labels.count <= 5);
    CHECK(tube.connected);
    const auto half = split(half_cylinder(), options);
    CHECK(half.labels.count >= 2);
    CHECK(half.labels.count <= 3);
    CHECK(split(test::plane(30, 30), options).labels.count == 1);
  }
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto tube = split(side, paper_split(seed));
    CHECK(tube.labels.count >= 4);
    CHECK(tube.connected);
  }
}

TEST_CASE("two noisy triangles divide a patch in paper mode only") {
  Soup soup = test::plane(40, 40);
  soup.z[41 * 20 + 20] = 0.2;  // one needle: faces around it stand almost upright
  CHECK(split(soup, {}).labels.count == 1);
  CHECK(split(soup, paper_split(1)).labels.count > 1);
}

TEST_CASE("borders of patches are never lost by splitting") {
  const auto r =
      split(test::transformed(test::cube(20), [](const Vec3& p) { return Vec3(p.x(), p.y(), 2 * p.z()); }), {}, 0.5);
  CHECK(r.labels.count == 6);
}

TEST_CASE("large regions go through balls of faces: connected, sensible, the same for any number of threads") {
  const auto t = test::identity_refinement(test::ellipsoid(6, 3, 2, 1), test::nowhere);
  const auto s = test::surface_of(t);
  const auto whole = flood_patches(Work(), s.mesh, t.refined.on_network);
  const auto labels = split_patches(Work(), s, whole, {});
  CHECK(labels.count >= 3);
  CHECK(labels.count <= 12);
  const Csr faces = faces_of_patches(labels);
  for (Index p = 0; p < labels.count; ++p) {
    std::vector<WeightedNormal> normals;
    for (const Index f : faces.row(p)) normals.push_back({s.normal[f], s.area[f]});
    CHECK(trimmed_spread(normals, 0.08) < kPi / 2 + 0.05);  // balls decide, not faces
  }
  CHECK(test::is_connected(s.mesh, labels));
  const auto euler = euler_of_patches(Work(), s, labels);
  for (const auto e : euler) CHECK(e == 1);
  for (const int threads : {1, 2, 3, 8})
    CHECK(test::run_with_threads(threads, [&] { return split_patches(Work(), s, whole, {}); }) == labels);
}

TEST_CASE("the largest angle between two normals") {
  std::vector<WeightedNormal> normals;
  for (int i = 0; i <= 100; ++i) {
    const Real a = 1.2 * i / 100;
    normals.push_back({Vec3(std::cos(a), std::sin(a), 0), 1});
  }
  CHECK(max_pair_angle(normals, 1.0) == doctest::Approx(1.2));
  CHECK(max_pair_angle(normals, 1.5) < 1.5);
  CHECK(trimmed_spread(normals, 0) == doctest::Approx(1.2));
  CHECK(trimmed_spread(normals, 0.08) == doctest::Approx(1.2 * 0.84).epsilon(0.03));
  std::vector<WeightedNormal> cap;  // more than can be compared pair by pair
  for (int i = 0; i < 20000; ++i) {
    const Real z = 1 - 0.4 * (i + 0.5) / 20000, a = 2.399963 * i;
    cap.push_back({Vec3(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z), 1});
  }
  CHECK(max_pair_angle(cap, kPi / 2) == doctest::Approx(2 * std::acos(0.6)).epsilon(0.02));
  CHECK(trimmed_spread(std::vector<WeightedNormal>{{Vec3(1, 0, 0), 1}, {Vec3(-1, 0, 0), 1}}, 0.08) ==
        doctest::Approx(kPi));
}
