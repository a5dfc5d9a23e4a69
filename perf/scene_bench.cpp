#include <cstdlib>

#include "engine/io/read_mesh.h"
#include "perf/bench_scene.h"
#include "tools/make/shape.h"

namespace intarsia::perf {
namespace {

Soup load(const Work& work) {
  if (const char* path = std::getenv("INTARSIA_MESH")) return read_mesh(work, path);
  tools::MakeOptions options;
  options.irregularity = 0.3, options.noise_edges = 0.03;
  const char* triangles = std::getenv("INTARSIA_TRIANGLES");
  options.triangles = triangles ? std::strtoull(triangles, nullptr, 10) : 200'000;
  return tools::make_shape(work, options);
}

BenchScene make_scene() {
  const Work work;
  BenchScene s;
  s.soup = load(work);
  s.surface = graph::mesh_to_surface(work, s.soup);
  s.sharp = graph::surface_to_sharp(work, s.surface, s.options);
  s.scale = graph::surface_to_scale(work, s.surface, s.sharp, s.options);
  s.curvature = graph::scale_to_curvature(work, s.surface, s.scale, s.sharp, s.options);
  s.ridges = graph::curvature_to_ridges(work, s.surface, s.curvature, s.sharp, CurveKind::ridge, s.options);
  s.valleys = graph::curvature_to_ridges(work, s.surface, s.curvature, s.sharp, CurveKind::valley, s.options);
  s.curves = graph::ridges_to_curves(work, s.surface, s.ridges, s.valleys, s.sharp, s.options);
  s.directions = graph::curvature_to_directions(work, s.surface, s.curvature, s.options);
  s.network = graph::curves_to_network(work, s.surface, s.directions, s.curves, {}, s.options);
  s.patches = graph::network_to_patches(work, s.surface, s.network, s.options);
  return s;
}

}  // namespace

const BenchScene& bench_scene() {
  static const BenchScene scene = make_scene();
  return scene;
}

}  // namespace intarsia::perf
