// One benchmark per stage and per hot kernel. Vertices or faces per second, bytes of the result per item.
#include "engine/parallel/connect_mesh.h"
#include "kernels/network/direction_field.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/surface/kd_order.h"
#include "perf/bench_scene.h"

using namespace intarsia;
using namespace intarsia::perf;

namespace {

// Runs make() over and over; what it makes is kept until the clock has stopped.
template <class Make>
void measure(benchmark::State& state, std::size_t items, const Make& make) {
  std::size_t bytes = 0;
  for (auto _ : state) {
    auto artefact = make();
    benchmark::DoNotOptimize(artefact);
    state.PauseTiming();
    bytes = graph::bytes_of(artefact);
    { const auto freed = std::move(artefact); }
    state.ResumeTiming();
  }
  report(state, items, bytes);
}

void surface(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.faces(), [&] { return graph::mesh_to_surface(Work(), s.soup); });
}
void kd_order(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  std::vector<Index> order(s.vertices());
  const Vec3View points{s.surface.mesh.x, s.surface.mesh.y, s.surface.mesh.z};
  for (auto _ : state) kernels::kd_order(Work(), points, {}, order);
  report(state, s.vertices(), order.size() * sizeof(Index));
}
void connect(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  Mesh mesh = s.surface.mesh;
  for (auto _ : state) connect_mesh(Work(), mesh);
  report(state, s.faces(), mesh.edge_v0.size() * 4 * sizeof(Index));
}
void scale(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.vertices(), [&] { return graph::surface_to_scale(Work(), s.surface, s.sharp, s.options); });
}
void curvature(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.vertices(),
          [&] { return graph::scale_to_curvature(Work(), s.surface, s.scale, s.sharp, s.options); });
}
void ridges(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.faces(), [&] {
    return graph::curvature_to_ridges(Work(), s.surface, s.curvature, s.sharp, CurveKind::ridge, s.options);
  });
}
void curves(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.vertices(),
          [&] { return graph::ridges_to_curves(Work(), s.surface, s.ridges, s.valleys, s.sharp, s.options); });
}
void direction_field(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  for (auto _ : state)
    benchmark::DoNotOptimize(kernels::direction_field(Work(), s.surface.mesh, s.curvature.fields, s.options.direction));
  report(state, s.vertices(), s.vertices() * (3 * sizeof(Real) + 3 * sizeof(float)));
}
void network(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.faces(),
          [&] { return graph::curves_to_network(Work(), s.surface, s.directions, s.curves, {}, s.options); });
}
void flood(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  for (auto _ : state)
    benchmark::DoNotOptimize(kernels::flood_patches(Work(), s.network.refined.mesh, s.network.refined.on_network));
  report(state, s.network.refined.mesh.face_count(), s.network.refined.mesh.face_count() * sizeof(Index));
}
void patches(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.faces(), [&] { return graph::network_to_patches(Work(), s.surface, s.network, s.options); });
}
void layout(benchmark::State& state) {
  const BenchScene& s = bench_scene();
  measure(state, s.faces(),
          [&] { return graph::patches_to_layout(Work(), s.surface, s.curvature, s.network, s.patches, s.options); });
}

#define INTARSIA_BENCH(f) BENCHMARK(f)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
INTARSIA_BENCH(surface);
INTARSIA_BENCH(kd_order);
INTARSIA_BENCH(connect);
INTARSIA_BENCH(scale);
INTARSIA_BENCH(curvature);
INTARSIA_BENCH(ridges);
INTARSIA_BENCH(curves);
INTARSIA_BENCH(direction_field);
INTARSIA_BENCH(network);
INTARSIA_BENCH(flood);
INTARSIA_BENCH(patches);
INTARSIA_BENCH(layout);

}  // namespace
