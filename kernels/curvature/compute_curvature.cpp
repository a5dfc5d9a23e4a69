#include "kernels/curvature/compute_curvature.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/curvature/extremality.h"
#include "kernels/curvature/principal_curvature.h"

namespace intarsia::kernels {

namespace {

struct RingScratch {
  RingWalker walker;
  PointBatch batch;
};
struct DiscScratch {
  DiscWalker walker;
  PointBatch batch;
};

void store(std::size_t v, const Frame& frame, const VertexFit& fit, const CurvatureOptions& o, CurvatureFields& out) {
  const PrincipalCurvature k = principal_curvature(fit.cubic);
  const bool valid = fit.status != FitStatus::invalid;
  out.kmax[v] = valid ? k.kmax : 0;
  out.kmin[v] = valid ? k.kmin : 0;
  const auto lifted = [&](const std::array<Real, 2>& t) -> Vec3 { return t[0] * frame.u + t[1] * frame.v; };
  // Leaving out t's part along the normal turns it into the tangent plane of the stored normal.
  const Vec3 tmax = lifted(k.tmax).normalized();
  out.tmax.set(v, tmax);
  out.tmin.set(v, frame.n.cross(tmax));
  const bool cubic = fit.status == FitStatus::full || fit.status == FitStatus::ring_grown;
  out.emax[v] = cubic ? extremality(fit.cubic, k.tmax) : 0;
  out.emin[v] = cubic ? extremality(fit.cubic, k.tmin) : 0;
  out.radius[v] = fit.radius;
  out.ring[v] = static_cast<std::uint8_t>(fit.ring);
  out.status[v] = fit.status;
  out.direction_ok[v] = valid && directions_defined(k, fit.radius, o.anisotropy, o.flat_turn);
}

bool has_normal(const Vec3& n) { return n.squaredNorm() > 0.5; }

void fit_in_rings(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> fit_ring, bool with_discs,
                  std::span<const std::uint8_t> barrier, const CurvatureOptions& o, CurvatureFields& out) {
  auto pool = make_scratch_pool([&] { return RingScratch{RingWalker(mesh, barrier), {}}; });
  const Vec3View normal = out.normal;
  for_each_block(work, Cost::medium, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto scratch = pool.borrow();
    for (std::size_t v = begin; v < end; ++v) {
      if (with_discs && is_disc(fit_ring[v])) continue;
      const int ring = std::min<int>(fit_ring[v], kRings);
      const Vec3 n = normal[v];
      if (!has_normal(n)) {
        store(v, Frame(Vec3::UnitZ()), VertexFit{}, o, out);
        continue;
      }
      const Frame frame(n);
      store(v, frame,
            fit_rings(mesh, normal, static_cast<Index>(v), frame, ring, 7, o.fit, scratch->walker, scratch->batch), o,
            out);
    }
  });
}

void fit_in_discs(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> fit_ring,
                  const SampleLevels& levels, std::span<const std::uint8_t> barrier, const CurvatureOptions& o,
                  CurvatureFields& out) {
  const Vec3View normal = out.normal;
  const std::vector<Vec3Array> sample_normal = sample_normals(work, mesh, levels, normal);
  const SampleLevel& base = levels.level[0];
  auto discs = make_scratch_pool([&] { return DiscScratch{DiscWalker(levels), {}}; });
  auto rings = make_scratch_pool([&] { return RingScratch{RingWalker(mesh, barrier), {}}; });
  for_each_block(work, Cost::medium, base.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto disc = discs.borrow();
    for (std::size_t i = begin; i < end; ++i) {
      const Index c = static_cast<Index>(i);
      for (Index v : base.member.row(c)) {
        if (!is_disc(fit_ring[v])) continue;
        const Frame frame(has_normal(normal[v]) ? normal[v] : Vec3(Vec3::UnitZ()));
        VertexFit fit =
            fit_disc(mesh, levels, sample_normal, v, c, fit_ring[v], frame, o.fit, disc->walker, disc->batch);
        if (fit.status == FitStatus::invalid && has_normal(normal[v])) {
          const auto ring = rings.borrow();
          fit = fit_rings(mesh, normal, v, frame, kRings, 7, o.fit, ring->walker, ring->batch);
        }
        store(v, frame, fit, o, out);
      }
    }
  });
}

}  // namespace

CurvatureFields compute_curvature(const Work& work, const MeshView& mesh, const Vec3View& vertex_normal,
                                  std::span<const std::uint8_t> fit_ring, const SampleLevels& levels,
                                  std::span<const std::uint8_t> barrier, const CurvatureOptions& options) {
  const std::size_t n = mesh.vertex_count();
  CurvatureFields out;
  out.resize(n);
  if (options.fit.refine_normals) {
    refine_normals(work, mesh, vertex_normal, fit_ring, barrier, options.fit, out.normal);
  } else {
    for_each(work, Cost::light, n, [&](std::size_t v) { out.normal.set(v, vertex_normal[v]); });
  }
  fit_in_rings(work, mesh, fit_ring, !levels.level.empty(), barrier, options, out);
  if (!levels.level.empty()) fit_in_discs(work, mesh, fit_ring, levels, barrier, options, out);
  return out;
}

}  // namespace intarsia::kernels
