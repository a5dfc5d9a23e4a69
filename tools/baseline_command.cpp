#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "engine/io/read_labels.h"
#include "engine/io/write_file.h"
#include "graph/baseline_graph.h"
#include "tools/commands.h"
#include "tools/config_file.h"
#include "tools/counted.h"
#include "tools/exit_code.h"
#include "tools/report.h"
#include "tools/stage_command.h"
#include "tools/usual_flags.h"
#include "tools/view_flag.h"
#include "tools/write_result.h"

namespace intarsia::tools {
namespace {

const std::map<std::string, graph::Baseline> kMethods = {{"vsa", graph::Baseline::vsa},
                                                         {"qse", graph::Baseline::qse},
                                                         {"exoskeleton", graph::Baseline::exoskeleton},
                                                         {"slippage", graph::Baseline::slippage}};

struct BaselineFlags {
  std::string method, input, output, parts, property = "patch";
  Index patches = 40;
  PictureFlags picture;
  CommonFlags common;
  OptionFlags stages;
};

graph::PartsOfSoup parts_reader(const BaselineFlags& flags) {
  if (flags.parts.empty()) return {};
  if (kMethods.at(flags.method) != graph::Baseline::exoskeleton)
    throw Error(ErrorCode::bad_argument, "--parts is for the method exoskeleton");
  return [path = flags.parts, property = flags.property](const Soup& soup) {
    const std::vector<int> of_face = read_face_labels(Work(), path, property);
    std::vector<Index> parts;
    number_labels(labels_of_triangles(path, of_face, soup.source_face, soup.face_count()), parts);
    return parts;
  };
}

int baseline(const BaselineFlags& flags, const CLI::App& app) {
  graph::LayoutOptions options = flags.stages.options(flags.common);
  options.patches = flags.patches;
  if (flags.common.print_config) {
    fmt::print("{}", config_text(app, flags.stages, options));
    return kExitDone;
  }
  const graph::Baseline method = kMethods.at(flags.method);
  StageCommand command("baseline", flags.input, flags.common);
  OutputFolder folder(flags.output, result_names());
  const graph::BaselinePorts ports =
      graph::add_baseline_stages(command.flow(), command.soup(), options, method, parts_reader(flags));
  nlohmann::json summary;
  const auto write = [&](const Work& work, const Soup& s, const graph::Surface& surface, const graph::Network& network,
                         const graph::Patches& patches, const graph::Layout& layout) {
    add_layout_report(summary, s, surface, network, layout, options.patches);
    return write_baseline(work, folder, s, surface, patches, layout, graph::name_of(method), pictures_of(flags.picture),
                          {});
  };
  using WriteStage = Stage<Written, Soup, graph::Surface, graph::Network, graph::Patches, graph::Layout>;
  add_stage(command.flow(), WriteStage{"write", 1, 0, write, {}, 1.5}, command.soup(), ports.features.surface,
            ports.network, ports.patches, ports.layout);
  const nlohmann::json report = command.run(flags.stages.to_json(options), [&](nlohmann::json& r) {
    r["method"] = graph::name_of(method);
    r["options"]["patches"] = {{"value", options.patches}, {"given", true}};
    if (!flags.parts.empty()) r["parts"] = flags.parts;
    r.merge_patch(summary);
  });
  write_file_atomically(folder.file("report.json"), text_of(report));
  folder.commit();
  command.write_records(report);
  if (!flags.common.quiet) {
    fmt::print("{}: {}, {} of them no discs, in {:.2f} s ({})\n", graph::name_of(method),
               counted(report["counts"]["patches"].get<int>(), "patch", "patches"),
               report["counts"]["not_discs"].get<int>(), report["seconds"].get<double>(),
               counted(report["threads"].get<int>(), "thread"));
    for (const auto& w : report["warnings"]) spdlog::warn("{}", w["message"].get<std::string>());
    fmt::print("written to {}: patches.ply layout.ply network.ply network.json report.json preview.png\n",
               (folder.target() / "").string());
  }
  return report["valid"].get<bool>() ? kExitDone : kExitDegraded;
}

}  // namespace

void add_baseline_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<BaselineFlags>();
  CLI::App* command = app.add_subcommand("baseline", "layout by one of the methods that ours is compared with");
  std::vector<std::string> methods;
  methods.reserve(std::size(kMethods));
  for (const auto& [name, method] : kMethods) methods.push_back(name);
  command
      ->add_option(
          "method", flags->method,
          "vsa: planes (Cohen-Steiner et al. 2004); qse: quadrics (after Yan et al. 2006); exoskeleton: parts, "
          "then planes (after de Goes et al. 2011); slippage (after Gelfand, Guibas 2004)")
      ->required()
      ->check(CLI::IsMember(methods));
  command->add_option("input", flags->input, "mesh: .ply .obj .stl .off")->required();
  command->add_option("-o,--output", flags->output, "folder for the results; exchanged as a whole")->required();
  command->add_option("-n,--patches", flags->patches, "number of patches")
      ->check(whole_number(1, kNone - 1))
      ->capture_default_str();
  command->add_option("--parts", flags->parts, "exoskeleton: parts of the body, .seg (one label a line) or .ply");
  command->add_option("--property", flags->property, "face property of a .ply with parts")->capture_default_str();
  add_picture_flags(*command, flags->picture);
  add_common_flags(*command, flags->common);
  add_checkpoint_flag(*command, flags->common);
  flags->stages.add_to(*command);
  command->callback([flags, command, &exit_code] {
    apply_config(*command, flags->common.config);
    exit_code = baseline(*flags, *command);
  });
}

}  // namespace intarsia::tools
