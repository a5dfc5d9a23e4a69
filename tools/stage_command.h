// What the commands that run stages have in common: threads, interruption, progress, reading the mesh, the report (of
// a failed run too) and the trace.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/data/mesh.h"
#include "engine/run/checkpoints.h"
#include "engine/run/node.h"
#include "engine/run/time_limit.h"
#include "tools/option_flags.h"
#include "tools/progress_bar.h"

namespace intarsia::tools {

RunSettings settings_of(const CommonFlags& flags);

// --checkpoint and --time-limit, of the commands that take them.
void add_checkpoint_flag(CLI::App& app, CommonFlags& flags);
void add_time_limit_flag(CLI::App& app, CommonFlags& flags);

class StageCommand {
 public:
  // name: of the command, for the report. The flow begins with the stage that reads `input`.
  StageCommand(std::string name, std::string input, const CommonFlags& flags);

  Flow& flow() { return flow_; }
  Work work() { return context_.work(); }
  const Port<Soup>& soup() const { return soup_; }

  // Runs the stages. Returns the report: what every command reports, then what `add` puts into it. If a stage fails,
  // the report goes to the file of --report before the error goes on.
  nlohmann::json run(const nlohmann::json& options, const std::function<void(nlohmann::json&)>& add = {});
  // The result is there: from now on the time limit does not stop the run.
  void stop_clock() {
    if (limit_) limit_->disarm();
  }
  // After the run: whether the time limit made stages stop early.
  bool was_shortened() const;
  // Writes the files of --report and --trace; after a command's results are in place.
  void write_records(const nlohmann::json& report) const;

 private:
  Error no_result_in_time() const;
  void write_report(const nlohmann::json& report) const;

  std::string name_, input_;
  const CommonFlags& flags_;
  std::optional<Checkpoints> checkpoints_;
  RunContext context_;
  std::optional<TimeLimit> limit_;
  ProgressBar bar_;
  Flow flow_;
  Port<Soup> soup_;
};

// The same text for a report, wherever it is written.
std::string text_of(const nlohmann::json& report);

}  // namespace intarsia::tools
