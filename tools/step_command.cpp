#include <chrono>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "engine/base/length.h"
#include "engine/io/write_file.h"
#include "engine/io/write_ply.h"
#include "engine/parallel/for_each.h"
#include "engine/run/context.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/read_layout.h"
#include "tools/report.h"
#include "tools/step/cad_shape.h"
#include "tools/step/fit_layout.h"
#include "tools/step/measure_model.h"
#include "tools/step/triangulate_model.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

struct StepFlags {
  std::string input, output, tolerance = "0.2%", unit = "mm", triangles;
  int threads = 0;
  bool json = false, quiet = false;
};

#ifdef INTARSIA_HAS_OPENCASCADE

const std::vector<std::string> kUnits = {"mm", "cm", "m", "in"};

constexpr Real kMillimetres[] = {1, 10, 1000, 25.4};

std::size_t unit_of(const std::string& name) {
  return static_cast<std::size_t>(std::find(kUnits.begin(), kUnits.end(), name) - kUnits.begin());
}

struct Made {
  LayoutFit fit;
  CadCheck check;
  ModelDeviation deviation;       // diagonals
  CadCheck read;                  // of the file's text, read back
  ModelDeviation read_deviation;  // diagonals
  std::vector<Index> patch_face;  // patch -> face of the model, or kNone
  Real tolerance = 0, diagonal = 1, fineness = 0;
  Real mesh_volume = 0;  // diagonals^3; 0 if the mesh has a border
  Index border_arcs = 0, arcs = 0;
  double fit_seconds = 0, build_seconds = 0;
  std::string step;
};

// Of the surface, by the divergence theorem.
Real volume_of(const MeshView& mesh) {
  Real volume = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto c = mesh.face(f);
    volume += mesh.point(c[0]).dot(mesh.point(c[1]).cross(mesh.point(c[2]))) / 6;
  }
  return volume;
}

Real tolerance_of(const StepFlags& flags, const LayoutFromFile& layout) {
  const MeshView mesh = layout.mesh;
  Real length = 0;
  for (Index e = 0; e < mesh.edge_count(); ++e)
    length += (mesh.point(mesh.edge_v0[e]) - mesh.point(mesh.edge_v1[e])).norm() / mesh.edge_count();
  const Real tolerance = parse_length(flags.tolerance).in_diagonals(layout.box.diagonal, length);
  if (!(tolerance >= 1e-5) || !(tolerance <= 0.1))
    throw Error(ErrorCode::bad_argument,
                "--tolerance " + flags.tolerance + " is not between 0.001 % and 10 % of the diagonal");
  return tolerance;
}

