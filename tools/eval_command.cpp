#include <chrono>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "engine/io/write_file.h"
#include "engine/run/context.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/report.h"
#include "tools/usual_flags.h"
#include "tools/view_flag.h"
#include "tools/write_evaluation.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

struct EvalFlags {
  std::string input, output, metric = "area-bend";
  LabelledMesh labelled;
  std::string labels;
  graph::EvaluateOptions options;
  std::vector<double> view;
  int threads = 0;
  bool json = false, quiet = false;
};

const std::map<std::string, PolygonMetric> kMetrics = {{"area", PolygonMetric::area},
                                                       {"area-bend", PolygonMetric::area_bend},
                                                       {"squared-dihedral", PolygonMetric::squared_dihedral},
                                                       {"worst-dihedral", PolygonMetric::worst_dihedral}};

LayoutFromFile read_input(const Work& work, const EvalFlags& flags) {
  if (std::filesystem::is_directory(flags.input)) return read_result_folder(work, flags.input);
  LabelledMesh labelled = flags.labelled;
  labelled.mesh = flags.input, labelled.labels = flags.labels;
  return read_labelled_mesh(work, labelled);
}

json report_of(const EvalFlags& flags, const LayoutFromFile& layout, const graph::Evaluation& evaluation,
               double seconds) {
  json report = {{"schema", "intarsia-eval"}, {"schema_version", 1}};
  report.update(version_json());
  report["input"] = {
      {"path", flags.input}, {"vertices", layout.soup.vertex_count()}, {"triangles", layout.soup.face_count()}};
  if (!flags.labels.empty()) report["input"]["labels"] = flags.labels;
  report.update(evaluation_json(evaluation, flags.options, layout.box.diagonal));
  report["settings"]["smoothed"] = flags.labelled.smooth;
  report["seconds"] = seconds;
  return report;
}

void print_text(const graph::Evaluation& e, Real diagonal, double seconds) {
  fmt::print("{:<18}{:>12}{:>12}{:>12}{:>14}{:>14}{:>14}\n", "", "largest %", "mean %", "RMS %", "largest", "mean",
             "RMS");
  for (const auto& [name, r] : e.made()) {
    const kernels::SurfaceDistance& d = r->distance;
    fmt::print("{:<18}{:>12.4g}{:>12.4g}{:>12.4g}{:>14.6g}{:>14.6g}{:>14.6g}\n", name, 100 * d.hausdorff(),
               100 * d.mean(), 100 * d.rms(), diagonal * d.hausdorff(), diagonal * d.mean(), diagonal * d.rms());
  }
  fmt::print("% of the bounding-box diagonal, {:.6g}; the larger of both directions. {:.2f} s\n", diagonal, seconds);
  fmt::print("{} patches, {} of them no discs; perimeter^2 / (4 pi area): median {:.3g}, 90 % {:.3g}, largest {:.3g}\n",
             e.patches, e.not_discs, e.compactness.median, e.compactness.high, e.compactness.most);
  for (const auto& [name, r] : e.made())
    if (r->failed > 0)
      spdlog::warn(
          "{}: {} of {} patches {}", name, r->failed, e.patches,
          name == "triangulated" || name == "triangulated_area" ? "could not be rebuilt" : "stayed as triangulated");
}

int eval(EvalFlags& flags) {
  const bool is_folder = std::filesystem::is_directory(flags.input);
  if (!std::filesystem::exists(flags.input))
    throw Error(ErrorCode::bad_file, flags.input + ": there is no such file or folder");
  if (flags.output.empty() && !is_folder)
    throw Error(ErrorCode::bad_argument, "a labelled mesh needs a folder for the results: -o DIR");
  if (is_folder && (!flags.labels.empty() || flags.labelled.smooth))
    throw Error(ErrorCode::bad_argument, "--labels and --smooth are for labelled meshes, not for folders of results");
  flags.options.triangulated.polygon.metric = kMetrics.at(flags.metric);
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  if (is_folder && !is_result_folder(flags.input)) read_result_folder(work, flags.input);  // says what is missing
  std::vector<std::string> names = evaluation_names();
  const std::filesystem::path page = std::filesystem::path(flags.input) / "view.html";
  const bool has_page = is_folder && std::filesystem::exists(page);
  if (has_page) names.push_back("view.html");
  OutputFolder folder(flags.output.empty() ? flags.input : flags.output, names);
  std::string text;
  context.execute([&] {
    const LayoutFromFile layout = read_input(work, flags);
    const auto start = std::chrono::steady_clock::now();
    const graph::Evaluation evaluation =
        graph::evaluate(work, layout.mesh, layout.refined, layout.label, layout.graph, flags.options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    text = report_of(flags, layout, evaluation, seconds).dump(1) + "\n";
    write_evaluation(work, folder, layout, evaluation, chosen_view(flags.view));
    if (has_page) write_evaluated_page(work, folder.file("view.html"), page, layout, evaluation);
    write_file_atomically(folder.file("eval.json"), text);
    if (!flags.json && !flags.quiet) print_text(evaluation, layout.box.diagonal, seconds);
  });
  folder.commit();
  if (flags.json) fmt::print("{}", text);
  return kExitDone;
}

}  // namespace

void add_eval_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<EvalFlags>();
  graph::EvaluateOptions& o = flags->options;
  CLI::App* command =
      app.add_subcommand("eval", "rebuild the surface from a layout's curves alone and measure how far it is");
  command->add_option("input", flags->input, "folder written by intarsia run, or a mesh with labels")->required();
  command->add_option("-o,--output", flags->output, "folder for the results; default: the folder that is judged");
  command->add_option("--labels", flags->labels, "labels of the mesh's faces: .seg (one a line) or .ply");
  command->add_option("--property", flags->labelled.property, "face property of a .ply with labels")
      ->capture_default_str();
  command->add_flag("--smooth", flags->labelled.smooth, "smooth the borders of a labelled mesh as a run does");
  command->add_option("--loop-samples", o.sample.loop_samples, "points on the border of a patch, at most about")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  command
      ->add_option("--metric", flags->metric, "of the triangulation: area, area-bend, squared-dihedral, worst-dihedral")
      ->check(CLI::IsMember({"area", "area-bend", "squared-dihedral", "worst-dihedral"}))
      ->capture_default_str();
  command->add_flag("--area", o.make_triangulated_area, "also triangulate by plain area");
  command->add_option("--samples", o.distance.samples, "of the distance, on both surfaces together")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 31))
      ->capture_default_str();
  add_view_flag(*command, flags->view);
  command->add_flag("--json", flags->json, "print eval.json instead of the table");
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = eval(*flags); });
}

}  // namespace intarsia::tools
