#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "engine/io/read_mesh.h"
#include "engine/io/write_file.h"
#include "graph/layout_graph.h"
#include "tools/commands.h"
#include "tools/config_file.h"
#include "tools/counted.h"
#include "tools/exit_code.h"
#include "tools/forecast.h"
#include "tools/guide_flags.h"
#include "tools/interrupt.h"
#include "tools/report.h"
#include "tools/stage_command.h"
#include "tools/usual_flags.h"
#include "tools/view/write_page.h"
#include "tools/view_flag.h"
#include "tools/write_flag.h"
#include "tools/write_result.h"

namespace intarsia::tools {
namespace {

struct RunFlags {
  std::string input, output;
  Index patches = 0;
  Length tolerance;
  GuideFlags guides;
  PictureFlags picture;
  WriteFlag write;
  CommonFlags common;
  OptionFlags method;
  bool dry_run = false;
};

void add_goal(nlohmann::json& report, const graph::LayoutOptions& options, const graph::Goal* goal) {
  if (!(options.tolerance.value > 0)) return;
  nlohmann::json& row = report["tolerance"];
  row["value"] = text_of(options.tolerance);
  if (goal == nullptr) return;
  row["patches"] = goal->patches, row["rms_relative"] = goal->rms, row["layouts_tried"] = goal->tries;
}

void print_summary(const nlohmann::json& report, const std::filesystem::path& folder, const Exports& exports) {
  const nlohmann::json& counts = report["counts"];
  fmt::print("{}, {}, {} in {:.2f} s ({})\n", counted(counts["patches"].get<int>(), "patch", "patches"),
             counted(counts["arcs"].get<int>(), "arc"), counted(counts["nodes"].get<int>(), "node"),
             report["seconds"].get<double>(), counted(report["threads"].get<int>(), "thread"));
  for (const auto& w : report["warnings"]) spdlog::warn("{}", w["message"].get<std::string>());
  std::string names;
  for (const std::string& name : result_names())
    if (std::filesystem::exists(folder / name)) names += " " + name;
  fmt::print("written to {}:{}\n", (folder / "").string(), names);
  if (exports.is_default && report["input"]["triangles"].get<std::size_t>() > kPageFaces)
    fmt::print("no view.html above {} triangles; for a coarser one: intarsia convert {} --write html\n", kPageFaces,
               folder.string());
}

// What a run would do, without doing it: everything up to its first stage.
int dry_run(const RunFlags& flags, const Exports& exports) {
  RunContext context(settings_of(flags.common), &interrupt_flag());
  Soup soup;
  context.execute([&] { soup = read_mesh(context.work(), flags.input); });
  const Forecast forecast = kRunCost(soup.vertex_count(), soup.face_count());
  check_memory(forecast, flags.common.max_memory);
  const OutputFolder folder(flags.output, result_names());  // refuses what cannot be written to
  fmt::print("would read {} vertices, {} triangles from {}\n", soup.vertex_count(), soup.face_count(), flags.input);
  fmt::print("would take about {:.2g} s of one processor core, at most {} of memory\n", forecast.cpu_seconds,
             memory_text(forecast.peak_memory));
  std::string names;
  for (const std::string& name : exports.files) names += " " + name;
  fmt::print("would write to {}: patches.ply layout.ply network.ply network.json report.json preview.png{}\n",
             (folder.target() / "").string(), names);
  fmt::print("nothing was written\n");
  return kExitDone;
}

int run(const RunFlags& flags, const CLI::App& app) {
  graph::LayoutOptions options = flags.method.options(flags.common);
  options.patches = flags.patches, options.tolerance = flags.tolerance;
  if (flags.common.print_config) {
    fmt::print("{}", config_text(app, flags.method, options));
    return kExitDone;
  }
  const Exports exports = flags.write.exports(flags.input);
  if (flags.dry_run) return dry_run(flags, exports);
  StageCommand command("run", flags.input, flags.common);
  OutputFolder folder(flags.output, result_names());
  const graph::LayoutPorts ports =
      graph::add_layout_stages(command.flow(), command.soup(), options, guide_source(command.work(), flags.guides));
  keep(ports.goal);
  nlohmann::json summary;
  const auto write = [&](const Work& work, const Soup& s, const graph::Surface& surface, const graph::Ridges& ridges,
                         const graph::Ridges& valleys, const graph::Sharp& sharp, const graph::Smoothing& smoothing,
                         const graph::Layout& layout) {
    command.stop_clock();
    add_layout_report(summary, s, surface, smoothing.network, layout, options.patches);
    return write_result(work, folder, s, surface, ridges, valleys, sharp, smoothing.network, layout,
                        pictures_of(flags.picture), exports);
  };
  using WriteStage =
      Stage<Written, Soup, graph::Surface, graph::Ridges, graph::Ridges, graph::Sharp, graph::Smoothing, graph::Layout>;
  add_stage(command.flow(), WriteStage{"write", 1, 0, write, {}, 1.5}, command.soup(), ports.features.surface,
            ports.ridges, ports.valleys, ports.features.sharp, ports.smoothing, ports.layout);
  const nlohmann::json report = command.run(flags.method.to_json(options), [&](nlohmann::json& r) {
    r["options"]["patches"] = {{"value", options.patches}, {"given", options.patches > 0}};
    r.merge_patch(summary);
    add_goal(r, options, fetch(ports.goal).get());
  });
  write_file_atomically(folder.file("report.json"), text_of(report));
  folder.commit();
  command.write_records(report);
  if (!flags.common.quiet) print_summary(report, folder.target(), exports);
  if (command.was_shortened()) return kExitLimit;
  return report["valid"].get<bool>() ? kExitDone : kExitDegraded;
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<RunFlags>();
  CLI::App* command = app.add_subcommand("run", "patch layout of a triangle mesh");
  command->add_option("input", flags->input, "mesh: .ply .obj .stl .off")->required();
  command->add_option("-o,--output", flags->output, "folder for the results; exchanged as a whole")->required();
  command->add_option("-n,--patches", flags->patches, "wanted number of patches; 0 = automatic")
      ->check(whole_number(0, kNone - 1));
  add_length_flag(*command, "--tolerance", flags->tolerance,
                  "instead of a number: as few patches as rebuild the surface from their borders to this (RMS)")
      ->check([](const std::string& text) { return parse_length(text).value > 0 ? "" : "must be above 0"; })
      ->excludes("--patches");
  add_guide_flags(*command, flags->guides);
  add_picture_flags(*command, flags->picture);
  add_write_flag(*command, flags->write, "csv,npy,html");
  add_common_flags(*command, flags->common);
  add_checkpoint_flag(*command, flags->common);
  add_time_limit_flag(*command, flags->common);
  command->add_flag("--dry-run", flags->dry_run,
                    "read the mesh, say what the run would cost and write, and stop; --print-config says how");
  flags->method.add_to(*command);
  command->callback([flags, command, &exit_code] {
    apply_config(*command, flags->common.config);
    exit_code = run(*flags, *command);
  });
}

}  // namespace intarsia::tools
