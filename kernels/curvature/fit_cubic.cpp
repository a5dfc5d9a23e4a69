#include "kernels/curvature/fit_cubic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/curvature/curvature_lanes.h"
#include "kernels/curvature/group_fitter.h"

namespace intarsia::kernels {

namespace {

struct Scratch {
  RingWalker walker;
  PointBatch batch;
};

}  // namespace

Frame::Frame(const Vec3& normal) : n(normal) {
  const Real sign = std::copysign(Real(1), n.z());
  const Real a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  u = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
  v = {b, sign + n.y() * n.y() * a, -n.y()};
}

VertexFit fit_rings(const MeshView& mesh, const Vec3View& normal, Index v, const Frame& frame, int ring,
                    std::size_t terms, const FitOptions& options, RingWalker& walker, PointBatch& batch) {
  const Vec3 centre = mesh.point(v);
  CubicSums sums;
  VertexFit fit;
  walker.walk(v, ring);
  std::size_t used = 0;
  const auto add_walked = [&] {
    const auto points = walker.vertices(walker.depth());
    batch.clear();
    batch.reserve(points.size() - used);
    for (; used < points.size(); ++used) {
      const Index q = points[used];
      batch.push(mesh.point(q) - centre, normal[q], 1);
    }
    add_points(batch, frame.u, frame.v, frame.n, options.normal_gate, options.rows, sums);
  };
  const auto accept = [&](std::size_t with, FitStatus status) {
    if (sums.count < 3 || !solve_cubic(sums, with, options.least_pivot, fit.cubic)) return false;
    fit.status = status;
    return true;
  };
  add_walked();
  if (!accept(terms, FitStatus::full))
    for (int extra = 1; extra <= options.extra_rings; ++extra) {
      walker.extend(ring + extra);
      if (walker.depth() < ring + extra) break;
      add_walked();
      if (accept(terms, FitStatus::ring_grown)) break;
    }
  if (fit.status == FitStatus::invalid) accept(3, FitStatus::quadratic);
  fit.radius = sums.unit();
  fit.ring = walker.depth();
  return fit;
}

std::vector<Vec3Array> sample_normals(const Work& work, const MeshView& mesh, const SampleLevels& levels,
                                      const Vec3View& normal) {
  std::vector<Vec3Array> out;
  for (std::size_t l = 0; l < levels.level.size(); ++l) {
    const SampleLevel& level = levels.level[l];
    Vec3Array mean(level.size());
    for_each(work, Cost::light, level.size(), [&](std::size_t c) {
      Vec3 sum = Vec3::Zero();
      for (Index i : level.member.row(static_cast<Index>(c))) {
        if (l > 0) {
          sum += levels.level[l - 1].area[i] * out[l - 1][i];
          continue;
        }
        // Without areas per vertex a vertex counts by its share of faces.
        sum += static_cast<Real>(mesh.vertex_faces.row(i).size()) * normal[i];
      }
      const Real length = sum.norm();
      mean.set(c, length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero()));
    });
    out.push_back(std::move(mean));
  }
  return out;
}

VertexFit fit_disc(const MeshView& mesh, const SampleLevels& levels, std::span<const Vec3Array> sample_normal, Index v,
                   Index c, int code, const Frame& frame, const FitOptions& options, DiscWalker& walker,
                   PointBatch& batch) {
  const Real radius = disc_radius(code);
  const Vec3 centre = mesh.point(v);
  const DiscWalker::Samples samples = walker.around(c, code);
  const SampleLevel& level = levels.level[samples.level];
  const Vec3Array& normal = sample_normal[samples.level];
  const Real limit = radius + 0.5 * samples.cell;
  batch.clear();
  batch.reserve(samples.id.size());
  for (Index s : samples.id) {
    const Vec3 d = level.centre[s] - centre;
    const Real squared = d.squaredNorm();
    if (squared >= limit * limit) continue;
    const Real weight = level.area[s] * ramp(std::sqrt(squared), radius, samples.cell);
    batch.push(d, normal[s], weight);
  }
  CubicSums sums;
  add_points(batch, frame.u, frame.v, frame.n, options.disc_gate, Rows::round, sums);
  VertexFit fit;
  fit.radius = sums.unit();
  fit.ring = code;
  if (sums.count >= 5 && solve_cubic(sums, 10, options.least_pivot, fit.cubic)) {
    fit.status = FitStatus::full;
    fit.cubic.gradient = {0, 0};  // to first order the rows above already give the values of the adapted frame
  }
  return fit;
}

namespace {

// The normal of a fit with a free tangent plane, or the old one.
Vec3 refined(const Frame& frame, const VertexFit& fit) {
  const auto [g1, g2] = fit.cubic.gradient;
  const bool usable = fit.status == FitStatus::full || fit.status == FitStatus::ring_grown;
  if (!usable || !(g1 * g1 + g2 * g2 < 1)) return frame.n;
  return (frame.n - g1 * frame.u - g2 * frame.v).normalized();
}

}  // namespace

void refine_normals(const Work& work, const MeshView& mesh, const Vec3View& normal_in,
                    std::span<const std::uint8_t> fit_ring, std::span<const std::uint8_t> barrier,
                    const FitOptions& options, Vec3Array& normal_out) {
  normal_out.resize(mesh.vertex_count());
  auto fitters = make_scratch_pool([&] { return GroupFitter(mesh, barrier); });
  auto alone = make_scratch_pool([&] { return Scratch{RingWalker(mesh, barrier), {}}; });
  for_each_block(work, Cost::medium, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto fitter = fitters.borrow();
    LaneNormals normals;
    for (std::size_t first = begin; first < end; first += GroupFitter::kGroup) {
      std::array<std::uint8_t, GroupFitter::kGroup> ring;
      const std::size_t count = std::min<std::size_t>(GroupFitter::kGroup, end - first);
      for (std::size_t b = 0; b < count; ++b)
        ring[b] = is_disc(fit_ring[first + b]) ? static_cast<std::uint8_t>(options.refine_ring) : fit_ring[first + b];
      fitter->fit(static_cast<Index>(first), std::span(ring).first(count), normal_in, 9, options,
                  [&](const GroupFitter::Pack& pack) {
                    if (pack.fits.solved) lane_normals(instruction_set(), pack.frames, pack.fits, normals);
                    for (std::size_t l = 0; l < kLanes; ++l) {
                      if ((pack.active >> l & 1) == 0) continue;
                      const Index v = pack.first + static_cast<Index>(l);
                      const Vec3 old = normal_in[v];
                      const Real g1 = pack.fits.gradient[0][l], g2 = pack.fits.gradient[1][l];
                      if ((pack.fits.solved >> l & 1) == 0) {
                        if (!has_normal(old)) {
                          normal_out.set(v, old);
                          continue;
                        }
                        const auto scratch = alone.borrow();
                        const Frame frame(old);
                        normal_out.set(v, refined(frame, fit_rings(mesh, normal_in, v, frame, ring[v - first], 9,
                                                                   options, scratch->walker, scratch->batch)));
                      } else {
                        normal_out.set(v, g1 * g1 + g2 * g2 < 1 ? Vec3(normals.x[l], normals.y[l], normals.z[l]) : old);
                      }
                    }
                  });
    }
  });
}

}  // namespace intarsia::kernels
