#include <nlohmann/json.hpp>

#include "engine/io/output_folder.h"
#include "engine/io/write_file.h"
#include "engine/io/write_layout.h"

namespace intarsia {
namespace {

using nlohmann::json;

constexpr int kNetworkSchema = 1;

json point_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
json id_or_null(Index i) { return i == kNone ? json(nullptr) : json(i); }

json nodes_of(const LayoutView& layout) {
  const LayoutGraph& graph = *layout.graph;
  std::vector<Index> degree(graph.node_count(), 0);
  for (Index a = 0; a < graph.arc_count(); ++a) ++degree[graph.start[a]], ++degree[graph.end[a]];
  json nodes = json::array();
  for (Index n = 0; n < graph.node_count(); ++n)
    nodes.push_back({{"vertex", layout_vertex(layout, graph.node[n])},
                     {"position", point_of(layout_point(layout, graph.node[n]))},
                     {"degree", degree[n]},
                     {"artificial", graph.artificial[n] != 0}});
  return nodes;
}

json arcs_of(const Work& work, const LayoutView& layout) {
  const LayoutGraph& graph = *layout.graph;
  json arcs = json::array();
  for (Index a = 0; a < graph.arc_count(); ++a) {
    json vertices = json::array();
    for (Index v : graph.arc.row(a)) vertices.push_back(layout_vertex(layout, v));
    arcs.push_back({{"kind", static_cast<int>(graph.kind[a])},
                    {"start", graph.start[a]},
                    {"end", graph.end[a]},
                    {"left", id_or_null(graph.left[a])},
                    {"right", id_or_null(graph.right[a])},
                    {"length", graph.length[a] * layout.diagonal},
                    {"turn", graph.strength[a]},
                    {"vertices", std::move(vertices)}});
    if (a % 256 == 0) work.check();
  }
  return arcs;
}

json patches_of(const LayoutView& layout) {
  const LayoutGraph& graph = *layout.graph;
  json patches = json::array();
  for (Index p = 0; p < graph.patch_count(); ++p) {
    json loops = json::array();
    for (Index l : graph.patch_loops.row(p)) {
      json loop = json::array();
      for (Index h : graph.loop.row(l)) loop.push_back({{"arc", h / 2}, {"forward", h % 2 == 0}});
      loops.push_back(std::move(loop));
    }
    patches.push_back({{"loops", std::move(loops)}});
  }
  return patches;
}

json interior_of(const LayoutView& layout) {
  json curves = json::array();
  for (Index c = 0; c < layout.interior->curve_count(); ++c) {
    json points = json::array();
    for (Index p : layout.interior->curve.row(c)) {
      const SurfacePoint& at = layout.interior->point[p];
      const Vec3 here = given_position(layout, at, position(layout.mesh, at));
      points.push_back(point_of(layout.centre + layout.diagonal * here));
    }
    curves.push_back({{"kind", static_cast<int>(layout.interior->kind[c])}, {"points", std::move(points)}});
  }
  return curves;
}

}  // namespace

void write_network_json(const Work& work, const std::filesystem::path& path, const LayoutView& layout) {
  json root = {{"schema", "intarsia-network"}, {"version", kNetworkSchema}};
  for (int k = 0; k < kCurveKinds; ++k) root["kinds"][std::to_string(k)] = kKindNames[static_cast<std::size_t>(k)];
  root["nodes"] = nodes_of(layout);
  root["arcs"] = arcs_of(work, layout);
  root["patches"] = patches_of(layout);
  root["interior_curves"] = interior_of(layout);
  write_file_atomically(path, root.dump(1) + "\n");
}

}  // namespace intarsia
