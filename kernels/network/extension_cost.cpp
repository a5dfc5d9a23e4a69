#include "kernels/network/extension_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace intarsia::kernels {
namespace {

constexpr Real kDegree = M_PI / 180;

Vec3 tangential(const Vec3& v, const Vec3& normal) { return v - v.dot(normal) * normal; }

Vec3 unit_or_zero(const Vec3& v) {
  const Real n = v.norm();
  return n > 0 ? Vec3(v / n) : Vec3(Vec3::Zero());
}

Index nearest_original(const MeshView& original_ids, const RefinedMesh& refined, Index v, Index originals) {
  // Refined vertices keep a chain to an original one: the ring of a cut face always holds one.
  Index best = kNone;
  Real distance = std::numeric_limits<Real>::infinity();
  for (Index w : VertexRing(refined.mesh, v)) {
    if (w >= originals) continue;
    const Real d = (original_ids.point(w) - original_ids.point(v)).squaredNorm();
    if (d < distance) distance = d, best = w;
  }
  return best;
}

}  // namespace

Terrain::Terrain(const RefinedMesh& refined, Vec3View normal, const DirectionField& field, Index original_vertices,
                 Real mean_edge)
    : refined_(refined),
      mesh_(refined.mesh),
      normal_(normal),
      field_(field),
      originals_(original_vertices),
      mean_edge_(mean_edge) {
  guide_.resize(mesh_.vertex_count() - originals_, kNone);
  for (Index v = originals_; v < mesh_.vertex_count(); ++v)
    guide_[v - originals_] = nearest_original(mesh_, refined_, v, originals_);
  for (bool open = true; open;) {  // vertices deep inside a much-cut face take the guide of a neighbour
    open = false;
    for (Index v = originals_; v < mesh_.vertex_count(); ++v) {
      Index& g = guide_[v - originals_];
      if (g != kNone) continue;
      for (Index w : ring(v))
        if (guide(w) != kNone) {
          g = guide(w), open = true;
          break;
        }
    }
  }
}

Real Terrain::relative_curvature(Index v, CurveKind channel) const {
  const Index g = guide(v);
  if (channel == CurveKind::ridge) return field_.ridge[g];
  if (channel == CurveKind::valley) return field_.valley[g];
  return std::max(field_.ridge[g], field_.valley[g]);
}

Heading heading(const Terrain& terrain, const ExtensionOptions& options, std::span<const Index> path,
                const Vec3& tracer) {
  const Index tip = path.back();
  const Vec3 p = terrain.point(tip), n = terrain.normal(tip);
  Vec3 from = p;
  Real walked = 0;
  for (std::size_t i = path.size(); i-- > 0 && walked < options.walk * terrain.mean_edge();) {
    const Vec3 q = terrain.point(path[i]);
    walked += (q - from).norm();
    from = q;
  }
  Heading h;
  h.walk = unit_or_zero(tangential(p - from, n));
  Vec3 field = Vec3::Zero();
  const int m = options.history;
  const Real total = m * (m + 1) / 2.0;
  for (int j = 0; j < m && j < static_cast<int>(path.size()); ++j) {
    const Index v = path[path.size() - 1 - static_cast<std::size_t>(j)];
    Vec3 x = unit_or_zero(tangential(terrain.direction(v), n));
    if (x.dot(h.walk) < 0) x = -x;
    field += (m - j) / total * terrain.confidence(v) * x;
  }
  h.ideal = unit_or_zero(field + options.walk_weight * h.walk);
  Vec3 off = tangential(tracer - p, n);
  off -= off.dot(h.ideal) * h.ideal;
  const Real limit = 1.5 * terrain.mean_edge();
  if (off.norm() > limit) off *= limit / off.norm();
  h.aim = unit_or_zero(h.ideal + options.feedback / terrain.mean_edge() * off);
  return h;
}

Real step_cost(const Terrain& terrain, const ExtensionOptions& options, std::span<const Index> path,
               const Heading& heading, CurveKind channel, Index q) {
  const Index tip = path.back();
  const Vec3 n = terrain.normal(tip), to = terrain.point(q);
  const Vec3 r = unit_or_zero(tangential(to - terrain.point(tip), n));
  const Real along = heading.aim.dot(r), limit = std::cos(options.cone * kDegree);
  if (!(along >= limit)) return std::numeric_limits<Real>::infinity();
  const Real direction = 1 - along * along;
  const Real curvature = 1 - terrain.relative_curvature(q, channel);
  const Index third = path[path.size() - std::min<std::size_t>(path.size(), 3)];
  const Vec3 chord = unit_or_zero(tangential(to - terrain.point(third), n));
  const Real smoothness = std::clamp((1 - heading.aim.dot(chord)) / (1 - limit), 0.0, 1.0);
  return options.weight_curvature * curvature + options.weight_direction * direction +
         options.weight_smoothness * smoothness;
}

}  // namespace intarsia::kernels
