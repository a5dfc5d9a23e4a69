#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "engine/io/output_folder.h"
#include "engine/io/read_mesh.h"
#include "engine/io/write_file.h"
#include "engine/run/context.h"
#include "graph/compare_methods.h"
#include "graph/evaluate.h"
#include "tools/commands.h"
#include "tools/comparison.h"
#include "tools/comparison_picture.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/picture/png_file.h"
#include "tools/stage_command.h"
#include "tools/usual_flags.h"
#include "tools/view_flag.h"

namespace intarsia::tools {
namespace {

using graph::Method;

struct TableFlags {
  std::vector<std::string> meshes, counts, references, methods;
  std::string output;
  std::vector<double> view;
  bool rebuilt = false;
  Index patches = 40, loop_samples = 100;
  std::uint64_t samples = 400'000;
  CommonFlags common;
  OptionFlags method;
};

std::vector<std::string> method_flags() {
  std::vector<std::string> flags;
  for (const Method m : graph::all_methods()) flags.push_back(graph::short_name_of(m));
  return flags;
}

SheetOptions sheet_of(const TableFlags& flags) {
  SheetOptions options;
  if (flags.rebuilt) options.height = 330;
  options.view = chosen_view(flags.view);
  return options;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string name_of_mesh(const std::string& path) { return std::filesystem::path(path).stem().string(); }

// "mesh=value" pairs of a flag.
std::map<std::string, std::string> pairs(const TableFlags& flags, const std::vector<std::string>& given,
                                         const char* flag) {
  std::map<std::string, std::string> out;
  for (const std::string& text : given) {
    const auto at = text.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
      throw Error(ErrorCode::bad_argument,
                  fmt::format("{} {}: write MESH=VALUE, MESH as the file is named", flag, text));
    const std::string name = text.substr(0, at);
    if (std::none_of(flags.meshes.begin(), flags.meshes.end(),
                     [&](const std::string& path) { return name_of_mesh(path) == name; }))
      throw Error(ErrorCode::bad_argument, fmt::format("{} {}: there is no mesh of that name", flag, text));
    out[name] = text.substr(at + 1);
  }
  return out;
}

// Wanted patches of the meshes that have a number of their own.
std::map<std::string, Index> counts_of(const TableFlags& flags) {
  std::map<std::string, Index> out;
  for (const auto& [mesh, text] : pairs(flags, flags.counts, "--count")) {
    Index count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count == 0)
      throw Error(ErrorCode::bad_argument, fmt::format("--count {}={}: write a number of patches", mesh, text));
    out[mesh] = count;
  }
  return out;
}

// The surface's own triangles with the positions of another mesh of the same vertices.
Mesh with_positions(const graph::Surface& surface, const Soup& soup, const std::string& name) {
  Mesh mesh = surface.mesh;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index s = surface.order.vertex[v];
    if (s >= soup.vertex_count())
      throw Error(ErrorCode::bad_argument, name + ": a reference must have the vertices of its mesh, in their order");
    const Vec3 p = (Vec3(soup.x[s], soup.y[s], soup.z[s]) - surface.box.centre) / surface.box.diagonal;
    mesh.x[v] = p.x(), mesh.y[v] = p.y(), mesh.z[v] = p.z();
  }
  return mesh;
}

struct Comparison {
  std::vector<MeshNumbers> table;
  std::vector<Image> rows;
};

void compare_mesh(const Work& work, const TableFlags& flags, const graph::LayoutOptions& options,
                  const std::string& path, const std::vector<Method>& methods, Comparison& out) {
  const std::string name = name_of_mesh(path);
  graph::LayoutOptions o = options;
  const auto counts = counts_of(flags);
  o.patches = flags.patches;
  if (const auto it = counts.find(name); it != counts.end()) o.patches = it->second;
  const auto references = pairs(flags, flags.references, "--reference");
  if (references.contains(name)) o.split_uneven = false;  // the reference has no places for new vertices
  const graph::Prepared prepared = graph::prepare(work, read_mesh(work, path), o);
  Mesh against;
  MeshNumbers numbers;
  if (const auto it = references.find(name); it != references.end()) {
    against = with_positions(prepared.surface, read_mesh(work, it->second), it->second);
    numbers.reference = std::filesystem::path(it->second).stem().string();
  }
  const MeshView target = numbers.reference.empty() ? prepared.surface.mesh.view() : against.view();
  numbers.mesh = name, numbers.triangles = prepared.surface.mesh.face_count(), numbers.wanted = o.patches;
  numbers.diagonal = prepared.surface.box.diagonal;
  graph::EvaluateOptions evaluate;
  evaluate.sample.loop_samples = flags.loop_samples;
  evaluate.distance.samples = flags.samples;
  evaluate.make_triangulated_area = true;
  std::vector<DrawnMethod> drawn;
  for (const Method method : methods) {
    work.check();
    const double start = now();
    DrawnMethod d;
    d.layout = graph::layout_by(work, prepared, method, o);
    const double seconds = now() - start;
    d.evaluation =
        graph::evaluate(work, target, d.layout.refined, d.layout.labels.patch_of_face, d.layout.graph, evaluate);
    MethodNumbers m = numbers_of(d.evaluation);
    m.method = graph::short_name_of(method), m.name = graph::name_of(method), m.seconds = seconds;
    if (!flags.common.quiet)
      fmt::print(
          "{:<14} {:<27} {:>3} patches  triangulated H {:6.2f} R {:6.3f}  filled H {:6.2f} R {:6.3f}  q {:.2f}  "
          "{:.1f} s\n",
          name, m.name, m.patches, 1e3 * m.triangulated.hausdorff, 1e3 * m.triangulated.rms, 1e3 * m.filled.hausdorff,
          1e3 * m.filled.rms, m.q_median, m.seconds);
    numbers.methods.push_back(std::move(m));
    drawn.push_back(std::move(d));
  }
  out.rows.push_back(draw_comparison(work, prepared.surface, numbers, drawn, flags.rebuilt, sheet_of(flags)));
  out.table.push_back(std::move(numbers));
}

int table1(const TableFlags& flags) {
  const graph::LayoutOptions options = flags.method.options(flags.common);
  // What is wrong is said before anything is computed.
  counts_of(flags);
  pairs(flags, flags.references, "--reference");
  for (const std::string& mesh : flags.meshes)
    if (!std::filesystem::exists(mesh)) read_mesh(Work(), mesh);
  RunContext context(settings_of(flags.common), &interrupt_flag());
  std::vector<Method> methods;
  std::vector<std::string> names;
  for (const std::string& flag : flags.methods.empty() ? method_flags() : flags.methods)
    for (const Method m : graph::all_methods())
      if (graph::short_name_of(m) == flag) methods.push_back(m), names.push_back(graph::name_of(m));
  OutputFolder folder(flags.output, {"table1.md", "table1.csv", "table1.json", "table1.png"});
  Comparison comparison;
  const Work work = context.work();
  context.execute([&] {
    for (const std::string& mesh : flags.meshes) compare_mesh(work, flags, options, mesh, methods, comparison);
  });
  const std::string how = fmt::format(
      "{} patches where no other number is named; arcs in even steps, at most about {} points a loop; {} "
      "distance samples; the same smoothing, sampling and reconstruction for all.",
      flags.patches, flags.loop_samples, flags.samples);
  const std::string markdown = comparison_markdown(comparison.table, how);
  write_file_atomically(folder.file("table1.md"), markdown);
  write_file_atomically(folder.file("table1.csv"), comparison_csv(comparison.table));
  write_file_atomically(folder.file("table1.json"), comparison_json(comparison.table).dump(1) + "\n");
  write_png(folder.file("table1.png"), join_comparisons(comparison.rows, names, sheet_of(flags)));
  folder.commit();
  if (!flags.common.quiet)
    fmt::print("\n{}\nwritten to {}: table1.md table1.csv table1.json table1.png\n",
               markdown.substr(0, markdown.find("H: Hausdorff")), (folder.target() / "").string());
  return kExitDone;
}

}  // namespace

