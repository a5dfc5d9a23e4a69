// What eval.json says about an evaluation, without the input and the time (docs/formats.md).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/evaluate.h"

namespace intarsia::graph {

nlohmann::json evaluation_json(const Evaluation& evaluation, const EvaluateOptions& options, Real diagonal);

}  // namespace intarsia::graph
