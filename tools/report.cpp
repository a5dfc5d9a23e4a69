#include "tools/report.h"

#include <nlohmann/json.hpp>

namespace intarsia::tools {

using nlohmann::json;

json version_json() { return {{"program", "intarsia"}, {"version", INTARSIA_VERSION}, {"compiler", __VERSION__}}; }

json base_report(const std::string& command, const std::filesystem::path& input, const CommonFlags& common,
                 const RunContext& context, const RunRecord& record, const json& options) {
  json report = {{"schema", "intarsia-report"}, {"schema_version", 1}};
  report.update(version_json());
  report["command"] = command;
  report["input"] = {{"path", input.string()}};
  report["mode"] = common.mode;
  report["order"] = common.order;
  report["threads"] = context.threads();
  report["seed"] = common.seed;
  report["options"] = options;
  report.update(record.to_json());
  return report;
}

}  // namespace intarsia::tools
