#include "tools/stage_command.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "engine/base/checksum.h"
#include "engine/io/file_bytes.h"
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

// Of the bits of this program: another build may compute something else.
std::uint64_t program_hash() {
  try {
    const FileBytes file(Work{}, "/proc/self/exe");
    return checksum(file.view().data(), file.view().size());
  } catch (const Error& e) {
    throw Error(ErrorCode::internal, std::string("checkpoints need /proc/self/exe, to tell builds apart: ") + e.what());
  }
}

}  // namespace

void add_checkpoint_flag(CLI::App& app, CommonFlags& flags) {
  app.add_option(
      "--checkpoint", flags.checkpoint,
      "keep the result of every stage in DIR; a run that was killed, or changes options, resumes from there");
}

void add_time_limit_flag(CLI::App& app, CommonFlags& flags) {
  app.add_option(
         "--time-limit", flags.time_limit,
         "the best layout that this time allows, such as 90s, 10m or 1h; exit status 6 if it is not the one that "
         "more time would give, or if there is none")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1}, {"m", 60}, {"h", 3600}}))
      ->check(CLI::PositiveNumber);
}

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
      bar_(flags.quiet && flags.progress == "auto" ? ProgressBar::Style::none : ProgressBar::style_of(flags.progress)),
      flow_(listened(context_, bar_), std::filesystem::path(input_).filename().string()) {
  if (flags.time_limit > 0) limit_.emplace(context_, flags.time_limit);
  if (!flags.checkpoint.empty()) flow_.use(checkpoints_.emplace(flags.checkpoint, program_hash()));
  const CostModel cost = name_ == "features" ? kFeaturesCost : kRunCost;
  const auto read = [path = std::filesystem::path(input_), cost, most = flags.max_memory](const Work& work) {
    Soup soup = read_mesh(work, path);
    check_memory(cost(soup.vertex_count(), soup.face_count()), most);
    return soup;
  };
  soup_ = add_stage(flow_, Stage<Soup>{"read", 1, 0, read, {}, 0.3});
}

Error StageCommand::no_result_in_time() const {
  return Error(
      ErrorCode::out_of_time,
      "no layout within the time limit; nothing was written. Allow more time, or simplify the mesh" +
          std::string(flags_.checkpoint.empty() ? "" : "; the next run goes on from the last stage that ended"));
}

bool StageCommand::was_shortened() const {
  const auto stages = flow_.record().stages();
  return std::any_of(stages.begin(), stages.end(), [](const StageSummary& s) { return s.shortened; });
}

nlohmann::json StageCommand::run(const nlohmann::json& options, const std::function<void(nlohmann::json&)>& add) {
  const auto report_now = [&] {
    nlohmann::json report = base_report(name_, input_, flags_, context_, flow_.record(), options);
    if (limit_) {
      report["time_limit"] = {{"seconds", flags_.time_limit}, {"shortened", was_shortened()}};
      if (was_shortened())
        report["warnings"].push_back({{"code", "time-limit"},
                                      {"stage", ""},
                                      {"count", 1},
                                      {"message",
                                       "the time limit stopped the improvement of this layout; with more time it would "
                                       "be another one, and so it would on another machine"}});
    }
    if (add) add(report);
    return report;
  };
  try {
    flow_.run();
  } catch (const Error& e) {
    write_report(report_now());
    if (limit_ && limit_->has_expired() && e.code() == ErrorCode::cancelled) throw no_result_in_time();
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
