#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "engine/io/read_mesh.h"
#include "engine/io/write_file.h"
#include "engine/run/trace.h"
#include "graph/layout_graph.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/option_flags.h"
#include "tools/progress_bar.h"
#include "tools/report.h"
#include "tools/view_flag.h"
#include "tools/write_result.h"

namespace intarsia::tools {
namespace {

struct RunFlags {
  std::string input, output;
  Index patches = 0;
  std::vector<double> view;  // azimuth, elevation in degrees
  CommonFlags common;
  OptionFlags method;
};

void write_trace(const CommonFlags& common, const RunRecord& record) {
  if (!common.trace.empty()) write_file_atomically(common.trace, chrome_trace({{"intarsia", &record}}).dump(1) + "\n");
}

void print_summary(const RunFlags& flags, const nlohmann::json& report, const std::filesystem::path& folder) {
  fmt::print("{} patches, {} arcs, {} nodes in {:.2f} s ({} threads)\n", report["counts"]["patches"].get<int>(),
             report["counts"]["arcs"].get<int>(), report["counts"]["nodes"].get<int>(), report["seconds"].get<double>(),
             report["threads"].get<int>());
  for (const auto& w : report["warnings"]) spdlog::warn("{}", w["message"].get<std::string>());
  fmt::print("written to {}: patches.ply layout.ply network.ply network.json report.json preview.png\n",
             (folder / "").string());
  (void)flags;
}

int run(const RunFlags& flags) {
  graph::LayoutOptions options = flags.method.options(flags.common);
  options.patches = flags.patches;
  RunSettings settings;
  settings.threads = flags.common.threads, settings.seed = flags.common.seed;
  settings.order = flags.common.order == "relaxed" ? Order::relaxed : Order::fixed;
  RunContext context(settings, &interrupt_flag());
  ProgressBar bar(flags.common.quiet ? ProgressBar::Style::none : ProgressBar::style_for_terminal());
  context.add_listener(bar);
  OutputFolder folder(flags.output, result_names());

  Flow flow(context, std::filesystem::path(flags.input).filename().string());
  const auto read = [path = std::filesystem::path(flags.input)](const Work& work) { return read_mesh(work, path); };
  const Port<Soup> soup = add_stage(flow, Stage<Soup>{"read", 1, 0, read, {}, 0.3});
  const graph::LayoutPorts ports = graph::add_layout_stages(flow, soup, options);
  nlohmann::json summary;
  const auto write = [&](const Work& work, const Soup& s, const graph::Surface& surface, const graph::Ridges& ridges,
                         const graph::Ridges& valleys, const graph::Sharp& sharp, const graph::Network& network,
                         const graph::Layout& layout) {
    add_layout_report(summary, s, surface, network, layout, options.patches);
    return write_result(work, folder, s, surface, ridges, valleys, sharp, network, layout, chosen_view(flags.view));
  };
  using WriteStage =
      Stage<Written, Soup, graph::Surface, graph::Ridges, graph::Ridges, graph::Sharp, graph::Network, graph::Layout>;
  add_stage(flow, WriteStage{"write", 1, 0, write, {}, 1.5}, soup, ports.features.surface, ports.ridges, ports.valleys,
            ports.features.sharp, ports.network, ports.layout);

  const auto report_now = [&] {
    nlohmann::json report =
        base_report("run", flags.input, flags.common, context, flow.record(), flags.method.to_json(options));
    report["options"]["patches"] = {{"value", options.patches}, {"given", options.patches > 0}};
    report.merge_patch(summary);
    return report;
  };
  try {
    flow.run();
  } catch (const Error&) {
    if (!flags.common.report.empty()) write_file_atomically(flags.common.report, report_now().dump(1) + "\n");
    throw;
  }
  const nlohmann::json report = report_now();
  const std::string text = report.dump(1) + "\n";
  write_file_atomically(folder.file("report.json"), text);
  folder.commit();
  if (!flags.common.report.empty()) write_file_atomically(flags.common.report, text);
  write_trace(flags.common, flow.record());
  if (!flags.common.quiet) print_summary(flags, report, folder.target());
  return report["valid"].get<bool>() ? kExitDone : kExitDegraded;
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<RunFlags>();
  CLI::App* command = app.add_subcommand("run", "patch layout of a triangle mesh");
  command->add_option("input", flags->input, "mesh: .ply .obj .stl .off")->required();
  command->add_option("-o,--output", flags->output, "folder for the results; exchanged as a whole")->required();
  command->add_option("-n,--patches", flags->patches, "wanted number of patches; 0 = automatic")
      ->check(CLI::NonNegativeNumber);
  add_view_flag(*command, flags->view);
  add_common_flags(*command, flags->common);
  flags->method.add_to(*command);
  command->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace intarsia::tools
