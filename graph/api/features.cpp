#include "engine/parallel/for_each.h"
#include "graph/api/run.h"
#include "graph/input_numbers.h"
#include "graph/layout_graph.h"

namespace intarsia {
namespace {

// Values of the surface's vertices in the input's numbers, `missing` where there are none.
class Gather {
 public:
  Gather(const Work& work, const std::vector<Index>& from) : work_(work), from_(from) {}

  template <class Out, class In>
  void operator()(const std::vector<In>& values, std::vector<Out>& out, Out missing = 0, Real unit = 1) const {
    out.resize(from_.size());
    for_each(work_, Cost::light, from_.size(), [&](std::size_t v) {
      if (from_[v] == kNone)
        out[v] = missing;
      else if constexpr (std::is_same_v<Out, double>)
        out[v] = unit * values[from_[v]];
      else
        out[v] = static_cast<Out>(values[from_[v]]);
    });
  }
  void operator()(const Vec3Array& values, std::vector<double>& out) const {
    out.resize(3 * from_.size());
    for_each(work_, Cost::light, from_.size(), [&](std::size_t v) {
      const Vec3 value = from_[v] == kNone ? Vec3::Zero() : values[from_[v]];
      for (int i = 0; i < 3; ++i) out[3 * v + i] = value[i];
    });
  }

 private:
  const Work& work_;
  const std::vector<Index>& from_;
};

void make_features(const TriangleMesh& mesh, const Options& options, Features& out) {
  graph::LayoutOptions method = call::layout_options(options);
  method.scale.keep_variation = true;
  call::Run run(options, options.time_limit);
  const Port<Soup> soup = run.add_read(mesh, &graph::kFeaturesCost, options.max_memory);
  const graph::FeaturePorts ports = graph::add_feature_stages(run.flow(), soup, method);
  const auto finish = [&](const Work& work, const Soup& s, const graph::Surface& surface, const graph::Scale& scale,
                          const graph::Curvature& curvature) {
    run.stop_clock();
    const std::vector<Index> from = graph::surface_vertices(work, s, surface);
    const CurvatureFields& k = curvature.fields;
    const Real per_length = 1 / surface.box.diagonal, per_area = per_length * per_length;
    const Gather gather(work, from);
    gather(k.normal, out.normals), gather(k.tmax, out.tmax), gather(k.tmin, out.tmin);
    gather(k.kmax, out.kmax, 0.0, per_length), gather(k.kmin, out.kmin, 0.0, per_length);
    gather(k.emax, out.emax, 0.0, per_area), gather(k.emin, out.emin, 0.0, per_area);
    gather(scale.fields.scale, out.scale), gather(k.ring, out.fit_ring);
    gather(k.status, out.status, static_cast<std::int32_t>(FitStatus::invalid));
    const std::size_t rings = scale.fields.omega.size();
    out.variation.resize(rings * from.size());
    for_each(work, Cost::light, from.size(), [&](std::size_t v) {
      for (std::size_t r = 0; r < rings; ++r)
        out.variation[rings * v + r] = from[v] == kNone ? 0 : scale.fields.omega[r][from[v]];
    });
    return call::Done();
  };
  using Finish = Stage<call::Done, Soup, graph::Surface, graph::Scale, graph::Curvature>;
  add_stage(run.flow(), Finish{"result", 1, 0, finish, {}, 0.2}, soup, ports.surface, ports.scale, ports.curvature);
  run.run();
}

}  // namespace

inline namespace api {

Result<Features> features(const TriangleMesh& mesh, const Options& options) noexcept {
  return call::guarded<Features>([&](Result<Features>& result) { make_features(mesh, options, result.value); });
}

}  // namespace api
}  // namespace intarsia
