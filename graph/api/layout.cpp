#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "engine/parallel/for_each.h"
#include "graph/api/run.h"
#include "graph/input_numbers.h"
#include "graph/layout_graph.h"
#include "graph/layout_report.h"
#include "graph/visit_options.h"

namespace intarsia {
namespace {

using nlohmann::json;

std::array<double, 3> array_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Network network_of(const LayoutView& view) {
  const LayoutGraph& graph = *view.graph;
  const auto number = [&](Index v) { return static_cast<std::int32_t>(layout_vertex(view, v)); };
  Network network;
  network.nodes.resize(graph.node_count());
  for (Index n = 0; n < graph.node_count(); ++n) {
    Node& node = network.nodes[n];
    node.position = array_of(layout_point(view, graph.node[n]));
    node.vertex = number(graph.node[n]), node.is_artificial = graph.artificial[n] != 0;
  }
  network.arcs.resize(graph.arc_count());
  for (Index a = 0; a < graph.arc_count(); ++a) {
    Arc& arc = network.arcs[a];
    arc.kind = static_cast<ArcKind>(graph.kind[a]);
    arc.start = static_cast<std::int32_t>(graph.start[a]), arc.end = static_cast<std::int32_t>(graph.end[a]);
    arc.left = static_cast<std::int32_t>(graph.left[a]), arc.right = static_cast<std::int32_t>(graph.right[a]);
    arc.length = graph.length[a] * view.diagonal, arc.strength = graph.strength[a];
    ++network.nodes[graph.start[a]].degree, ++network.nodes[graph.end[a]].degree;
  }
  network.arc_offset.assign(graph.arc.offset.begin(), graph.arc.offset.end());
  if (network.arc_offset.empty()) network.arc_offset.push_back(0);
  for (const Index v : graph.arc.item) network.arc_vertex.push_back(number(v));
  network.loop_patch = call::signed_numbers(graph.loop_patch);
  network.loop_offset.assign(graph.loop.offset.begin(), graph.loop.offset.end());
  if (network.loop_offset.empty()) network.loop_offset.push_back(0);
  for (const Index half : graph.loop.item) {
    network.loop_arc.push_back(static_cast<std::int32_t>(half / 2));
    network.loop_is_forward.push_back(half % 2 == 0 ? 1 : 0);
  }
  return network;
}

std::vector<InteriorCurve> interior_of(const LayoutView& view) {
  std::vector<InteriorCurve> curves(view.interior->curve_count());
  for (Index c = 0; c < curves.size(); ++c) {
    curves[c].kind = static_cast<ArcKind>(view.interior->kind[c]);
    for (const Index i : view.interior->curve.row(c)) {
      const SurfacePoint& p = view.interior->point[i];
      const Vec3 at = view.centre + view.diagonal * given_position(view, p, position(view.mesh, p));
      curves[c].points.insert(curves[c].points.end(), {at.x(), at.y(), at.z()});
    }
  }
  return curves;
}

std::vector<Patch> patches_of(const PatchTable& table, Real diagonal) {
  std::vector<Patch> patches(table.count());
  for (Index p = 0; p < table.count(); ++p) {
    Patch& patch = patches[p];
    patch.triangles = table.faces[p];
    patch.area = table.area[p] * diagonal * diagonal, patch.perimeter = table.perimeter[p] * diagonal;
    patch.compactness = patch.area > 0 ? patch.perimeter * patch.perimeter / (4 * std::numbers::pi * patch.area) : 0;
    patch.flatness = table.area[p] > 0 ? table.normal_sum[p].norm() / table.area[p] : 1;
    patch.loops = static_cast<std::int32_t>(table.loops[p]);
    patch.filled_holes = static_cast<std::int32_t>(table.filled_holes[p]);
    patch.is_disc = table.is_disc(p);
  }
  return patches;
}

void fill_layout_mesh(const Work& work, const LayoutView& view, Layout& out) {
  out.vertices.resize(3 * std::size_t{layout_vertex_count(view)});
  for_each(work, Cost::light, layout_vertex_count(view), [&](std::size_t v) {
    const Vec3 p = layout_point_by_number(view, static_cast<Index>(v));
    for (int i = 0; i < 3; ++i) out.vertices[3 * v + i] = p[i];
  });
  const std::vector<Index> order = layout_faces(work, view);
  const std::size_t faces = order.size();
  out.triangles.resize(3 * faces), out.triangle_patch.resize(faces), out.triangle_parent.resize(faces);
  for_each(work, Cost::light, faces, [&](std::size_t i) {
    const Index f = order[i];
    for (int k = 0; k < 3; ++k)
      out.triangles[3 * i + k] = static_cast<std::int32_t>(layout_vertex(view, view.refined->mesh.corner[3 * f + k]));
    out.triangle_patch[i] = static_cast<std::int32_t>(view.labels->patch_of_face[f]);
    out.triangle_parent[i] = static_cast<std::int32_t>(view.face_order[view.refined->parent[f]]);
  });
}

json options_json(const Options& given, graph::LayoutOptions options) {
  json out;
  graph::visit_options(options, [&](const char* name, const auto& value, const char*, auto, auto) {
    out[name] = {{"value", value}, {"given", given.method.contains(std::string_view(name))}};
  });
  out["patches"] = {{"value", options.patches}, {"given", options.patches > 0}};
  return out;
}

json report_of(const Options& options, const graph::LayoutOptions& method, call::Run& run, const json& summary) {
  json report = {{"schema", "intarsia-report"}, {"schema_version", 1}, {"program", "intarsia"}};
  report["version"] = version(), report["compiler"] = __VERSION__, report["command"] = "layout";
  report["mode"] = options.mode == Mode::paper ? "paper" : "robust";
  report["threads"] = run.context().threads(), report["seed"] = options.seed;
  report["options"] = options_json(options, method);
  report.update(run.flow().record().to_json());
  report.merge_patch(summary);
  if (options.time_limit > 0)
    report["time_limit"] = {{"seconds", options.time_limit}, {"shortened", run.was_shortened()}};
  return report;
}

graph::GuideSource guides_of(const Options& options) {
  graph::GuideSource source;
  if (options.curves.empty() && options.pins.empty()) return source;
  source.read = [&options](const Soup& soup) {
    graph::GivenGuides given;
    for (const std::vector<double>& curve : options.curves) {
      if (curve.size() < 6 || curve.size() % 3 != 0 ||
          !std::all_of(curve.begin(), curve.end(), [](double x) { return std::isfinite(x); }))
        throw Error(ErrorCode::bad_argument, "curve " + std::to_string(given.curve.size()) +
                                                 " must be x, y, z of two points or more, all finite");
      std::vector<Vec3>& points = given.curve.emplace_back();
      for (std::size_t i = 0; i < curve.size(); i += 3) points.emplace_back(curve[i], curve[i + 1], curve[i + 2]);
    }
    if (!options.pins.empty() && options.pins.size() != soup.face_count())
      throw Error(ErrorCode::bad_argument,
                  "pins must be one for each triangle: " + std::to_string(options.pins.size()) + " for " +
                      std::to_string(soup.face_count()));
    given.pin.assign(options.pins.begin(), options.pins.end());
    return given;
  };
  return source;
}

void make_layout(const TriangleMesh& mesh, const Options& options, Result<Layout>& result) {
  const graph::LayoutOptions method = call::layout_options(options);
  call::Run run(options, options.time_limit);
  const Port<Soup> soup = run.add_read(mesh, &graph::kRunCost, options.max_memory);
  const graph::LayoutPorts ports = graph::add_layout_stages(run.flow(), soup, method, guides_of(options));
  keep(ports.goal);
  Layout& out = result.value;
  json summary;
  const auto finish = [&](const Work& work, const Soup& s, const graph::Surface& surface,
                          const graph::Smoothing& smoothing, const graph::Layout& layout) {
    run.stop_clock();
    graph::add_layout_report(summary, s, surface, smoothing.network, layout, method.patches);
    const LayoutView view = graph::layout_view(s, surface, layout);
    out.labels = call::signed_numbers(input_patches(work, view));
    fill_layout_mesh(work, view, out);
    out.network = network_of(view), out.interior = interior_of(view);
    out.patches = patches_of(layout.table, view.diagonal);
    out.diagonal = view.diagonal;
    return call::Done();
  };
  using Finish = Stage<call::Done, Soup, graph::Surface, graph::Smoothing, graph::Layout>;
  add_stage(run.flow(), Finish{"result", 1, 0, finish, {}, 0.2}, soup, ports.features.surface, ports.smoothing,
            ports.layout);
  run.run();
  for (const Warning& w : run.flow().record().warnings()) out.remarks.push_back({w.code, w.stage, w.message, w.count});
  out.hash = summary["hash"].get<std::string>();
  json report = report_of(options, method, run, summary);
  if (method.tolerance.value > 0) {
    const auto goal = fetch(ports.goal);
    report["tolerance"] = {{"value", text_of(method.tolerance)},
                           {"patches", goal->patches},
                           {"rms_relative", goal->rms},
                           {"layouts_tried", goal->tries}};
  }
  out.report = report.dump();
  if (run.was_shortened())
    result.status = {StatusCode::shortened, "the time limit stopped the improvement of this layout", {}, -1};
  else if (!summary["valid"].get<bool>())
    result.status = {StatusCode::degraded, "a guarantee of the layout does not hold: see checks in the report", {}, -1};
}

}  // namespace

inline namespace api {

Result<Layout> layout(const TriangleMesh& mesh, const Options& options) noexcept {
  return call::guarded<Layout>([&](Result<Layout>& result) { make_layout(mesh, options, result); });
}

}  // namespace api
}  // namespace intarsia
