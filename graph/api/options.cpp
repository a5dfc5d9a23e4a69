#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/base/nearest_word.h"
#include "graph/api/run.h"
#include "graph/layout_graph.h"
#include "graph/visit_options.h"

namespace intarsia {
namespace {

graph::LayoutOptions defaults_of(Mode mode, std::uint64_t seed) {
  return mode == Mode::paper ? graph::paper_options(seed) : graph::robust_options();
}

const OptionInfo& option_named(const std::vector<OptionInfo>& all, std::string_view name) {
  std::vector<std::string> names;
  for (const OptionInfo& o : all) {
    if (o.name == name) return o;
    names.push_back(o.name);
  }
  const std::string likely = likely_word(std::string(name), names);
  throw Error(ErrorCode::bad_argument,
              "there is no option " + std::string(name) + (likely.empty() ? "" : "; did you mean " + likely + "?"));
}

void check_value(const OptionInfo& option, double value) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::bad_argument, "option " + option.name + " (" + option.help + ") must be " + what);
  };
  if (!(value >= option.least && value <= option.most))
    refuse("in " + std::to_string(option.least) + " .. " + std::to_string(option.most));
  if (option.is_whole && value != std::floor(value)) refuse("a whole number");
}

}  // namespace

inline namespace api {

std::vector<OptionInfo> method_options(Mode mode) {
  std::vector<OptionInfo> all;
  graph::LayoutOptions values = defaults_of(mode, 0);
  graph::visit_options(values, [&](const char* name, const auto& value, const char* help, auto least, auto most) {
    OptionInfo& o = all.emplace_back();
    o.name = name, o.help = help;
    o.value = static_cast<double>(value), o.least = static_cast<double>(least), o.most = static_cast<double>(most);
    o.is_whole = std::is_integral_v<std::remove_cvref_t<decltype(value)>>;
  });
  return all;
}

Status Options::set(std::string_view name, double value) noexcept {
  return call::guarded<bool>([&](Result<bool>&) {
           check_value(option_named(method_options(), name), value);
           method.insert_or_assign(std::string(name), value);
         })
      .status;
}

}  // namespace api

graph::LayoutOptions call::layout_options(const Options& o) {
  graph::LayoutOptions options = defaults_of(o.mode, o.seed);
  if (o.patches < 0) throw Error(ErrorCode::bad_argument, "patches must be 0 (automatic) or more");
  options.patches = static_cast<Index>(o.patches);
  options.seed = o.seed;
  options.clean.strict = o.strict;
  if (!o.tolerance.empty()) options.tolerance = parse_length(o.tolerance);
  if (o.patches > 0 && options.tolerance.value > 0)
    throw Error(ErrorCode::bad_argument, "patches and tolerance exclude each other");
  if (!o.min_feature.empty()) options.min_feature = parse_length(o.min_feature);
  switch (o.subdivide) {
    case Subdivide::automatic:
      break;
    case Subdivide::faithful:
      options.form = graph::SubdivideForm::faithful;
      break;
    case Subdivide::compact:
      options.form = graph::SubdivideForm::compact;
      break;
    case Subdivide::quality:
      options.form = graph::SubdivideForm::quality;
      break;
  }
  const std::vector<OptionInfo> all = method_options(o.mode);
  for (const auto& [name, value] : o.method) check_value(option_named(all, name), value);
  graph::visit_options(options, [&](const char* name, auto& value, const char*, auto, auto) {
    const auto given = o.method.find(std::string_view(name));
    if (given != o.method.end()) value = static_cast<std::remove_reference_t<decltype(value)>>(given->second);
  });
  graph::check_options(options);
  return options;
}

}  // namespace intarsia
