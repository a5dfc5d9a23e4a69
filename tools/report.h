// report.json: everything about a run that a person or a program may want to know afterwards (docs/formats.md).
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "engine/run/context.h"
#include "engine/run/record.h"
#include "graph/layout_report.h"
#include "tools/option_flags.h"

namespace intarsia::tools {

// What every command reports: versions, options, stages, memory, warnings.
nlohmann::json base_report(const std::string& command, const std::filesystem::path& input, const CommonFlags& common,
                           const RunContext& context, const RunRecord& record, const nlohmann::json& options);

using graph::add_layout_report;

nlohmann::json version_json();

}  // namespace intarsia::tools
