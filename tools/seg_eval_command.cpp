#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/for_each.h"
#include "engine/run/context.h"
#include "kernels/quality/line_match.h"
#include "kernels/quality/segmentation_metrics.h"
#include "kernels/surface/normalise_box.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/report.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

using kernels::LineMatch;
using kernels::Segmentation;
using kernels::Segments;
using nlohmann::json;

struct SegEvalFlags {
  std::string mesh, labels, layout, brep, property = "patch";
  std::vector<std::string> references;
  double tolerance = 0.01, bend = 10;
  int threads = 0;
  bool json = false;
};

struct Labels {
  std::vector<Index> label;
  Index count = 0;
  Segmentation view() const { return {label, count}; }
};

struct Case {
  Soup soup;
  Mesh mesh;  // in the user's coordinates
  std::vector<Real> area;
  Real diagonal = 1;
};

Case read_case(const Work& work, const std::string& path) {
  Case c;
  c.soup = read_mesh(work, path);
  for (Index f = 0; f < c.soup.face_count(); ++f) {
    const Index* v = &c.soup.corner[3 * std::size_t{f}];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      throw Error(ErrorCode::rejected, fmt::format("{}: triangle {} has a repeated corner; clean the mesh", path, f),
                  f);
  }
  c.mesh.x = c.soup.x, c.mesh.y = c.soup.y, c.mesh.z = c.soup.z, c.mesh.corner = c.soup.corner;
  connect_mesh(work, c.mesh);
  c.diagonal = kernels::normalise_box(work, c.soup).diagonal;
  c.area.resize(c.mesh.face_count());
  const MeshView mesh = c.mesh;
  for_each(work, Cost::light, c.area.size(), [&](std::size_t f) {
    const auto [a, b, d] = mesh.face(static_cast<Index>(f));
    const Vec3 p = mesh.point(a);
    c.area[f] = 0.5 * (mesh.point(b) - p).cross(mesh.point(d) - p).norm();
  });
  return c;
}

Labels read_labels(const Work& work, const Case& c, const std::string& path, const std::string& property) {
  const std::vector<int> of_file = read_face_labels(work, path, property);
  Labels labels;
  labels.count =
      number_labels(labels_of_triangles(path, of_file, c.soup.source_face, c.soup.face_count()), labels.label);
  return labels;
}

Segments segments_of_edges(const MeshView& mesh, const std::vector<Index>& edge) {
  Segments s;
  s.point.x.assign(mesh.x.begin(), mesh.x.end()), s.point.y.assign(mesh.y.begin(), mesh.y.end());
  s.point.z.assign(mesh.z.begin(), mesh.z.end());
  for (const Index e : edge) s.end.push_back(mesh.edge_v0[e]), s.end.push_back(mesh.edge_v1[e]);
  return s;
}

// Arcs of a layout's network, without the boundary of the surface; only ridges, valleys and sharp edges if asked for.
Segments segments_of_layout(const Work& work, const std::string& folder, bool features_only) {
  const Soup refined = read_mesh(work, std::filesystem::path(folder) / "layout.ply");
  const std::filesystem::path path = std::filesystem::path(folder) / "network.json";
  Segments s;
  s.point.x = refined.x, s.point.y = refined.y, s.point.z = refined.z;
  try {
    std::ifstream file(path);
    const json network = json::parse(file);
    for (const json& arc : network.at("arcs")) {
      const int kind = arc.at("kind").get<int>();
      if (kind == 3 || (features_only && kind > 2)) continue;
      const auto vertex = arc.at("vertices").get<std::vector<Index>>();
      for (std::size_t i = 1; i < vertex.size(); ++i) {
        if (vertex[i - 1] >= refined.vertex_count() || vertex[i] >= refined.vertex_count())
          throw Error(ErrorCode::bad_file, path.string() + ": names vertices that layout.ply does not have");
        s.end.push_back(vertex[i - 1]), s.end.push_back(vertex[i]);
      }
    }
  } catch (const json::exception& e) {
    throw Error(ErrorCode::bad_file, path.string() + ": is no network of a layout (" + e.what() + ")");
  }
  return s;
}

