#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/length.h"
#include "engine/io/read_labels.h"
#include "engine/run/context.h"
#include "kernels/quality/line_match.h"
#include "kernels/quality/segmentation_metrics.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/read_layout.h"
#include "tools/report.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

struct CompareFlags {
  std::string a, b, property = "patch";
  int threads = 0;
  bool json = false, exact = false;
};

struct Side {
  LayoutFromFile layout;
  std::vector<Index> label;  // per triangle of the input
  Index count = 0;
  kernels::Segments borders;  // in the user's coordinates, without the boundary of the surface
};

Side read_side(const Work& work, const std::string& path, const std::string& property) {
  Side side;
  const bool is_folder = std::filesystem::is_directory(path);
  side.layout = is_folder ? read_result_folder(work, path) : read_labelled_mesh(work, {path, {}, property, false});
  const LayoutFromFile& l = side.layout;
  if (is_folder) {
    const std::string file = (std::filesystem::path(path) / "patches.ply").string();
    side.count = number_labels(
        labels_of_triangles(file, read_face_labels(work, file, "patch"), l.soup.source_face, l.soup.face_count()),
        side.label);
  } else {
    side.label = l.label, side.count = l.graph.patch_count();
  }
  const MeshView mesh = l.refined.mesh;
  side.borders.point.resize(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) side.borders.point.set(v, l.box.to_input(mesh.point(v)));
  for (Index a = 0; a < l.graph.arc_count(); ++a) {
    if (l.graph.kind[a] == CurveKind::border) continue;
    const auto row = l.graph.arc.row(a);
    for (std::size_t i = 1; i < row.size(); ++i)
      side.borders.end.push_back(row[i - 1]), side.borders.end.push_back(row[i]);
  }
  return side;
}

std::vector<Real> face_areas(const MeshView& mesh) {
  std::vector<Real> area(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.face(f);
    area[f] = 0.5 * (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).norm();
  }
  return area;
}

