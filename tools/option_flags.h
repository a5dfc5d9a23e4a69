// The list of the method's options (graph/visit_options.h) as command-line flags and as JSON.
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include "engine/base/length.h"
#include "graph/options.h"

namespace intarsia::tools {

// Settings every command that runs stages has.
struct CommonFlags {
  std::string mode = "robust", subdivide, order = "fixed", report, trace, checkpoint, config, progress = "auto";
  int threads = 0;
  std::uint64_t max_memory = 0;  // bytes; 0 = no limit
  std::uint64_t seed = 0;
  Length min_feature;
  bool strict = false;
  double time_limit = 0;  // seconds; 0 = none
  bool quiet = false, print_config = false;
};

void add_common_flags(CLI::App& app, CommonFlags& flags);
// An option that takes a length: 1.5 (model units), 2% (of the diagonal), 4e (mean edges).
CLI::Option* add_length_flag(CLI::App& app, const std::string& name, Length& length, const std::string& help);

// Adds one flag per option. Values given on the command line are kept apart until apply() writes them over the mode's
// own values.
class OptionFlags {
 public:
  void add_to(CLI::App& app);
  // The options of the mode with what was given. Errors: bad_argument naming the option that is out of range.
  graph::LayoutOptions options(const CommonFlags& common) const;
  // {"name": {"value": v, "given": true | false}}
  nlohmann::json to_json(const graph::LayoutOptions& options) const;

 private:
  graph::LayoutOptions given_values_;
  std::vector<std::pair<std::string, CLI::Option*>> flags_;
};

}  // namespace intarsia::tools
