#include "kernels/curvature/cubic_lanes.h"

#include <bit>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "kernels/curvature/curvature_lanes.h"
#include "kernels/curvature/extremality.h"
#include "kernels/curvature/principal_curvature.h"

using namespace intarsia;
using namespace intarsia::kernels;

namespace {

// Points about a bumpy sheet and eight vertices on it, with masks that differ from lane to lane.
struct Case {
  LaneFrames frames;
  LaneDiscs discs;
  std::vector<LanePoint> points;
  std::vector<LaneEntry> entries;

  explicit Case(Index count) {
    const Random random(count, 3);
    std::uint64_t draw = 0;
    const auto next = [&] { return 2 * random.uniform(draw++) - 1; };
    for (std::size_t l = 0; l < kLanes; ++l) {
      frames.set(l, Vec3(0.1 * next(), 0.1 * next(), 0), Frame(Vec3(0.2 * next(), 0.2 * next(), 1).normalized()));
      discs.radius[l] = 0.8, discs.cell[l] = 0.2 + 0.05 * next();
    }
    for (Index i = 0; i < count; ++i) {
      const Real x = next(), y = next();
      const Vec3 n = Vec3(0.5 * x - y * y, 0.3 * y - 2 * x * y, 1).normalized();
      points.push_back({x, y, -0.25 * x * x - 0.15 * y * y + x * y * y, n.x(), n.y(), n.z(), 1 + 0.3 * next()});
      if (i % 11 == 4) points.back().a = points.back().b = points.back().c = 0;
      entries.push_back({i, static_cast<std::uint32_t>(255.9 * random.uniform(draw++))});
    }
  }
};

std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet s : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (s <= instruction_set()) out.push_back(s);
  return out;
}

// T is made of LaneReals only.
template <class T>
bool same_bits(const T& a, const T& b, std::size_t lane) {
  constexpr std::size_t kCount = sizeof(T) / sizeof(LaneReals);
  const auto p = std::bit_cast<std::array<LaneReals, kCount>>(a), q = std::bit_cast<std::array<LaneReals, kCount>>(b);
  for (std::size_t i = 0; i < kCount; ++i)
    if (std::bit_cast<std::uint64_t>(p[i][lane]) != std::bit_cast<std::uint64_t>(q[i][lane])) return false;
  return true;
}
bool same_lane(const LaneFits& a, const LaneFits& b, std::size_t l) {
  const CubicFit p = a.cubic(l), q = b.cubic(l);
  return p.b == q.b && p.c == q.c && p.gradient == q.gradient && p.offset == q.offset && a.radius[l] == b.radius[l];
}

// terms 10: discs.
void fit(InstructionSet set, const Case& c, std::span<const LaneEntry> entries, std::size_t terms, LaneFits& out) {
  out = {};
  if (terms == 10)
    fit_disc_lanes(set, c.frames, c.discs, c.points, entries, {}, out);
  else
    fit_ring_lanes(set, c.frames, c.points, entries, terms, {}, out);
}

}  // namespace

TEST_CASE("lanes are the least squares of their own points") {
  for (Index count : {9u, 40u, 150u}) {
    const Case c(count);
    for (std::size_t terms : {7u, 9u, 10u}) {
      LaneFits fits;
      fit(instruction_set(), c, c.entries, terms, fits);
      Index solved = 0;
      for (std::size_t l = 0; l < kLanes; ++l) {
        const Vec3 at(c.frames.px[l], c.frames.py[l], c.frames.pz[l]);
        const Vec3 n(c.frames.nx[l], c.frames.ny[l], c.frames.nz[l]);
        const Frame frame(n);
        PointBatch batch;
        batch.reserve(count);
        for (const LaneEntry& e : c.entries) {
          const LanePoint& p = c.points[e.point];
          const Vec3 d = Vec3(p.x, p.y, p.z) - at;
          Real weight = 1;
          if (terms == 10) {
            if (d.norm() >= c.discs.radius[l] + c.discs.cell[l] / 2) continue;
            weight = p.area * ramp(d.norm(), c.discs.radius[l], c.discs.cell[l]);
          }
          if (e.lanes >> l & 1) batch.push(d, Vec3(p.a, p.b, p.c), weight);
        }
        CubicSums sums;
        const FitOptions options;
        add_points(batch, frame.u, frame.v, frame.n, terms == 10 ? options.disc_gate : options.normal_gate, Rows::round,
                   sums);
        CubicFit expected;
        const bool good =
            sums.count >= (terms == 10 ? 5 : 3) && solve_cubic(sums, terms, options.least_pivot, expected);
        REQUIRE(good == (fits.solved >> l & 1));
        CHECK(fits.count[l] == sums.count);
        if (!good) continue;
        ++solved;
        const CubicFit lane = fits.cubic(l);
        for (std::size_t i = 0; i < 3; ++i) CHECK(lane.b[i] == doctest::Approx(expected.b[i]).epsilon(1e-9));
        for (std::size_t i = 0; i < 4; ++i) CHECK(lane.c[i] == doctest::Approx(expected.c[i]).epsilon(1e-9));
        for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(lane.gradient[i] - expected.gradient[i]) < 1e-9);
        CHECK(std::abs(lane.offset - expected.offset) < 1e-9);
        CHECK(fits.radius[l] == doctest::Approx(sums.unit()).epsilon(1e-13));
      }
      if (count > 9) CHECK(solved == kLanes);
    }
  }
}