// For each patch of `of` the patch of `in` that shares most area with it; what they share of what either covers.
json best_matches(const Side& of, const Side& in, const std::vector<Real>& face_area) {
  std::vector<std::pair<std::pair<Index, Index>, Real>> shared;
  std::vector<Real> of_area(of.count, 0), in_area(in.count, 0);
  for (Index f = 0; f < face_area.size(); ++f) {
    shared.push_back({{of.label[f], in.label[f]}, face_area[f]});
    of_area[of.label[f]] += face_area[f], in_area[in.label[f]] += face_area[f];
  }
  std::stable_sort(shared.begin(), shared.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::pair<Real, Index>> best(of.count, {0, kNone});
  for (std::size_t i = 0; i < shared.size();) {
    const auto [p, q] = shared[i].first;
    Real common = 0;
    for (; i < shared.size() && shared[i].first == std::pair(p, q); ++i) common += shared[i].second;
    const Real either = of_area[p] + in_area[q] - common, overlap = either > 0 ? common / either : 0;
    if (best[p].second == kNone || overlap > best[p].first) best[p] = {overlap, q};
  }
  json rows = json::array();
  for (Index p = 0; p < of.count; ++p)
    if (best[p].second != kNone) rows.push_back({{"patch", p}, {"other", best[p].second}, {"overlap", best[p].first}});
  return rows;
}

Real length_of(const kernels::Segments& lines) {
  Real length = 0;
  for (std::size_t i = 0; i < lines.end.size(); i += 2)
    length += (lines.point[lines.end[i]] - lines.point[lines.end[i + 1]]).norm();
  return length;
}

json line_json(const kernels::LineDistance& d, Real unit) {
  json row = {{"length", d.length}, {"mean", d.mean}, {"median", d.median}, {"p90", d.high}, {"largest", d.largest}};
  row["relative"] = {
      {"mean", d.mean / unit}, {"median", d.median / unit}, {"p90", d.high / unit}, {"largest", d.largest / unit}};
  return row;
}

json compare_sides(const Work& work, const CompareFlags& flags, const Side& a, const Side& b) {
  json report = {{"schema", "intarsia-compare"}, {"schema_version", 1}};
  report.update(version_json());
  const auto side_json = [](const std::string& path, const Side& s) {
    return json{{"path", path},
                {"triangles", s.layout.soup.face_count()},
                {"patches", s.layout.graph.patch_count()},
                {"arcs", s.layout.graph.arc_count()},
                {"border_length", length_of(s.borders)}};
  };
  const Real diagonal = a.layout.box.diagonal;
  report["a"] = side_json(flags.a, a), report["b"] = side_json(flags.b, b);
  report["diagonal"] = diagonal;
  const bool same_mesh = a.layout.soup.corner == b.layout.soup.corner;
  report["same_triangles"] = same_mesh;
  report["identical_labels"] = same_mesh && a.label == b.label;
  if (same_mesh) {
    const std::vector<Real> area = face_areas(a.layout.mesh);
    const kernels::LabelMetrics m = kernels::compare_labels(work, area, {a.label, a.count}, {b.label, b.count});
    report["labels"] = {{"rand_error", m.rand_error}, {"hamming", m.hamming}, {"gce", m.gce}, {"lce", m.lce}};
    report["patches"] = best_matches(a, b, area);
    Index same = 0;
    constexpr Real kSame = 0.9;
    for (const json& row : report["patches"]) same += row["overlap"].get<Real>() >= kSame ? 1 : 0;
    report["labels"]["same_patches"] = same;
  }
  if (a.borders.count() > 0 && b.borders.count() > 0) {
    const Real step = 1e-3 * diagonal;
    report["a_to_b"] = line_json(kernels::line_distance(work, a.borders, b.borders, step), diagonal);
    report["b_to_a"] = line_json(kernels::line_distance(work, b.borders, a.borders, step), diagonal);
  }
  return report;
}

void print_text(const json& r) {
  for (const char* side : {"a", "b"})
    fmt::print("{}: {} patches, {} arcs, {:.6g} of borders   {}\n", side, r[side]["patches"].get<Index>(),
               r[side]["arcs"].get<Index>(), r[side]["border_length"].get<Real>(), r[side]["path"].get<std::string>());
  if (r["identical_labels"].get<bool>()) fmt::print("the labels of all triangles are the same\n");
  if (r.contains("labels")) {
    const json& l = r["labels"];
    fmt::print("{} of a's {} patches are in b too (90 % of what either covers)\n", l["same_patches"].get<Index>(),
               r["patches"].size());
    fmt::print("labels: Rand error {:.4f}, Hamming {:.4f}, global consistency error {:.4f}\n",
               l["rand_error"].get<Real>(), l["hamming"].get<Real>(), l["gce"].get<Real>());
  } else {
    fmt::print("the meshes differ, so only borders are compared\n");
  }
  if (!r.contains("a_to_b")) return;
  fmt::print("{:<18}{:>12}{:>12}{:>12}{:>12}\n", "borders, % of diag", "mean", "median", "90 %", "largest");
  for (const auto& [key, name] : {std::pair("a_to_b", "a to b"), std::pair("b_to_a", "b to a")}) {
    const json& d = r[key]["relative"];
    fmt::print("{:<18}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}\n", name, 100 * d["mean"].get<Real>(),
               100 * d["median"].get<Real>(), 100 * d["p90"].get<Real>(), 100 * d["largest"].get<Real>());
  }
}

int compare(const CompareFlags& flags) {
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  json report;
  context.execute([&] {
    const Side a = read_side(work, flags.a, flags.property), b = read_side(work, flags.b, flags.property);
    report = compare_sides(work, flags, a, b);
  });
  if (flags.json)
    fmt::print("{}\n", report.dump(1));
  else
    print_text(report);
  return flags.exact && !report["identical_labels"].get<bool>() ? kExitDegraded : kExitDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* command = app.add_subcommand("compare", "two layouts: how far their labels and borders agree");
  command->add_option("a", flags->a, "folder written by intarsia run, or a mesh with labels")->required();
  command->add_option("b", flags->b, "the same; of the same mesh or of another sampling of the shape")->required();
  command->add_option("--property", flags->property, "face property that holds labels in .ply files")
      ->capture_default_str();
  command->add_flag("--exact", flags->exact, "exit status 5 unless every triangle has the same label in both");
  command->add_flag("--json", flags->json, "print the report as JSON, with the best match of every patch");
  add_threads_flag(*command, flags->threads);
  command->callback([flags, &exit_code] { exit_code = compare(*flags); });
}

}  // namespace intarsia::tools
