// The data that every benchmark reads: a mesh and the artefacts before the kernel under test, made once.
// Mesh: the file named by INTARSIA_MESH, else the generated part with INTARSIA_TRIANGLES (default 200000) triangles.
#pragma once

#include <benchmark/benchmark.h>

#include "graph/stages.h"

namespace intarsia::perf {

struct BenchScene {
  graph::LayoutOptions options = graph::robust_options();
  Soup soup;
  graph::Surface surface;
  graph::Sharp sharp;
  graph::Scale scale;
  graph::Curvature curvature;
  graph::Ridges ridges, valleys;
  graph::Curves curves;
  graph::Directions directions;
  graph::Network network;
  graph::Patches patches;

  Index vertices() const { return surface.mesh.vertex_count(); }
  Index faces() const { return surface.mesh.face_count(); }
};

const BenchScene& bench_scene();

// items/s and bytes/item of one iteration.
inline void report(benchmark::State& state, std::size_t items, std::size_t bytes) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * items));
  state.counters["bytes/item"] = static_cast<double>(bytes) / static_cast<double>(items);
}

}  // namespace intarsia::perf
