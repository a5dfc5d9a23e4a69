#include "kernels/curvature/compute_curvature.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/curvature/curvature_lanes.h"
#include "kernels/curvature/disc_fitter.h"
#include "kernels/curvature/extremality.h"
#include "kernels/curvature/group_fitter.h"
#include "kernels/curvature/principal_curvature.h"

namespace intarsia::kernels {

namespace {

struct OneFitter {
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

// One lane of a pack, with what all lanes share.
struct LaneResult {
  const LaneFrames& frames;
  const LaneFits& fits;
  const LaneCurvatures& curvatures;
};

void store(Index v, std::size_t l, const LaneResult& r, std::uint8_t ring, const CurvatureOptions& o,
           CurvatureFields& out) {
  const LaneCurvatures& k = r.curvatures;
  out.kmax[v] = k.kmax[l], out.kmin[v] = k.kmin[l];
  out.tmax.x[v] = k.tmax_x[l], out.tmax.y[v] = k.tmax_y[l], out.tmax.z[v] = k.tmax_z[l];
  out.tmin.x[v] = k.tmin_x[l], out.tmin.y[v] = k.tmin_y[l], out.tmin.z[v] = k.tmin_z[l];
  out.emax[v] = k.emax[l], out.emin[v] = k.emin[l];
  out.radius[v] = r.fits.radius[l];
  out.ring[v] = ring;
  out.status[v] = FitStatus::full;
  PrincipalCurvature principal;
  principal.kmax = k.kmax[l], principal.kmin = k.kmin[l];
  out.direction_ok[v] = directions_defined(principal, r.fits.radius[l], o.anisotropy, o.flat_turn);
}

// The fit of one vertex, where lanes have no answer.
void fit_alone_in_rings(const MeshView& mesh, Index v, int ring, const CurvatureOptions& o, OneFitter& one,
                        CurvatureFields& out) {
  const Vec3 n = out.normal[v];
  if (!has_normal(n)) {
    store(v, Frame(Vec3::UnitZ()), VertexFit{}, o, out);
    return;
  }
  const Frame frame(n);
  store(v, frame, fit_rings(mesh, out.normal, v, frame, ring, 7, o.fit, one.walker, one.batch), o, out);
}

template <class Alone>
void fit_in_rings(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> fit_ring, bool with_discs,
                  std::span<const std::uint8_t> barrier, const CurvatureOptions& o, Alone& alone,
                  CurvatureFields& out) {
  auto fitters = make_scratch_pool([&] { return GroupFitter(mesh, barrier); });
  for_each_block(work, Cost::medium, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    if (with_discs && std::all_of(fit_ring.begin() + begin, fit_ring.begin() + end, is_disc)) return;
    const auto fitter = fitters.borrow();
    LaneCurvatures curvatures;
    for (std::size_t first = begin; first < end; first += GroupFitter::kGroup) {
      std::array<std::uint8_t, GroupFitter::kGroup> ring;
      const std::size_t count = std::min<std::size_t>(GroupFitter::kGroup, end - first);
      for (std::size_t b = 0; b < count; ++b) {
        const std::uint8_t r = fit_ring[first + b];
        ring[b] = with_discs && is_disc(r) ? 0 : std::min<std::uint8_t>(r, kRings);
      }
      fitter->fit(static_cast<Index>(first), std::span(ring).first(count), out.normal, 7, o.fit,
                  [&](const GroupFitter::Pack& pack) {
                    if (pack.fits.solved) lane_curvatures(instruction_set(), pack.frames, pack.fits, curvatures);
                    for (std::size_t l = 0; l < kLanes; ++l) {
                      if ((pack.active >> l & 1) == 0) continue;
                      const Index v = pack.first + static_cast<Index>(l);
                      if (pack.fits.solved >> l & 1)
                        store(v, l, {pack.frames, pack.fits, curvatures}, pack.depth[l], o, out);
                      else
                        fit_alone_in_rings(mesh, v, ring[v - first], o, *alone.borrow(), out);
                    }
                  });
    }
  });
}

// The disc of one vertex, or rings where that fails too.
void fit_alone_in_disc(const MeshView& mesh, const SampleLevels& levels, std::span<const Vec3Array> sample_normal,
                       Index v, Index c, int code, const CurvatureOptions& o, DiscScratch& disc, OneFitter& one,
                       CurvatureFields& out) {
  const Vec3View normal = out.normal;
  const Frame frame(has_normal(normal[v]) ? normal[v] : Vec3(Vec3::UnitZ()));
  VertexFit fit = fit_disc(mesh, levels, sample_normal, v, c, code, frame, o.fit, disc.walker, disc.batch);
  if (fit.status == FitStatus::invalid && has_normal(normal[v]))
    fit = fit_rings(mesh, normal, v, frame, kRings, 7, o.fit, one.walker, one.batch);
  store(v, frame, fit, o, out);
}

template <class Alone>
void fit_in_discs(const Work& work, const MeshView& mesh, std::span<const std::uint8_t> fit_ring,
                  const SampleLevels& levels, const CurvatureOptions& o, Alone& alone, CurvatureFields& out) {
  const std::vector<Vec3Array> sample_normal = sample_normals(work, mesh, levels, out.normal);
  const SampleLevel& start = levels.level[DiscFitter::start_level(levels)];
  auto fitters = make_scratch_pool([&] { return DiscFitter(mesh, levels, sample_normal); });
  auto discs = make_scratch_pool([&] { return DiscScratch{DiscWalker(levels), {}}; });
  for_each_block(work, Cost::heavy, start.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto fitter = fitters.borrow();
    LaneCurvatures curvatures;
    for (std::size_t c = begin; c < end; ++c)
      fitter->fit(static_cast<Index>(c), out.normal, fit_ring, o.fit, [&](const DiscFitter::Pack& pack) {
        if (pack.fits.solved) lane_curvatures(instruction_set(), pack.frames, pack.fits, curvatures);
        for (std::size_t l = 0; l < pack.size; ++l)
          if (pack.fits.solved >> l & 1)
            store(pack.vertex[l], l, {pack.frames, pack.fits, curvatures}, static_cast<std::uint8_t>(pack.code), o,
                  out);
          else
            fit_alone_in_disc(mesh, levels, sample_normal, pack.vertex[l], pack.cluster[l], pack.code, o,
                              *discs.borrow(), *alone.borrow(), out);
      });
  });
}

// Memory is cleared by the system when it is first touched, which takes long for large meshes: side by side.
void make_room(const Work& work, std::size_t n, CurvatureFields& out) {
  std::vector<Real>* const reals[] = {&out.normal.x, &out.normal.y, &out.normal.z, &out.kmax,   &out.kmin,
                                      &out.tmax.x,   &out.tmax.y,   &out.tmax.z,   &out.tmin.x, &out.tmin.y,
                                      &out.tmin.z,   &out.emax,     &out.emin,     &out.radius};
  for_each(work, Cost::single, std::size(reals), [&](std::size_t i) { reals[i]->resize(n); });
  out.resize(n);
}

}  // namespace

CurvatureFields compute_curvature(const Work& work, const MeshView& mesh, const Vec3View& vertex_normal,
                                  std::span<const std::uint8_t> fit_ring, const SampleLevels& levels,
                                  std::span<const std::uint8_t> barrier, const CurvatureOptions& options) {
  const std::size_t n = mesh.vertex_count();
  CurvatureFields out;
  make_room(work, n, out);
  if (options.fit.refine_normals) {
    refine_normals(work, mesh, vertex_normal, fit_ring, barrier, options.fit, out.normal);
  } else {
    for_each(work, Cost::light, n, [&](std::size_t v) { out.normal.set(v, vertex_normal[v]); });
  }
  auto alone = make_scratch_pool([&] { return OneFitter{RingWalker(mesh, barrier), {}}; });
  const bool with_discs = !levels.level.empty();
  fit_in_rings(work, mesh, fit_ring, with_discs, barrier, options, alone, out);
  if (with_discs) fit_in_discs(work, mesh, fit_ring, levels, options, alone, out);
  return out;
}

}  // namespace intarsia::kernels
