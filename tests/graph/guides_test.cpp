// What the user gives is kept: curves become borders where they are, pinned regions stay patches.
#include "graph/guides.h"

#include <algorithm>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/layout_run.h"
#include "tests/support/rounded_cube.h"

using namespace intarsia;
using namespace intarsia::test;

namespace {

// A cube from -10 to 10 with a circle of radius 5 on top, and two regions pinned: one across an edge, one on a side.
const RoundedCube kCube{8, 2};

graph::GivenGuides guides_of(const Soup& soup) {
  graph::GivenGuides g;
  g.curve.resize(1);
  for (int i = 0; i <= 40; ++i) {
    const Real a = 2 * std::numbers::pi * (i % 40) / 40;
    g.curve[0].push_back({5 * std::cos(a), 5 * std::sin(a), 10});
  }
  g.pin.assign(soup.face_count(), -1);
  for (Index f = 0; f < soup.face_count(); ++f) {
    Vec3 c = Vec3::Zero();
    for (Index i = 0; i < 3; ++i) c += point(soup, soup.corner[3 * f + i]) / 3;
    if ((c - Vec3(10, 2, 1)).norm() < 4) g.pin[f] = 7;
    if ((c - Vec3(-9.4, -9.4, 0)).norm() < 4.5) g.pin[f] = 3;
  }
  return g;
}

graph::Layout layout_with(const Soup& soup, const graph::LayoutOptions& options, int threads) {
  RunSettings settings;
  settings.threads = threads;
  RunContext context(settings);
  Flow flow(context);
  const auto source = [&soup](const Work&) { return soup; };
  const graph::LayoutPorts ports =
      graph::add_layout_stages(flow, add_stage(flow, Stage<Soup>{"read", 1, 0, source}), options, {guides_of, 1});
  keep(ports.features.surface);
  flow.run();
  graph::Layout layout = *fetch(ports.layout);
  // labels in the input's numbers
  std::vector<Index> label(layout.face_patch.size());
  const auto surface = fetch(ports.features.surface);
  for (Index f = 0; f < label.size(); ++f) label[surface->order.face[f]] = layout.face_patch[f];
  layout.face_patch = label;
  return layout;
}

}  // namespace

TEST_CASE("given curves and pinned regions are kept exactly, whatever the number of patches") {
  const Soup soup = kCube.mesh(0.15, 3);
  const graph::GivenGuides given = guides_of(soup);
  const Real diagonal = 20 * std::sqrt(3.0);
  const std::pair<graph::SubdivideForm, Index> kAsked[] = {
      {graph::SubdivideForm::compact, 0}, {graph::SubdivideForm::compact, 18}, {graph::SubdivideForm::quality, 11}};
  for (const auto& asked : kAsked) {
    const Index patches = asked.second;
    CAPTURE(patches);
    graph::LayoutOptions options = graph::robust_options();
    options.patches = patches, options.form = asked.first;
    const graph::Layout layout = layout_with(soup, options, 2);
    CHECK(layout.checks.is_valid());
    for (const int pin : {3, 7}) {
      std::set<Index> inside;
      for (Index f = 0; f < soup.face_count(); ++f)
        if (given.pin[f] == pin) inside.insert(layout.face_patch[f]);
      REQUIRE(inside.size() == 1);
      for (Index f = 0; f < soup.face_count(); ++f)
        if (layout.face_patch[f] == *inside.begin()) REQUIRE(given.pin[f] == pin);
    }
    // the circle, whole and in its place
    const MeshView mesh = layout.refined.mesh;
    Real on_circle = 0;
    for (Index a = 0; a < layout.graph.arc_count(); ++a) {
      if (layout.graph.kind[a] != CurveKind::given) continue;
      const auto row = layout.graph.arc.row(a);
      for (std::size_t i = 1; i < row.size(); ++i) {
        const Vec3 p = diagonal * mesh.point(row[i - 1]), q = diagonal * mesh.point(row[i]);
        const Real r = p.head<2>().norm();
        if (p.z() > 9.99 && q.z() > 9.99 && r > 4.95 && r < 5.0001) on_circle += (p - q).norm();
      }
    }
    CHECK(on_circle == doctest::Approx(40 * 10 * std::sin(std::numbers::pi / 40)).epsilon(1e-4));
  }
}

TEST_CASE("the same bits on any number of threads, with guides") {
  const Soup soup = kCube.mesh(0.15, 3);
  graph::LayoutOptions options = graph::robust_options();
  options.patches = 14;
  const std::uint64_t one = hash_of(layout_with(soup, options, 1));
  CHECK(hash_of(layout_with(soup, options, 5)) == one);
}

TEST_CASE("pins that are not one for each triangle are refused") {
  const Soup soup = kCube.mesh(0, 1);
  const graph::Surface surface = graph::mesh_to_surface(Work(), soup);
  graph::GivenGuides given;
  given.pin.assign(5, 0);
  CHECK_THROWS_AS(graph::surface_to_guides(Work(), surface, given), Error);
}

TEST_CASE("curves over a hole and far from the surface are kept, with a warning each") {
  // A plate with a square hole in the middle; a straight curve across it, and one 2 % above the plate.
  Soup plate = test::plane(20, 20);
  std::vector<Index> corner;
  for (Index f = 0; f < plate.face_count(); ++f) {
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < 3; ++i) middle += test::point(plate, plate.corner[3 * f + i]) / 3;
    if ((middle - Vec3(0.5, 0.5, 0)).cwiseAbs().maxCoeff() > 0.2)
      corner.insert(corner.end(), plate.corner.begin() + 3 * f, plate.corner.begin() + 3 * f + 3);
  }
  plate.corner = corner;
  const graph::Surface surface = graph::mesh_to_surface(Work(), plate);
  const auto codes = [&](const std::vector<Vec3>& curve) {
    graph::GivenGuides given;
    given.curve = {curve};
    std::vector<std::string> out;
    for (const Warning& w : warnings_of(graph::surface_to_guides(Work(), surface, given))) out.push_back(w.code);
    return out;
  };
  CHECK(codes({{0.1, 0.1, 0}, {0.9, 0.1, 0}}).empty());
  CHECK(codes({{0.1, 0.5, 0}, {0.9, 0.5, 0}}) == std::vector<std::string>{"curve-gap"});
  const Real high = 0.02 * surface.box.diagonal;
  CHECK(codes({{0.1, 0.1, high}, {0.9, 0.1, high}}) == std::vector<std::string>{"curve-far"});
}

TEST_CASE("with a tolerance the number of patches follows from it") {
  const Soup soup = kCube.mesh(0.15, 3);
  Index before = 0;
  for (const Real percent : {4.0, 1.5}) {
    CAPTURE(percent);
    graph::LayoutOptions options = graph::robust_options();
    options.tolerance = {percent / 100, Length::Unit::diagonal};
    options.refine.rounds = 0;
    RunContext context(RunSettings{});
    Flow flow(context);
    const auto source = [&soup](const Work&) { return soup; };
    const graph::LayoutPorts ports =
        graph::add_layout_stages(flow, add_stage(flow, Stage<Soup>{"read", 1, 0, source}), options);
    keep(ports.goal);
    flow.run();
    const auto goal = fetch(ports.goal);
    CHECK(goal->rms <= percent / 100);
    CHECK(goal->warnings.empty());
    CHECK(fetch(ports.layout)->labels.count == goal->patches);
    CHECK(goal->patches > before);
    before = goal->patches;
  }
}
