// What the commands that run stages have in common: threads, interruption, progress, reading the mesh, the report (of
// a failed run too) and the trace.
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/data/mesh.h"
#include "engine/run/node.h"
#include "tools/option_flags.h"
#include "tools/progress_bar.h"

namespace intarsia::tools {

RunSettings settings_of(const CommonFlags& flags);

class StageCommand {
 public:
  // name: of the command, for the report. The flow begins with the stage that reads `input`.
  StageCommand(std::string name, std::string input, const CommonFlags& flags);

  Flow& flow() { return flow_; }
  const Port<Soup>& soup() const { return soup_; }

  // Runs the stages. Returns the report: what every command reports, then what `add` puts into it. If a stage fails,
  // the report goes to the file of --report before the error goes on.
  nlohmann::json run(const nlohmann::json& options, const std::function<void(nlohmann::json&)>& add = {});
  // Writes the files of --report and --trace; after a command's results are in place.
  void write_records(const nlohmann::json& report) const;

 private:
  void write_report(const nlohmann::json& report) const;

  std::string name_, input_;
  const CommonFlags& flags_;
  RunContext context_;
  ProgressBar bar_;
  Flow flow_;
  Port<Soup> soup_;
};

// The same text for a report, wherever it is written.
std::string text_of(const nlohmann::json& report);

}  // namespace intarsia::tools
