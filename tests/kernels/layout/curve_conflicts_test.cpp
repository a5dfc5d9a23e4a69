#include "kernels/layout/curve_conflicts.h"

#include <doctest/doctest.h>

#include "tests/kernels/layout/layout_case.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

namespace {

using Curve = std::vector<SurfacePoint>;
using Pairs = std::vector<std::pair<Index, Index>>;

// Curves over the square 0 1 3 2 cut into the faces (0 1 3), (0 3 2); points of different curves are shared if equal
// and `share` is set.
struct Square {
  Mesh mesh = connected(plane(1, 1));
  MeshView view() const { return mesh; }
  SurfacePoint vertex(Index v) const { return SurfacePoint::at_vertex(v); }
  SurfacePoint edge(Index a, Index b, Real t) const {
    const Index e = view().edge_between(a, b);
    return SurfacePoint::on_edge(e, view().edge_v0[e] == a ? t : 1 - t);
  }
  SurfacePoint face(Real u, Real v) const { return SurfacePoint::in_face(0, u, v); }

  Pairs conflicts(const std::vector<Curve>& curves, bool share) const {
    CurveNetwork net;
    for (const Curve& c : curves) {
      std::vector<Index> row;
      for (const SurfacePoint& p : c) {
        const auto at = share ? std::find(net.point.begin(), net.point.end(), p) : net.point.end();
        row.push_back(static_cast<Index>(at - net.point.begin()));
        if (at == net.point.end()) net.point.push_back(p);
      }
      net.add_curve(row, CurveKind::extension);
    }
    return find_conflicts(Work(), view(), net);
  }
};

const Pairs kNo{}, kYes{{0, 1}};

}  // namespace

TEST_CASE("chords of a face cross iff their ends interleave") {
  const Square s;
  const auto a = s.edge(0, 1, 0.3), b = s.edge(1, 3, 0.5), c = s.edge(0, 1, 0.6), d = s.edge(0, 3, 0.5);
  CHECK(s.conflicts({{a, d}, {c, b}}, false) == kNo);
  CHECK(s.conflicts({{a, b}, {c, d}}, false) == kYes);
  CHECK(s.conflicts({{s.vertex(1), d}, {a, b}}, false) == kYes);
  CHECK(s.conflicts({{s.vertex(0), b}, {s.vertex(1), d}}, false) == kYes);
  CHECK(s.conflicts({{s.vertex(0), b}, {a, s.vertex(1)}}, false) == kNo);   // the second runs along the side
  CHECK(s.conflicts({{c, b}, {s.vertex(0), s.vertex(1)}}, false) == kYes);  // ends on a side that is a curve
  CHECK(s.conflicts({{s.edge(0, 1, 0.2), c}, {a, s.edge(0, 1, 0.9)}}, false) == kYes);
}

TEST_CASE("contacts need a shared point") {
  const Square s;
  const auto a = s.edge(0, 1, 0.5), b = s.edge(1, 3, 0.5), c = s.edge(0, 3, 0.5);
  CHECK(s.conflicts({{a, b}, {a, c}}, true) == kNo);
  CHECK(s.conflicts({{a, b}, {a, c}}, false) == kYes);
  CHECK(s.conflicts({{s.vertex(0), b}, {s.vertex(0), s.edge(1, 3, 0.6)}}, false) == kYes);
  CHECK(s.conflicts({{s.vertex(0), b}, {s.vertex(0), s.edge(1, 3, 0.6)}}, true) == kNo);
  CHECK(s.conflicts({{a, b}, {b, a}}, true) == kYes);                                // the same segment twice
  CHECK(s.conflicts({{s.vertex(0), a}, {s.vertex(0), s.vertex(1)}}, true) == kYes);  // overlap along a side
  CHECK(s.conflicts({{a, b}, {s.edge(0, 1, 0.5005), c}}, false) == kYes);            // too close on the edge
}

TEST_CASE("points inside a face count too") {
  const Square s;
  const auto a = s.edge(0, 1, 0.5), b = s.edge(1, 3, 0.5), c = s.edge(0, 3, 0.5), m = s.face(0.3, 0.3);
  CHECK(s.conflicts({{a, m}, {b, m}, {c, m}}, true) == kNo);
  CHECK(s.conflicts({{a, m}, {b, m}}, false) == kYes);
  CHECK(s.conflicts({{a, s.face(0.1, 0.3)}, {s.edge(0, 1, 0.8), s.edge(0, 3, 0.4)}}, false) == kYes);
  CHECK(s.conflicts({{a, s.face(0.3, 0.6)}, {s.vertex(0), c}}, false) == kNo);
}

TEST_CASE("a curve that jumps between faces is in conflict with itself") {
  const Square s;
  CHECK(s.conflicts({{s.edge(0, 1, 0.5), s.edge(0, 2, 0.5)}}, true) == Pairs{{0, 0}});
  CHECK(s.conflicts({{s.edge(0, 1, 0.5), s.edge(0, 3, 0.5), s.edge(0, 2, 0.5)}}, true) == kNo);
}