// Angle between the normals of an edge's faces, degrees.
Real bend_of(const MeshView& mesh, Index e) {
  const auto normal = [&](Index f) {
    const auto [a, b, c] = mesh.face(f);
    return Vec3((mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)));
  };
  const Vec3 m = normal(mesh.edge_f0[e]), n = normal(mesh.edge_f1[e]);
  return std::atan2(m.cross(n).norm(), m.dot(n)) * 180 / std::numbers::pi;
}

json brep_report(const Work& work, const Case& c, const SegEvalFlags& flags, const Labels& candidate) {
  const Labels brep = read_labels(work, c, flags.brep, flags.property);
  const std::vector<Index> border = kernels::border_edges(work, c.mesh, brep.label);
  std::vector<Index> bent;
  for (const Index e : border)
    if (bend_of(c.mesh, e) >= flags.bend) bent.push_back(e);
  const Segments all = segments_of_edges(c.mesh, border), creases = segments_of_edges(c.mesh, bent);
  const Segments ours = flags.layout.empty()
                            ? segments_of_edges(c.mesh, kernels::border_edges(work, c.mesh, candidate.label))
                            : segments_of_layout(work, flags.layout, false);
  const Real near = flags.tolerance * c.diagonal;
  const LineMatch precision = kernels::match_lines(work, ours, all, near),
                  recall = kernels::match_lines(work, all, ours, near),
                  crease_recall = kernels::match_lines(work, creases, ours, near);
  json report = {{"path", flags.brep},
                 {"faces", brep.count},
                 {"tolerance", flags.tolerance},
                 {"precision", precision.share()},
                 {"recall", recall.share()},
                 {"crease_recall", crease_recall.share()},
                 {"crease_angle", flags.bend},
                 {"network_length", precision.length},
                 {"border_length", recall.length},
                 {"crease_length", crease_recall.length}};
  if (!flags.layout.empty()) {
    const LineMatch features = kernels::match_lines(work, segments_of_layout(work, flags.layout, true), all, near);
    report["feature_precision"] = features.share(), report["feature_length"] = features.length;
  }
  return report;
}

json reference_report(const Work& work, const Case& c, const Labels& candidate, const Labels& reference) {
  const kernels::LabelMetrics m = kernels::compare_labels(work, c.area, candidate.view(), reference.view());
  const auto cut = kernels::cut_discrepancy(work, c.mesh, candidate.view(), reference.view());
  json row = {{"segments", reference.count},
              {"missing_rate", m.missing_rate},
              {"false_alarm", m.false_alarm},
              {"hamming", m.hamming},
              {"rand_error", m.rand_error},
              {"gce", m.gce},
              {"lce", m.lce}};
  row["cut_discrepancy"] = cut ? json(cut->value()) : json(nullptr);
  return row;
}

constexpr const char* kMeasure[] = {"cut_discrepancy", "hamming", "missing_rate", "false_alarm",
                                    "rand_error",      "gce",     "lce"};

json mean_of(const json& rows) {
  json mean;
  for (const char* name : kMeasure) {
    Real total = 0;
    int count = 0;
    for (const json& row : rows)
      if (!row[name].is_null()) total += row[name].get<Real>(), ++count;
    mean[name] = count > 0 ? json(total / count) : json(nullptr);
  }
  return mean;
}

