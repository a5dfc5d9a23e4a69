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
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/option_flags.h"
#include "tools/picture/palette.h"
#include "tools/picture/png_file.h"
#include "tools/picture/strip.h"

namespace intarsia::tools {
namespace {

using graph::Method;

struct TableFlags {
  std::vector<std::string> meshes, counts, references, methods;
  std::string output;
  Index patches = 40, loop_samples = 100;
  std::uint64_t samples = 400'000;
  CommonFlags common;
  OptionFlags method;
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// "name=value" pairs of a flag.
std::map<std::string, std::string> pairs(const std::vector<std::string>& given, const char* flag) {
  std::map<std::string, std::string> out;
  for (const std::string& text : given) {
    const auto at = text.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
      throw Error(ErrorCode::bad_argument,
                  fmt::format("{} {}: write MESH=VALUE, MESH as the file is named", flag, text));
    out[text.substr(0, at)] = text.substr(at + 1);
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

// What of a layout is drawn.
struct Drawn {
  graph::Layout layout;
  std::vector<Rgb> colour;
  Lines borders;
  std::string title, caption;
};

Image draw_row(const Work& work, const graph::Surface& surface, const std::string& mesh,
               const std::vector<Drawn>& drawn) {
  Strip strip;
  strip.options.width = 300, strip.options.height = 280, strip.options.legend = false;
  strip.add({.title = mesh,
             .caption = fmt::format("{} triangles", surface.mesh.face_count()),
             .shape = shape_of(surface.mesh.view()),
             .lines = {}});
  for (const Drawn& d : drawn) {
    Shape shape = shape_of(d.layout.refined.mesh.view());
    shape.face_label = d.layout.labels.patch_of_face;
    shape.label_colour = d.colour;
    strip.add({.title = d.title, .caption = d.caption, .shape = shape, .lines = d.borders});
  }
  return draw_strip(work, strip);
}

Image stack(const std::vector<Image>& rows) {
  int width = 1, height = 0;
  for (const Image& r : rows) width = std::max(width, r.width), height += r.height;
  Image out(width, std::max(1, height));
  int top = 0;
  for (const Image& r : rows) {
    for (int y = 0; y < r.height; ++y)
      for (int x = 0; x < r.width; ++x) out.at(x, top + y) = r.at(x, y);
    top += r.height;
  }
  return out;
}

struct Comparison {
  std::vector<MeshNumbers> table;
  std::vector<Image> rows;
};

void compare_mesh(const Work& work, const TableFlags& flags, const graph::LayoutOptions& options,
                  const std::string& path, const std::vector<Method>& methods, Comparison& out) {
  const std::string name = std::filesystem::path(path).stem().string();
  graph::LayoutOptions o = options;
  const auto counts = pairs(flags.counts, "--count");
  o.patches = flags.patches;
  if (const auto it = counts.find(name); it != counts.end()) o.patches = static_cast<Index>(std::stoul(it->second));
  const graph::Prepared prepared = graph::prepare(work, read_mesh(work, path), o);
  const auto references = pairs(flags.references, "--reference");
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
  std::vector<Drawn> drawn;
  for (const Method method : methods) {
    work.check();
    const double start = now();
    Drawn d;
    d.layout = graph::layout_by(work, prepared, method, o);
    const double seconds = now() - start;
    const graph::Evaluation e =
        graph::evaluate(work, target, d.layout.refined, d.layout.labels.patch_of_face, d.layout.graph, evaluate);
    MethodNumbers m = numbers_of(e);
    m.method = graph::short_name_of(method), m.name = graph::name_of(method), m.seconds = seconds;
    d.title = m.name;
    d.caption = fmt::format("R {:.2f} q {:.1f}", 1e3 * m.triangulated.rms, m.q_median);
    d.colour = patch_colours(
        work, adjacent_patches(work, d.layout.refined.mesh, d.layout.labels.patch_of_face, d.layout.labels.count));
    d.borders = restyled(lines_of(d.layout.refined.mesh, d.layout.refined.on_network, d.layout.refined.edge_kind),
                         LineStyle{{44, 44, 50}, 1.0f});
    if (!flags.common.quiet)
      fmt::print(
          "{:<14} {:<27} {:>3} patches  triangulated H {:6.2f} R {:6.3f}  filled H {:6.2f} R {:6.3f}  q {:.2f}  "
          "{:.1f} s\n",
          name, m.name, m.patches, 1e3 * m.triangulated.hausdorff, 1e3 * m.triangulated.rms, 1e3 * m.filled.hausdorff,
          1e3 * m.filled.rms, m.q_median, m.seconds);
    numbers.methods.push_back(std::move(m));
    drawn.push_back(std::move(d));
  }
  out.rows.push_back(draw_row(work, prepared.surface, name, drawn));
  out.table.push_back(std::move(numbers));
}

int table1(const TableFlags& flags) {
  const graph::LayoutOptions options = flags.method.options(flags.common);
  RunSettings settings;
  settings.threads = flags.common.threads, settings.seed = flags.common.seed;
  RunContext context(settings, &interrupt_flag());
  std::vector<Method> methods;
  for (const Method m : graph::all_methods())
    if (flags.methods.empty() ||
        std::find(flags.methods.begin(), flags.methods.end(), graph::short_name_of(m)) != flags.methods.end())
      methods.push_back(m);
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
  write_png(folder.file("table1.png"), stack(comparison.rows));
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
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--count", flags->counts, "MESH=N: another number of patches for one mesh");
  command->add_option("--reference", flags->references,
                      "MESH=FILE: measure against FILE (same vertices, in order) and leave out of the means");
  std::vector<std::string> names;
  for (const Method m : graph::all_methods()) names.push_back(graph::short_name_of(m));
  command->add_option("--methods", flags->methods, "only these")->check(CLI::IsMember(names))->delimiter(',');
  command->add_option("--loop-samples", flags->loop_samples, "points of a patch border at most, about")
      ->check(CLI::Range(12, 400))
      ->capture_default_str();
  command->add_option("--samples", flags->samples, "distance samples")
      ->check(CLI::Range(1000, 20'000'000))
      ->capture_default_str();
  add_common_flags(*command, flags->common);
  flags->method.add_to(*command);
  command->callback([flags, &exit_code] { exit_code = table1(*flags); });
}

}  // namespace intarsia::tools
