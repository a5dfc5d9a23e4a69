#include "tools/stage_command.h"

#include <filesystem>

#include "engine/io/read_mesh.h"
#include "engine/io/write_file.h"
#include "engine/run/trace.h"
#include "graph/artefacts.h"
#include "tools/forecast.h"
#include "tools/interrupt.h"
#include "tools/report.h"

namespace intarsia::tools {
namespace {

RunContext& listened(RunContext& context, ProgressBar& bar) {
  context.add_listener(bar);
  return context;
}

void check_memory(const Forecast& forecast, std::uint64_t most) {
  if (most == 0 || forecast.peak_memory <= most) return;
  throw Error(ErrorCode::no_memory,
              "this mesh needs about " + memory_text(forecast.peak_memory) + ", more than the " + memory_text(most) +
                  " that --max-memory allows; nothing was begun. Allow more, or take a smaller mesh: simplified, or in "
                  "parts");
}

}  // namespace

RunSettings settings_of(const CommonFlags& flags) {
  RunSettings settings;
  settings.threads = flags.threads, settings.seed = flags.seed;
  settings.order = flags.order == "relaxed" ? Order::relaxed : Order::fixed;
  return settings;
}

std::string text_of(const nlohmann::json& report) { return report.dump(1) + "\n"; }

StageCommand::StageCommand(std::string name, std::string input, const CommonFlags& flags)
    : name_(std::move(name)),
      input_(std::move(input)),
      flags_(flags),
      context_(settings_of(flags), &interrupt_flag()),
      bar_(flags.quiet ? ProgressBar::Style::none : ProgressBar::style_for_terminal()),
      flow_(listened(context_, bar_), std::filesystem::path(input_).filename().string()) {
  const CostModel cost = name_ == "features" ? kFeaturesCost : kRunCost;
  const auto read = [path = std::filesystem::path(input_), cost, most = flags.max_memory](const Work& work) {
    Soup soup = read_mesh(work, path);
    check_memory(cost(soup.vertex_count(), soup.face_count()), most);
    return soup;
  };
  soup_ = add_stage(flow_, Stage<Soup>{"read", 1, 0, read, {}, 0.3});
}

nlohmann::json StageCommand::run(const nlohmann::json& options, const std::function<void(nlohmann::json&)>& add) {
  const auto report_now = [&] {
    nlohmann::json report = base_report(name_, input_, flags_, context_, flow_.record(), options);
    if (add) add(report);
    return report;
  };
  try {
    flow_.run();
  } catch (const Error&) {
    write_report(report_now());
    throw;
  }
  return report_now();
}

void StageCommand::write_report(const nlohmann::json& report) const {
  if (!flags_.report.empty()) write_file_atomically(flags_.report, text_of(report));
}

void StageCommand::write_records(const nlohmann::json& report) const {
  write_report(report);
  if (!flags_.trace.empty())
    write_file_atomically(flags_.trace, chrome_trace({{"intarsia", &flow_.record()}}).dump(1) + "\n");
}

}  // namespace intarsia::tools
