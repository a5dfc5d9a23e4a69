#include "graph/layout_report.h"

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

namespace intarsia::graph {
namespace {

using nlohmann::json;

json patch_table(const Layout& layout, Real diagonal) {
  const PatchTable& t = layout.table;
  json rows = json::array();
  for (Index p = 0; p < t.count(); ++p) {
    const Real area = t.area[p] * diagonal * diagonal, perimeter = t.perimeter[p] * diagonal;
    rows.push_back({{"patch", p},
                    {"faces", t.faces[p]},
                    {"area", area},
                    {"perimeter", perimeter},
                    {"compactness", area > 0 ? perimeter * perimeter / (4 * std::numbers::pi * area) : 0},
                    {"flatness", t.area[p] > 0 ? t.normal_sum[p].norm() / t.area[p] : 1},
                    {"loops", t.loops[p]},
                    {"filled_holes", t.filled_holes[p]},
                    {"disc", t.is_disc(p)}});
  }
  return rows;
}

json checks_of(const Layout& layout) {
  json rows = json::array();
  for (const kernels::LayoutCheck& c : layout.checks.checks) {
    json row = {{"name", c.name}, {"passed", c.passed()}, {"failures", c.count}, {"warning_only", c.is_warning}};
    if (!c.passed()) row["example"] = {{"element", c.element}, {"id", c.example}};
    rows.push_back(std::move(row));
  }
  return rows;
}

json arcs_by_kind(const Layout& layout, Real diagonal) {
  json rows;
  for (int k = 0; k < kCurveKinds; ++k) {
    Index arcs = 0;
    Real length = 0;
    for (Index a = 0; a < layout.graph.arc_count(); ++a)
      if (static_cast<int>(layout.graph.kind[a]) == k) ++arcs, length += layout.graph.length[a];
    rows[kKindNames[static_cast<std::size_t>(k)]] = {{"arcs", arcs}, {"length", length * diagonal}};
  }
  return rows;
}

}  // namespace

void add_layout_report(json& report, const Soup& soup, const Surface& surface, const Network& network,
                       const Layout& layout, Index wanted_patches) {
  const Real diagonal = surface.box.diagonal;
  report["input"]["vertices"] = soup.vertex_count();
  report["input"]["triangles"] = soup.face_count();
  report["input"]["diagonal"] = diagonal;
  report["input"]["mean_edge"] = surface.mean_edge * diagonal;
  Index not_discs = 0;
  for (Index p = 0; p < layout.table.count(); ++p) not_discs += layout.table.is_disc(p) ? 0 : 1;
  report["counts"] = json::object({{"patches", layout.labels.count},
                                   {"wanted_patches", wanted_patches == 0 ? json(nullptr) : json(wanted_patches)},
                                   {"arcs", layout.graph.arc_count()},
                                   {"nodes", layout.graph.node_count()},
                                   {"interior_curves", layout.interior.curve_count()},
                                   {"not_discs", not_discs},
                                   {"feature_curves", network.features.curve_count()},
                                   {"network_patches", network.patches},
                                   {"loose_ends", network.ends},
                                   {"ends_met", network.met},
                                   {"ends_bridged", network.bridged},
                                   {"ends_pruned", network.dead},
                                   {"unsmoothed_arcs", layout.kept_chains}});
  report["automatic"] = {{"min_saliency", network.min_saliency}};
  report["checks"] = checks_of(layout);
  report["valid"] = layout.checks.is_valid();
  report["area_error"] = layout.checks.area_error;
  report["arcs_by_kind"] = arcs_by_kind(layout, diagonal);
  report["patches"] = patch_table(layout, diagonal);
  report["hash"] = hex_text(hash_of(layout));
}

}  // namespace intarsia::graph
