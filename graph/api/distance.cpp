#include "engine/parallel/for_each.h"
#include "graph/api/run.h"
#include "graph/api/sides.h"

namespace intarsia {
namespace {

constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;

Vec3Array in_frame(const Work& work, const Soup& soup, const kernels::BoxTransform& box) {
  Vec3Array unit(soup.vertex_count());
  for_each(work, Cost::light, unit.size(), [&](std::size_t v) {
    unit.set(v, box.to_unit({soup.x[v], soup.y[v], soup.z[v]}));
  });
  return unit;
}

std::vector<double> scaled(std::vector<Real> values, Real unit) {
  for (Real& v : values) v *= unit;
  return values;
}

void measure(const Work& work, const TriangleMesh& mesh_a, const TriangleMesh& mesh_b, const DistanceOptions& options,
             Distance& out) {
  const Soup a = call::soup_of(work, mesh_a), b = call::soup_of(work, mesh_b);
  const kernels::BoxTransform box = kernels::normalise_box(work, a);
  kernels::normalise_box(work, b);  // refuses what has no triangles or no finite coordinates
  const Vec3Array unit_a = in_frame(work, a, box), unit_b = in_frame(work, b, box);
  kernels::DistanceOptions how;
  how.samples = options.samples, how.per_sample = options.keep_samples;
  kernels::SurfaceDistance d =
      kernels::surface_distance(work, TrianglesView{unit_a, a.corner}, TrianglesView{unit_b, b.corner}, how);
  const Real unit = box.diagonal;
  out.diagonal = unit;
  out.hausdorff = unit * d.hausdorff(), out.mean = unit * d.mean(), out.rms = unit * d.rms();
  out.forward = call::side_of(d.forward, box), out.backward = call::side_of(d.backward, box);
  out.vertex_distance = scaled(std::move(d.vertex_distance), unit);
  out.triangle_rms = scaled(std::move(d.face_rms), unit), out.triangle_max = scaled(std::move(d.face_max), unit);
  out.sample_distance = scaled(std::move(d.forward_sample.distance), unit);
  out.sample_triangle = call::signed_numbers(d.forward_sample.triangle);
  for (std::size_t i = 0; i < out.sample_distance.size(); ++i) {
    const Vec3 p = box.to_input(d.forward_sample.point[i]);
    out.sample_point.insert(out.sample_point.end(), {p.x(), p.y(), p.z()});
  }
}

}  // namespace

DistanceSide call::side_of(const kernels::OneSided& side, const kernels::BoxTransform& box) {
  const Vec3 worst = box.to_input(side.worst);
  DistanceSide out;
  out.max = side.max * box.diagonal, out.bound = side.bound * box.diagonal;
  out.mean = side.mean * box.diagonal, out.rms = side.rms * box.diagonal;
  out.area = side.area * box.diagonal * box.diagonal;
  out.samples = side.samples, out.worst = {worst.x(), worst.y(), worst.z()};
  out.worst_triangle = static_cast<std::int32_t>(side.worst_triangle);
  return out;
}

std::uint64_t call::checked_samples(std::uint64_t samples) {
  if (samples < 2 || samples > kMostSamples)
    throw Error(ErrorCode::bad_argument, "samples must be in 2 .. " + std::to_string(kMostSamples));
  return samples;
}

inline namespace api {

Result<Distance> distance(const TriangleMesh& a, const TriangleMesh& b, const DistanceOptions& options) noexcept {
  return call::guarded<Distance>([&](Result<Distance>& result) {
    call::checked_samples(options.samples);
    call::Run run(options);
    run.add_single("distance", [&](const Work& work) { measure(work, a, b, options, result.value); });
    run.run();
  });
}

}  // namespace api
}  // namespace intarsia