TEST_CASE("every instruction set gives the same bits") {
  for (Index count : {9u, 33u, 150u}) {
    const Case c(count);
    for (std::size_t terms : {7u, 9u, 10u}) {
      LaneFits reference;
      fit(InstructionSet::baseline, c, c.entries, terms, reference);
      LaneCurvatures curvatures{};
      LaneNormals normals{};
      lane_curvatures(InstructionSet::baseline, c.frames, reference, curvatures);
      lane_normals(InstructionSet::baseline, c.frames, reference, normals);
      for (const InstructionSet set : sets()) {
        LaneFits fits;
        fit(set, c, c.entries, terms, fits);
        CHECK(fits.solved == reference.solved);
        LaneCurvatures k{};
        LaneNormals n{};
        lane_curvatures(set, c.frames, reference, k);
        lane_normals(set, c.frames, reference, n);
        for (std::size_t l = 0; l < kLanes; ++l) {
          if ((fits.solved >> l & 1) == 0) continue;
          CHECK(same_lane(fits, reference, l));
          CHECK(same_bits(k, curvatures, l));
          CHECK(same_bits(n, normals, l));
        }
      }
    }
  }
}

TEST_CASE("a lane does not depend on the lanes beside it") {
  const Case c(120);
  for (std::size_t terms : {7u, 9u, 10u}) {
    LaneFits all, one;
    fit(instruction_set(), c, c.entries, terms, all);
    for (std::size_t l = 0; l < kLanes; ++l) {
      std::vector<LaneEntry> own;
      for (const LaneEntry& e : c.entries)
        if (e.lanes >> l & 1) own.push_back({e.point, 1u << l});
      fit(instruction_set(), c, own, terms, one);
      CHECK(one.solved == (1u << l));
      CHECK(same_lane(all, one, l));
    }
  }
  LaneFits none;
  fit(instruction_set(), c, {}, 7, none);
  CHECK(none.solved == 0);
}

TEST_CASE("curvatures of lanes are those of single fits, also at umbilics and along the axes") {
  LaneFrames frames;
  LaneFits fits;
  const std::array<std::array<Real, 3>, kLanes> b{
      {{-1, 0.3, 0.5}, {2, -0.7, 2}, {1, 0, -1}, {-1, 0, 1}, {-0.5, 0, -0.5}, {0, 0, 0}, {3, 1e-9, 1}, {1, -1e-9, 3}}};
  for (std::size_t l = 0; l < kLanes; ++l) {
    frames.set(l, Vec3::Zero(), Frame(Vec3(0.3 + 0.1 * l, -0.4, 0.2 * l - 0.7).normalized()));
    for (std::size_t i = 0; i < 3; ++i) fits.b[i][l] = b[l][i];
    for (std::size_t i = 0; i < 4; ++i) fits.c[i][l] = std::sin(1 + i + 4.0 * l);
  }
  LaneCurvatures lanes;
  lane_curvatures(instruction_set(), frames, fits, lanes);
  for (std::size_t l = 0; l < kLanes; ++l) {
    CAPTURE(l);
    const Vec3 n(frames.nx[l], frames.ny[l], frames.nz[l]);
    const Frame frame(n);
    const CubicFit fit = fits.cubic(l);
    const PrincipalCurvature k = principal_curvature(fit);
    CHECK(lanes.kmax[l] == doctest::Approx(k.kmax));
    CHECK(lanes.kmin[l] == doctest::Approx(k.kmin));
    const Vec3 tmax(lanes.tmax_x[l], lanes.tmax_y[l], lanes.tmax_z[l]);
    const Vec3 tmin(lanes.tmin_x[l], lanes.tmin_y[l], lanes.tmin_z[l]);
    CHECK(tmax.norm() == doctest::Approx(1));
    CHECK((n.cross(tmax) - tmin).norm() < 1e-15);
    // By the definition, in the lane's own direction: at umbilics every direction is as good.
    const std::array<Real, 2> along{tmax.dot(frame.u), tmax.dot(frame.v)}, across{-along[1], along[0]};
    CHECK(fit.b[0] * along[0] * along[0] + 2 * fit.b[1] * along[0] * along[1] + fit.b[2] * along[1] * along[1] ==
          doctest::Approx(-k.kmax));
    CHECK(lanes.emax[l] == doctest::Approx(extremality(fit, along)));
    CHECK(lanes.emin[l] == doctest::Approx(extremality(fit, across)));
  }
}