void print_text(const json& report) {
  fmt::print("{} segments\n", report["segments"].get<int>());
  if (report.contains("references")) {
    fmt::print("{:<24}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "reference", "segments", "cut", "Hamming", "missing",
               "false", "Rand", "GCE", "LCE");
    const auto row = [](const std::string& name, const json& r) {
      fmt::print("{:<24}{:>9}", name, r.contains("segments") ? r["segments"].dump() : "");
      for (const char* measure : kMeasure)
        fmt::print("{:>9}", r[measure].is_null() ? "-" : fmt::format("{:.4f}", r[measure].get<Real>()));
      fmt::print("\n");
    };
    for (const json& r : report["references"])
      row(std::filesystem::path(r["path"].get<std::string>()).filename().string(), r);
    row("mean", report["mean"]);
  }
  if (report.contains("brep")) {
    const json& b = report["brep"];
    fmt::print(
        "within {:g} % of the diagonal: {:.1f} % of the network lies on borders between the {} faces of the solid",
        100 * b["tolerance"].get<Real>(), 100 * b["precision"].get<Real>(), b["faces"].get<int>());
    if (b.contains("feature_precision"))
      fmt::print(" ({:.1f} % of ridges, valleys and sharp edges)", 100 * b["feature_precision"].get<Real>());
    fmt::print(";\n{:.1f} % of the borders lie on the network, {:.1f} % of those that bend by {:g} degrees\n",
               100 * b["recall"].get<Real>(), 100 * b["crease_recall"].get<Real>(), b["crease_angle"].get<Real>());
  }
}

int seg_eval(const SegEvalFlags& flags) {
  if (flags.labels.empty() && flags.layout.empty())
    throw Error(ErrorCode::bad_argument, "give what to judge: --labels FILE or --layout FOLDER");
  if (flags.references.empty() && flags.brep.empty())
    throw Error(ErrorCode::bad_argument, "give what to judge by: --reference FILE... or --brep FILE");
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  json report = {{"schema", "intarsia-segmentation"}, {"schema_version", 1}};
  report.update(version_json());
  context.execute([&] {
    const Case c = read_case(work, flags.mesh);
    const std::string source =
        flags.labels.empty() ? (std::filesystem::path(flags.layout) / "patches.ply").string() : flags.labels;
    const Labels candidate = read_labels(work, c, source, flags.property);
    report["mesh"] = flags.mesh, report["labels"] = source, report["segments"] = candidate.count;
    report["diagonal"] = c.diagonal;
    json rows = json::array();
    for (const std::string& path : flags.references) {
      rows.push_back(reference_report(work, c, candidate, read_labels(work, c, path, flags.property)));
      rows.back()["path"] = path;
    }
    if (!rows.empty()) report["mean"] = mean_of(rows), report["references"] = std::move(rows);
    if (!flags.brep.empty()) report["brep"] = brep_report(work, c, flags, candidate);
  });
  if (flags.json)
    fmt::print("{}\n", report.dump(1));
  else
    print_text(report);
  return kExitDone;
}

}  // namespace

void add_seg_eval_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<SegEvalFlags>();
  CLI::App* command =
      app.add_subcommand("seg-eval", "a segmentation against others of the same mesh, or against a solid");
  command->add_option("mesh", flags->mesh, "mesh: .ply .obj .stl .off")->required();
  command->add_option("--labels", flags->labels, "what to judge: .seg (one label a line) or .ply with a face property");
  command->add_option("--layout", flags->layout, "what to judge: output folder of intarsia run");
  command->add_option("--reference", flags->references, "segmentations to compare with, .seg or .ply")->expected(1, -1);
  command->add_option("--brep", flags->brep, "faces of the solid that the mesh was made from, .seg or .ply");
  command->add_option("--property", flags->property, "face property that holds labels in .ply files")
      ->capture_default_str();
  command->add_option("--tolerance", flags->tolerance, "of --brep: how near lines must be, diagonals")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--crease-angle", flags->bend, "of --brep: borders that bend less count as no creases, degrees")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->add_flag("--json", flags->json, "print the report as JSON");
  add_threads_flag(*command, flags->threads);
  command->callback([flags, &exit_code] { exit_code = seg_eval(*flags); });
}

}  // namespace intarsia::tools
