#include "kernels/network/lay_curves.h"

#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/space/surface_path.h"
#include "engine/space/triangle_tree.h"

namespace intarsia::kernels {
namespace {

class Laying {
 public:
  Laying(const Work& work, const MeshView& mesh, Real mean_edge, const LayOptions& options)
      : work_(work),
        mesh_(mesh),
        options_(options),
        step_(options.step * mean_edge),
        tree_(work, {{mesh.x, mesh.y, mesh.z}, mesh.corner}) {}

  void lay(Index id, const std::vector<Vec3>& polyline) {
    row_.clear();
    SurfacePoint before;
    for (std::size_t i = 0; i < polyline.size(); ++i) {
      if (i % 64 == 0) work_.check();
      const SurfacePoint here = on_surface(polyline[i]);
      const Real away = (position(mesh_, here) - polyline[i]).norm();
      if (away > options_.farthest)
        throw Error(ErrorCode::rejected,
                    "curve " + std::to_string(id) + ", point " + std::to_string(i) + " is " +
                        std::to_string(std::lround(100 * away)) +
                        " % of the diagonal away from the surface; are both in the same units and place?",
                    id);
      out_.farthest = std::max(out_.farthest, away);
      if (i == 0)
        add(here);
      else
        join(before, polyline[i - 1], here, polyline[i], 0);
      before = here;
    }
    finish();
  }

  LaidCurves take() {
    if (out_.net.curve.offset.empty()) out_.net.curve.offset.push_back(0);
    out_.net.strength.assign(out_.net.point.size(), 0);
    return std::move(out_);
  }

 private:
  SurfacePoint on_surface(const Vec3& p) {
    const ClosestTriangle found = tree_.closest(p, hint_);
    hint_ = found.triangle;
    const Index f = found.triangle;
    const auto [i, j, k] = mesh_.face(f);
    const Vec3 a = mesh_.point(i), b = mesh_.point(j), c = mesh_.point(k);
    const Vec3 normal = (b - a).cross(c - a);
    const Real square = normal.squaredNorm();
    if (!(square > 0)) return SurfacePoint::at_vertex(nearest_corner(f, found.point));
    const Real u = (c - b).cross(found.point - b).dot(normal) / square,
               v = (a - c).cross(found.point - c).dot(normal) / square, w = 1 - u - v;
    const Real weight[3] = {u, v, w};
    for (Index s = 0; s < 3; ++s)
      if (weight[s] > 1 - options_.corner) return SurfacePoint::at_vertex(mesh_.corner[3 * f + s]);
    for (Index s = 0; s < 3; ++s) {
      if (weight[s] > options_.corner) continue;
      const Index e = mesh_.face_edge[3 * f + s], from = mesh_.corner[3 * f + (s + 1) % 3];
      const Real along = weight[(s + 2) % 3] / (weight[(s + 1) % 3] + weight[(s + 2) % 3]);
      return SurfacePoint::on_edge(e, from == mesh_.edge_v0[e] ? along : 1 - along);
    }
    return SurfacePoint::in_face(f, u, v);
  }

  Index nearest_corner(Index f, const Vec3& p) const {
    Index best = mesh_.corner[3 * f];
    for (Index s = 1; s < 3; ++s)
      if ((mesh_.point(mesh_.corner[3 * f + s]) - p).squaredNorm() < (mesh_.point(best) - p).squaredNorm())
        best = mesh_.corner[3 * f + s];
    return best;
  }

  void add(const SurfacePoint& p) {
    if (!row_.empty() && out_.net.point[row_.back()] == p) return;
    row_.push_back(static_cast<Index>(out_.net.point.size()));
    out_.net.point.push_back(p);
  }

  // On from `a`, which is in the row already. The path follows the user's straight line from pa to pb.
  void join(const SurfacePoint& a, const Vec3& pa, const SurfacePoint& b, const Vec3& pb, int depth) {
    constexpr int kDeepest = 18;
    constexpr Real kMargin = 1e-3;
    if (shared_faces(mesh_, a, b)[0] != kNone) return add(b);
    crossings_.clear();
    const bool is_short = (pb - pa).norm() <= step_;
    if (is_short && section_crossings(mesh_, a, b, kMargin, crossings_)) {
      for (const SurfacePoint& p : crossings_) add(p);
      return add(b);
    }
    if (depth == kDeepest) {
      ++out_.gaps;
      finish();
      return add(b);
    }
    const Vec3 middle = (pa + pb) / 2;
    const SurfacePoint m = on_surface(middle);
    join(a, pa, m, middle, depth + 1);
    join(m, middle, b, pb, depth + 1);
  }

  void finish() {
    if (row_.size() > 3 && out_.net.point[row_.front()] == out_.net.point[row_.back()]) row_.back() = row_.front();
    if (row_.size() > 1) out_.net.add_curve(row_, CurveKind::given);
    row_.clear();
  }

  const Work& work_;
  const MeshView& mesh_;
  const LayOptions& options_;
  Real step_;
  TriangleTree tree_;
  Index hint_ = kNone;
  std::vector<Index> row_;
  std::vector<SurfacePoint> crossings_;
  LaidCurves out_;
};

}  // namespace

LaidCurves lay_curves(const Work& work, const MeshView& mesh, Real mean_edge,
                      std::span<const std::vector<Vec3>> polylines, const LayOptions& options) {
  Laying laying(work, mesh, mean_edge, options);
  for (std::size_t i = 0; i < polylines.size(); ++i) laying.lay(static_cast<Index>(i), polylines[i]);
  return laying.take();
}

}  // namespace intarsia::kernels
