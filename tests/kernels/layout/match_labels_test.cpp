#include "kernels/layout/match_labels.h"

#include <algorithm>
#include <utility>

#include <doctest/doctest.h>

#include "kernels/layout/patch_of_faces.h"
#include "tests/kernels/layout/layout_case.h"
#include "tests/support/run_with_threads.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

LabelMatch match(const LayoutCase& c, const std::vector<Index>& fresh, Index count) {
  return match_labels(Work(), c.mesh, c.refined, c.label, c.count, c.refined, fresh, count);
}

}  // namespace

TEST_CASE("components get the patch they overlap") {
  const LayoutCase c = identity_case(icosphere(3), Nearest{8}, CurveKind::subdivision);
  std::vector<Index> fresh;
  for (Index l : c.label) fresh.push_back(c.count - 1 - l);
  const LabelMatch m = match(c, fresh, c.count);
  CHECK(m.ok);
  for (Index l = 0; l < c.count; ++l) CHECK(m.old_of_new[l] == c.count - 1 - l);
}

TEST_CASE("a lost patch and a split patch are in trouble, and their arcs are named") {
  const LayoutCase c = identity_case(
      plane(12, 4), [](const MeshView& m, Index f) { return Index(centroid(m, f).x() * 4); }, CurveKind::subdivision);
  REQUIRE(c.count == 4);
  std::vector<Index> fresh = c.label;
  for (Index& l : fresh)
    if (l == 1) l = 0;
  const LabelMatch lost = match(c, fresh, 4);  // component 1 is empty
  CHECK(!lost.ok);
  CHECK(lost.trouble == std::vector<Index>{1});
  fresh = c.label;
  for (Index f = 0; f < fresh.size(); ++f)
    if (fresh[f] == 2 && centroid(c.mesh, f).y() > 0.5) fresh[f] = 4;
  const LabelMatch split = match(c, fresh, 5);
  CHECK(!split.ok);
  CHECK(split.trouble == std::vector<Index>{2});
  const LayoutGraph g = trace(c);
  const auto flags = arcs_of_patches(g, split.trouble);
  for (Index a = 0; a < g.arc_count(); ++a) CHECK((flags[a] == 1) == (g.left[a] == 2 || g.right[a] == 2));
  // Half of a patch given to its neighbour.
  fresh = c.label;
  for (Index f = 0; f < fresh.size(); ++f)
    if (fresh[f] == 3 && centroid(c.mesh, f).x() < 0.9) fresh[f] = 2;
  CHECK(match(c, fresh, 4).trouble == std::vector<Index>{3});
}

TEST_CASE("an arc between the wrong patches is noticed, with all patches concerned") {
  const LayoutCase c = identity_case(icosphere(3), Nearest{6}, CurveKind::subdivision);
  const Relayout r = relayout(c);
  REQUIRE(r.match.ok);
  const Embedding e = embed_curves(Work(), c.mesh, r.crossed.network);
  const auto misplaced = [&](const LayoutGraph& g) {
    return patches_out_of_place(Work(), g, e.refined.mesh, r.fresh.label, e.edge, e.edge_curve);
  };
  CHECK(misplaced(r.before).empty());
  LayoutGraph g = r.before;
  std::swap(g.left[2], g.right[2]);  // sides have no order here
  CHECK(misplaced(g).empty());
  const Index left = g.left[2], right = g.right[2];
  Index third = 0;
  while (third == left || third == right) ++third;
  g.left[2] = third;
  std::vector<Index> expected{left, right, third};
  std::sort(expected.begin(), expected.end());
  CHECK(misplaced(g) == expected);
}

TEST_CASE("an input face belongs to the patch with most of its area") {
  // One square cut by two curves: face 0 mostly below, face 1 mostly above.
  const Mesh mesh = connected(plane(1, 1));
  const MeshView m = mesh;
  CurveNetwork net;
  const auto on = [&](Index a, Index b, Real t) {
    const Index e = m.edge_between(a, b);
    net.point.push_back(SurfacePoint::on_edge(e, m.edge_v0[e] == a ? t : 1 - t));
  };
  on(0, 2, 0.3), on(0, 3, 0.3), on(1, 3, 0.3);  // the line y = 0.3: (0,0) = 0, (1,0) = 1, (0,1) = 2, (1,1) = 3
  net.strength.assign(3, 0);
  net.add_curve({0, 1, 2}, CurveKind::extension);
  const Embedding e = embed_curves(Work(), mesh, net);
  std::vector<Index> label;
  for (Index f = 0; f < e.refined.mesh.face_count(); ++f)
    label.push_back(centroid(e.refined.mesh, f).y() > 0.3 ? 7 : 5);
  CHECK(patch_of_original_faces(Work(), mesh, e.refined, label) == std::vector<Index>{5, 7});
  // y = 0.5 bisects neither triangle; the diagonal cut from its middle to a corner does: a tie goes to the smaller id.
  CurveNetwork tie;
  std::swap(tie, net);
  net = {};
  on(0, 3, 0.5);
  net.point.push_back(SurfacePoint::at_vertex(1));
  net.strength.assign(2, 0);
  net.add_curve({0, 1}, CurveKind::extension);
  const Embedding half = embed_curves(Work(), mesh, net);
  label.clear();
  for (Index f = 0; f < half.refined.mesh.face_count(); ++f) {
    const Vec3 p = centroid(half.refined.mesh, f);
    label.push_back(p.x() + p.y() > 1 ? 2 : 9);
  }
  CHECK(patch_of_original_faces(Work(), mesh, half.refined, label)[0] == 2);
}

TEST_CASE("matching does not depend on the number of threads") {
  const LayoutCase c = identity_case(torus(1, 0.4, 160, 90), Nearest{40}, CurveKind::subdivision);
  const auto one = run_with_threads(1, [&] { return match(c, c.label, c.count); });
  CHECK(one.ok);
  for (int threads : {2, 3, 8})
    CHECK(run_with_threads(threads, [&] { return match(c, c.label, c.count); }).old_of_new == one.old_of_new);
}
