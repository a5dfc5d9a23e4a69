#include "kernels/ridges/edge_crossings.h"

#include <cmath>

#include "engine/parallel/compact.h"
#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

CrestFields::CrestFields(const CurvatureFields& f, CurveKind channel, std::span<const Real> smoothed)
    : sign(channel == CurveKind::valley ? -1 : 1), fields(f) {
  const bool valley = channel == CurveKind::valley;
  k_ = valley ? f.kmin : f.kmax;
  other_ = valley ? f.kmax : f.kmin;
  e_ = !smoothed.empty() ? smoothed : std::span<const Real>(valley ? f.emin : f.emax);
  t_ = valley ? f.tmin : f.tmax;
}

bool CrestFields::may_carry(Index v) const {
  return k(v) > std::abs(other_k(v)) && fields.direction_ok[v] &&
         (fields.status[v] == FitStatus::full || fields.status[v] == FitStatus::ring_grown);
}

std::vector<Real> smooth_extremality(const Work& work, const MeshView& mesh, const CurvatureFields& fields,
                                     CurveKind channel, int rounds) {
  const bool valley = channel == CurveKind::valley;
  const Vec3Array& t = valley ? fields.tmin : fields.tmax;
  std::vector<Real> e = valley ? fields.emin : fields.emax, next(e.size());
  for (int round = 0; round < rounds; ++round) {
    for_each(work, Cost::medium, e.size(), [&](std::size_t i) {
      next[i] = e[i];
      if (!fields.direction_ok[i]) return;
      const Vec3 ti = t[i];
      Real sum = e[i], weight = 1;
      for (Index w : mesh.vertex_vertices.row(static_cast<Index>(i))) {
        if (!fields.direction_ok[w]) continue;
        // |cos| as the weight: neighbours whose direction has little to say about this one count little.
        const Real cosine = ti.dot(t[w]);
        sum += cosine * e[w], weight += std::abs(cosine);
      }
      next[i] = sum / weight;
    });
    e.swap(next);
  }
  return e;
}

namespace {

// The position of the crossing on edge i, or -1.
Real crossing_on(const MeshView& mesh, const CrestFields& crest, const CrossingOptions& options, Index i) {
  const Index v1 = mesh.edge_v0[i], v2 = mesh.edge_v1[i];
  if (!crest.may_carry(v1) || !crest.may_carry(v2)) return -1;
  const Vec3 t1 = crest.t(v1), t2_stored = crest.t(v2);
  const Real flip = t1.dot(t2_stored) < 0 ? -1 : 1;
  const Vec3 t2 = flip * t2_stored;
  const Real e1 = crest.e(v1), e2 = flip * crest.e(v2);

  const auto& rho = crest.fields.radius;
  const auto is_zero = [&](Real e, Index v) {
    return e == 0 || (options.symbolic_zeros && std::abs(e) * rho[v] * rho[v] < options.zero);
  };
  const bool zero1 = is_zero(e1, v1), zero2 = is_zero(e2, v2);
  if ((zero1 || zero2) && !options.symbolic_zeros) return -1;
  // A zero is positive along its own stored direction, so a turned one counts as negative here.
  const bool positive1 = zero1 || e1 > 0, positive2 = zero2 ? flip > 0 : e2 > 0;
  if (positive1 == positive2) return -1;

  const Vec3 along = mesh.point(v2) - mesh.point(v1);
  if (zero1 && zero2) {
    // Both ends lie on a curve of extremal k; the opposite vertices tell a maximum from a minimum.
    const Vec3 middle = mesh.point(v1) + 0.5 * along;
    bool rises = false, falls = false;
    for (Index f : {mesh.edge_f0[i], mesh.edge_f1[i]}) {
      if (f == kNone) continue;
      for (Index w : mesh.face(f)) {
        if (w == v1 || w == v2 || is_zero(crest.e(w), w)) continue;
        const Real vote = crest.e(w) * (middle - mesh.point(w)).dot(crest.t(w));
        rises |= vote > 0, falls |= vote < 0;
      }
    }
    return rises && !falls ? 0.5 : -1;
  }
  const bool grows1 = !zero1 && e1 * along.dot(t1) > 0;
  const bool grows2 = !zero2 && e2 * along.dot(t2) < 0;
  if (!grows1 && !grows2) return -1;
  if (zero1) return 0;
  if (zero2) return 1;
  return std::abs(e1) / (std::abs(e1) + std::abs(e2));
}

}  // namespace

EdgeCrossings edge_crossings(const Work& work, const MeshView& mesh, const CrestFields& crest,
                             std::span<const std::uint8_t> suppressed, const CrossingOptions& options) {
  EdgeCrossings out;
  out.edge = compact(work, mesh.edge_count(), [&](std::size_t i) {
    const Index e = static_cast<Index>(i);
    if (!suppressed.empty() && suppressed[mesh.edge_v0[e]] && suppressed[mesh.edge_v1[e]]) return false;
    return crossing_on(mesh, crest, options, e) >= 0;
  });
  out.position.resize(out.edge.size());
  for_each(work, Cost::light, out.edge.size(),
           [&](std::size_t i) { out.position[i] = crossing_on(mesh, crest, options, out.edge[i]); });
  return out;
}

}  // namespace intarsia::kernels
