// report.json: everything about a run that a person or a program may want to know afterwards (docs/formats.md).
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "engine/run/context.h"
#include "engine/run/record.h"
#include "graph/artefacts.h"
#include "tools/option_flags.h"

namespace intarsia::tools {

// What every command reports: versions, options, stages, memory, warnings.
nlohmann::json base_report(const std::string& command, const std::filesystem::path& input, const CommonFlags& common,
                           const RunContext& context, const RunRecord& record, const nlohmann::json& options);

// Adds counts, checks, the patch table and the hash over layout, labels and network.
void add_layout_report(nlohmann::json& report, const Soup& soup, const graph::Surface& surface,
                       const graph::Network& network, const graph::Layout& layout, Index wanted_patches);

nlohmann::json version_json();

}  // namespace intarsia::tools