void add_table1_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<TableFlags>();
  CLI::App* command =
      app.add_subcommand("table1", "the paper's Table 1: our layouts and other methods, rebuilt and measured");
  command->add_option("meshes", flags->meshes, "meshes: .ply .obj .stl .off")->required();
  command->add_option("-o,--output", flags->output, "folder for table1.md, .csv, .json, .png")->required();
  command->add_option("-n,--patches", flags->patches, "patches of every method")
      ->check(whole_number(1, kNone - 1))
      ->capture_default_str();
  command->add_option("--count", flags->counts, "MESH=N: another number of patches for one mesh");
  command->add_option("--reference", flags->references,
                      "MESH=FILE: measure against FILE (same vertices, in order) and leave out of the means");
  command->add_option("--methods", flags->methods, "only these, in this order")
      ->check(CLI::IsMember(method_flags()))
      ->delimiter(',');
  command->add_option("--loop-samples", flags->loop_samples, "points of a patch border at most, about")
      ->check(CLI::Range(12, 400))
      ->capture_default_str();
  command->add_option("--samples", flags->samples, "distance samples")
      ->check(CLI::Range(1000, 20'000'000))
      ->capture_default_str();
  command->add_flag("--rebuilt", flags->rebuilt, "draw the triangulated and filled surfaces below the layouts");
  add_view_flag(*command, flags->view);
  add_common_flags(*command, flags->common);
  flags->method.add_to(*command);
  command->callback([flags, &exit_code] { exit_code = table1(*flags); });
}

}  // namespace intarsia::tools