void write_triangles(const Work& work, const std::string& path, const ModelTriangles& t, const CadModel& model,
                     const kernels::BoxTransform& box) {
  Vec3Array point(t.x.size());
  for_each(work, Cost::light, t.x.size(), [&](std::size_t i) { point.set(i, box.to_input({t.x[i], t.y[i], t.z[i]})); });
  PlyFile ply;
  ply.element("vertex", t.x.size()).xyz<double>(point.x, point.y, point.z);
  ply.element("face", t.face.size()).triangles(t.corner).column<std::int32_t>("patch", [&](std::size_t i) {
    return model.face[t.face[i]].patch;
  });
  write_ply(work, path, ply);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr Real kReadDeflection = 0.1;  // tolerances

// What another program will see: the text as the library's reader understands it, in the library's own triangles.
void read_back(const Work& work, const LayoutFromFile& layout, Real mm, Made& made) {
  const CadShape shape = CadShape::read_step_text(made.step);
  made.read = shape.check();
  work.check();
  const CadTriangles found = shape.triangulate(kReadDeflection * mm * made.tolerance * made.diagonal);
  if (!found.empty.empty()) {
    made.read.trouble +=
        fmt::format("{}{} faces that it cannot triangulate", made.read.trouble.empty() ? "" : ", ", found.empty.size());
    made.read.valid = false;
  }
  if (found.face.empty()) return;
  Vec3Array point(found.x.size());
  const Vec3 centre = layout.box.centre;
  for_each(work, Cost::light, point.size(), [&](std::size_t i) {
    point.set(i, (Vec3(found.x[i], found.y[i], found.z[i]) / mm - centre) / made.diagonal);
  });
  // The reader's faces are in an order of their own, so this is for all of them at once.
  const std::vector<Index> all_of_mesh(layout.label.size(), 0), whole = {0}, all_of_model(found.face.size(), 0);
  const Mesh& mesh = layout.refined.mesh;
  made.read_deviation = measure_model(work, {Vec3View{mesh.x, mesh.y, mesh.z}, mesh.corner}, all_of_mesh, whole,
                                      {Vec3View{point.x, point.y, point.z}, found.corner}, all_of_model, 1);
}

Made make(const Work& work, const StepFlags& flags, const LayoutFromFile& layout, const std::string& name) {
  Made made;
  made.tolerance = tolerance_of(flags, layout);
  made.diagonal = layout.box.diagonal;
  const auto start = std::chrono::steady_clock::now();
  made.fit = fit_layout(work, layout.refined.mesh, layout.label, layout.graph, made.tolerance);
  made.fit_seconds = seconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  const CadModel& model = made.fit.model;
  if (model.face.empty()) throw Error(ErrorCode::rejected, "no patch of this layout can become a face");
  made.patch_face.assign(layout.graph.patch_count(), kNone);
  for (Index f = 0; f < model.face.size(); ++f) made.patch_face[model.face[f].patch] = f;
  for (Index a = 0; a < layout.graph.arc_count(); ++a) {
    const Index l = layout.graph.left[a], r = layout.graph.right[a];
    const auto has_face = [&](Index p) { return p != kNone && made.patch_face[p] != kNone; };
    made.arcs += has_face(l) || has_face(r) ? 1 : 0;
    made.border_arcs += l == kNone || r == kNone ? 1 : 0;
  }
  if (made.border_arcs == 0) made.mesh_volume = volume_of(layout.refined.mesh);
  const std::size_t unit = unit_of(flags.unit);
  const Real mm = kMillimetres[unit];
  const CadShape shape(model, mm * layout.box.centre, mm * made.diagonal);
  work.check();
  made.check = shape.check();
  made.check.area /= mm * mm, made.check.volume /= mm * mm * mm;
  work.check();
  made.fineness = made.tolerance / 20;
  const ModelTriangles triangles = triangulate_model(work, made.fit.layout, model, made.fineness);
  const Mesh& mesh = layout.refined.mesh;
  made.deviation = measure_model(work, {Vec3View{mesh.x, mesh.y, mesh.z}, mesh.corner}, layout.label, made.patch_face,
                                 {Vec3View{triangles.x, triangles.y, triangles.z}, triangles.corner}, triangles.face,
                                 static_cast<Index>(model.face.size()));
  if (!flags.triangles.empty()) write_triangles(work, flags.triangles, triangles, model, layout.box);
  made.step = shape.step_text(name, static_cast<CadUnit>(unit), "Intarsia " INTARSIA_VERSION);
  work.check();
  read_back(work, layout, mm, made);
  made.build_seconds = seconds_since(built);
  return made;
}

json lengths(Real value, Real diagonal) { return {{"absolute", value * diagonal}, {"percent", 100 * value}}; }

json report_of(const StepFlags& flags, const Made& m) {
  const CadModel& model = m.fit.model;
  const Real d = m.diagonal;
  json report = {{"schema", "intarsia-step"}, {"schema_version", 1}};
  report.update(version_json());
  report["input"] = flags.input, report["unit"] = flags.unit, report["diagonal"] = d;
  report["tolerance"] = lengths(m.tolerance, d);
  report["patches"] = m.patch_face.size();
  report["faces"] = m.check.faces, report["edges"] = m.check.edges, report["vertices"] = m.check.vertices;
  report["shells"] = m.check.shells, report["solids"] = m.check.solids;
  report["valid"] = m.check.valid, report["trouble"] = m.check.trouble;
  report["free_edges"] = m.check.free_edges, report["border_arcs"] = m.border_arcs;
  report["area"] = m.check.area, report["volume"] = m.check.volume;
  report["mesh_volume"] = m.mesh_volume * d * d * d;
  report["deviation"] = {{"largest", lengths(m.deviation.largest(), d)},
                         {"mesh_to_faces", lengths(m.deviation.to_face, d)},
                         {"faces_to_mesh", lengths(m.deviation.to_mesh, d)},
                         {"mean", lengths(m.deviation.mean, d)},
                         {"rms", lengths(m.deviation.rms, d)},
                         {"triangulated_within", lengths(m.fineness, d)}};
  Real gap = 0;
  for (const CadEdge& e : model.edge) gap = std::max(gap, e.tolerance);
  report["largest_gap"] = lengths(gap, d);
  const Real mm = kMillimetres[unit_of(flags.unit)];
  report["read_back"] = {{"faces", m.read.faces},
                         {"edges", m.read.edges},
                         {"vertices", m.read.vertices},
                         {"shells", m.read.shells},
                         {"solids", m.read.solids},
                         {"valid", m.read.valid},
                         {"trouble", m.read.trouble},
                         {"free_edges", m.read.free_edges},
                         {"degenerate_edges", m.read.degenerate_edges},
                         {"largest_tolerance", lengths(m.read.largest_tolerance / mm / d, d)},
                         {"mesh_to_faces", lengths(m.read_deviation.to_face, d)},
                         {"faces_to_mesh", lengths(m.read_deviation.to_mesh, d)},
                         {"deflection", lengths(kReadDeflection * m.tolerance, d)}};
  report["seconds"] = {{"fit", m.fit_seconds}, {"build", m.build_seconds}};
  std::vector<std::uint8_t> invalid(model.face.size(), 0);
  for (const Index f : m.check.invalid_face) invalid[f] = 1;
  constexpr const char* kFlattenings[] = {"projection", "stretched", "circle"};
  json rows = json::array();
  for (Index p = 0; p < m.patch_face.size(); ++p) {
    const FittedFace& fitted = m.fit.layout.face[p];
    json row = {{"patch", p}};
    const Index f = m.patch_face[p];
    if (f == kNone) {
      row["kind"] = "none", row["trouble"] = fitted.trouble;
      rows.push_back(row);
      continue;
    }
    const CadFace& face = model.face[f];
    row["kind"] = face.surface.is_plane ? "plane" : "bspline";
    if (!face.surface.is_plane) {
      row["control_points"] = {face.surface.spline.domain.u_count(), face.surface.spline.domain.v_count()};
      row["flattening"] = kFlattenings[static_cast<int>(fitted.flattening)];
    }
    Real widest = 0;
    std::size_t sides = 0;
    for (const auto& loop : face.loops)
      for (const CadSide& s : loop) widest = std::max(widest, model.edge[s.edge].tolerance), ++sides;
    const FaceDeviation& dev = m.deviation.face[f];
    row["loops"] = face.loops.size(), row["edges"] = sides, row["valid"] = invalid[f] == 0;
    row["area"] = dev.area * d * d;
    row["mesh_to_face"] = lengths(dev.to_face, d), row["face_to_mesh"] = lengths(dev.to_mesh, d);
    row["rms"] = lengths(dev.rms, d), row["gap"] = lengths(widest, d);
    row["within"] = dev.largest() <= m.tolerance;
    rows.push_back(row);
  }
  report["face_table"] = rows;
  return report;
}

// What is not as it should be; true if anything.
bool warn(const Made& m) {
  bool degraded = false;
  const auto say = [&](const std::string& text) { spdlog::warn("{}", text), degraded = true; };
  for (Index p = 0; p < m.patch_face.size(); ++p)
    if (m.patch_face[p] == kNone) say(fmt::format("patch {} is left out: {}", p, m.fit.layout.face[p].trouble));
  if (!m.check.valid)
    say(fmt::format("OpenCASCADE's check finds {} in {} faces", m.check.trouble, m.check.invalid_face.size()));
  Index beyond = 0, worst = 0;
  for (Index f = 0; f < m.deviation.face.size(); ++f) {
    if (m.deviation.face[f].largest() > m.tolerance) ++beyond;
    if (m.deviation.face[f].largest() > m.deviation.face[worst].largest()) worst = f;
  }
  if (beyond > 0)
    say(fmt::format("{} faces are beyond the tolerance; patch {} by most: {:.3g} % of the diagonal", beyond,
                    m.fit.model.face[worst].patch, 100 * m.deviation.face[worst].largest()));
  if (m.check.free_edges != m.border_arcs)
    say(fmt::format("{} free edges, but the mesh has {} arcs at its border", m.check.free_edges, m.border_arcs));
  // Of the file as it is read back, what the model itself has not.
  if (m.check.valid && !m.read.valid)
    say(fmt::format("read back, the file has {} in {} faces", m.read.trouble, m.read.invalid_face.size()));
  if (m.read.faces != m.check.faces || m.read.free_edges != m.check.free_edges || m.read.degenerate_edges > 0)
    say(fmt::format("read back, the file has {} faces, {} free edges and {} edges of no length instead of {}, {} and 0",
                    m.read.faces, m.read.free_edges, m.read.degenerate_edges, m.check.faces, m.check.free_edges));
  const Real read_most = m.read_deviation.largest();
  if (beyond == 0 && read_most > m.tolerance)
    say(fmt::format("read back, the file is {:.3g} % of the diagonal from the mesh", 100 * read_most));
  return degraded;
}

void print_text(const Made& m, const std::filesystem::path& path) {
  const Real d = m.diagonal;
  Index planes = 0;
  Real gap = 0;
  for (const CadFace& f : m.fit.model.face) planes += f.surface.is_plane ? 1 : 0;
  for (const CadEdge& e : m.fit.model.edge) gap = std::max(gap, e.tolerance);
  fmt::print("{} patches: {} faces ({} planes), {} edges, {} vertices; {} solids, {} shells, {} free edges; {}\n",
             m.patch_face.size(), m.check.faces, planes, m.check.edges, m.check.vertices, m.check.solids,
             m.check.shells, m.check.free_edges, m.check.valid ? "valid" : "NOT valid");
  fmt::print("{:<22}{:>12}{:>14}\n", "", "% of diagonal", "model units");
  for (const auto& [name, value] : {std::pair("mesh to faces", m.deviation.to_face),
                                    {"faces to mesh", m.deviation.to_mesh},
                                    {"mesh to file", m.read_deviation.to_face},
                                    {"file to mesh", m.read_deviation.to_mesh},
                                    {"RMS", m.deviation.rms},
                                    {"tolerance", m.tolerance},
                                    {"gap between faces", gap}})
    fmt::print("{:<22}{:>12.4g}{:>14.6g}\n", name, 100 * value, value * d);
  fmt::print("read back: {} faces, {} edges, {} solids, {} shells, {} free edges; {}\n", m.read.faces, m.read.edges,
             m.read.solids, m.read.shells, m.read.free_edges, m.read.valid ? "valid" : "NOT valid");
  if (m.check.solids > 0) fmt::print("volume {:.6g}, the mesh's {:.6g}\n", m.check.volume, m.mesh_volume * d * d * d);
  fmt::print("fitted in {:.2f} s, built and checked in {:.2f} s; {:.1f} MB written to {}\n", m.fit_seconds,
             m.build_seconds, static_cast<double>(m.step.size()) / 1e6, path.string());
}

int step(StepFlags& flags) {
  const std::filesystem::path output =
      flags.output.empty() ? std::filesystem::path(flags.input) / "layout.step" : std::filesystem::path(flags.output);
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  bool degraded = false;
  std::string text;
  context.execute([&] {
    const LayoutFromFile layout = read_result_folder(work, flags.input);
    const Made made = make(work, flags, layout, output.stem().string());
    text = report_of(flags, made).dump(1) + "\n";
    work.check();
    write_file_atomically(output, made.step);
    write_file_atomically(output.string() + ".json", text);
    degraded = warn(made);
    if (!flags.json && !flags.quiet) print_text(made, output);
  });
  if (flags.json) fmt::print("{}", text);
  return degraded ? kExitDegraded : kExitDone;
}

#else

int step(StepFlags&) {
  throw Error(ErrorCode::bad_argument,
              "this intarsia was built without OpenCASCADE; on Debian: apt install libocct-data-exchange-dev "
              "libocct-modeling-algorithms-dev libocct-foundation-dev (or tools/setup --step), then build again");
}

#endif

}  // namespace

void add_step_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<StepFlags>();
  CLI::App* command = app.add_subcommand("step", "write a result as a STEP file: a B-spline face for every patch");
  command->add_option("input", flags->input, "folder written by intarsia run")->required();
  command->add_option("-o,--output", flags->output,
                      "file to write, and its report beside it as FILE.json; default: "
                      "layout.step in the input");
  command
      ->add_option("--tolerance", flags->tolerance,
                   "largest distance between mesh and faces: 0.2% of the diagonal, 3e = mean edges, or model units")
      ->capture_default_str();
  command->add_option("--unit", flags->unit, "what the mesh's numbers are: mm, cm, m, in; nothing is scaled")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}))
      ->capture_default_str();
  command->add_option("--triangles", flags->triangles, "also write the triangulated faces as this PLY file");
  command->add_flag("--json", flags->json, "print the report instead of the summary");
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = step(*flags); });
}

}  // namespace intarsia::tools
