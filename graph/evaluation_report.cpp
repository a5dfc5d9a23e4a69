#include "graph/evaluation_report.h"

#include <nlohmann/json.hpp>

namespace intarsia::graph {
namespace {

using nlohmann::json;

const char* metric_name(PolygonMetric metric) {
  switch (metric) {
    case PolygonMetric::area:
      return "area";
    case PolygonMetric::area_bend:
      return "area-bend";
    case PolygonMetric::squared_dihedral:
      return "squared-dihedral";
    case PolygonMetric::worst_dihedral:
      return "worst-dihedral";
  }
  return "";
}

json distances(Real max, Real mean, Real rms, Real unit) {
  return {{"hausdorff", unit * max}, {"mean", unit * mean}, {"rms", unit * rms}};
}

json rebuilt_json(const Rebuilt& r, Real diagonal) {
  const kernels::SurfaceDistance& d = r.distance;
  json out = distances(d.hausdorff(), d.mean(), d.rms(), 1);
  out["absolute"] = distances(d.hausdorff(), d.mean(), d.rms(), diagonal);
  out["forward"] = distances(d.forward.max, d.forward.mean, d.forward.rms, 1);
  out["backward"] = distances(d.backward.max, d.backward.mean, d.backward.rms, 1);
  out["triangles"] = r.surface.patch.size();
  out["bridged"] = r.surface.bridged_count();
  out["failed"] = r.failed;
  out["cut"] = r.surface.cut_count();
  return out;
}

json settings_json(const EvaluateOptions& o) {
  return {{"loop_samples", o.sample.loop_samples},
          {"least_closed", o.sample.least_closed},
          {"metric", metric_name(o.triangulated.polygon.metric)},
          {"bend_weight", o.triangulated.polygon.bend_weight},
          {"exact", o.triangulated.polygon.exact},
          {"bridges", o.triangulated.bridges},
          {"transfinite",
           {{"most_sides", o.transfinite.most_sides},
            {"straight_degrees", o.transfinite.straight},
            {"guard", o.transfinite.guard}}},
          {"filled",
           {{"step", o.filled.step},
            {"most_inner", o.filled.most_inner},
            {"flat_rounds", o.filled.flat_rounds},
            {"bent_rounds", o.filled.bent_rounds},
            {"guard", o.filled.guard},
            {"normals", o.filled.use_normals}}},
          {"distance_samples", o.distance.samples}};
}

}  // namespace

nlohmann::json evaluation_json(const Evaluation& e, const EvaluateOptions& options, Real diagonal) {
  json out = {{"diagonal", diagonal}, {"patches", e.patches}, {"not_discs", e.not_discs}, {"samples", e.samples}};
  out["compactness"] = {
      {"median", e.compactness.median}, {"percentile_90", e.compactness.high}, {"max", e.compactness.most}};
  for (const auto& [name, rebuilt] : e.made()) out[name] = rebuilt_json(*rebuilt, diagonal);
  json rows = json::array();
  for (Index p = 0; p < e.patches; ++p) {
    json row = {{"patch", p}, {"compactness", e.compactness.patch[p]}};
    for (const auto& [name, rebuilt] : e.made())
      row[name] = {{"rms", rebuilt->patch[p].rms}, {"max", rebuilt->patch[p].max}};
    rows.push_back(std::move(row));
  }
  out["patch_table"] = std::move(rows);
  out["settings"] = settings_json(options);
  return out;
}

}  // namespace intarsia::graph
