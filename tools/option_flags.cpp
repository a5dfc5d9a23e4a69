#include "tools/option_flags.h"

#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "graph/layout_graph.h"
#include "graph/visit_options.h"
#include "tools/config_file.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

CLI::Validator yes_or_no() {
  const auto check = [](const std::string& text) -> std::string {
    for (const char* word : {"0", "1", "true", "false", "on", "off", "yes", "no"})
      if (text == word) return {};
    return "must be true or false, 1 or 0, not '" + text + "'";
  };
  return {check, ""};
}

CLI::Validator number(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && stop == end && value >= least && value <= most) return {};
    return fmt::format("must be a number from {:g} to {:g}, not '{}'", least, most, text);
  };
  return {check, ""};
}

}  // namespace

void add_common_flags(CLI::App& app, CommonFlags& flags) {
  add_threads_flag(app, flags.threads);
  app.add_option("--mode", flags.mode, "robust, or paper (the letter of Cao, Yan, Wonka 2014)")
      ->check(CLI::IsMember({"robust", "paper"}))
      ->capture_default_str();
  app.add_option("--subdivide", flags.subdivide,
                 "compact: new seeds and borders where they make the rebuilt surface better; quality: over-segment and "
                 "merge by that error, better yet and more winding; faithful: the paper's. Default: compact")
      ->check(CLI::IsMember({"compact", "quality", "faithful"}));
  app.add_option("--order", flags.order, "fixed: same bits on any number of threads; relaxed: to show what that costs")
      ->check(CLI::IsMember({"fixed", "relaxed"}))
      ->capture_default_str();
  app.add_option("--seed", flags.seed, "of the random subdivision seeds in paper mode")
      ->check(whole_number(0))
      ->capture_default_str();
  add_memory_flag(app, flags.max_memory,
                  "refuse at once what would need more memory, by forecast: bytes, or with K M G (of 1024)");
  add_length_flag(app, "--min-feature", flags.min_feature, "details below this size get no patches");
  app.add_flag("--strict", flags.strict, "refuse a mesh that is no oriented 2-manifold instead of mending it");
  app.add_option("--report", flags.report, "write the report to this file too");
  app.add_option("--trace", flags.trace, "write a Chrome trace of the stages to this file");
  app.add_option("--progress", flags.progress,
                 "on standard error: bar (with the time left), lines, json (a line for each event), none; auto: bar on "
                 "a terminal, else lines")
      ->check(CLI::IsMember({"auto", "bar", "lines", "json", "none"}))
      ->capture_default_str();
  add_quiet_flag(app, flags.quiet);
  add_config_flags(app, flags);
}

CLI::Option* add_length_flag(CLI::App& app, const std::string& name, Length& length, const std::string& help) {
  const auto set = [&length](const std::string& text) { length = parse_length(text); };
  const auto check = [](const std::string& text) -> std::string {
    try {
      parse_length(text);
    } catch (const Error& e) {
      return e.what();
    }
    return {};
  };
  return app
      .add_option_function<std::string>(name, set, help + ": 1.5 (model units), 2% (of the diagonal), 4e (mean edges)")
      ->check(check)
      ->type_name("LENGTH");
}

void OptionFlags::add_to(CLI::App& app) {
  graph::visit_options(given_values_, [&](const char* name, auto& value, const char* help, auto least, auto most) {
    CLI::Option* flag = app.add_option(std::string("--") + name, value, help)->capture_default_str();
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>)
      flag->check(yes_or_no());
    else if constexpr (std::is_integral_v<Value>)
      flag->check(whole_number(static_cast<std::int64_t>(least), static_cast<std::int64_t>(most)));
    else
      flag->check(number(least, most));
    flag->group("Method");
    flags_.emplace_back(name, flag);
  });
}

graph::LayoutOptions OptionFlags::options(const CommonFlags& common) const {
  graph::LayoutOptions options = common.mode == "paper" ? graph::paper_options(common.seed) : graph::robust_options();
  options.seed = common.seed;
  options.clean.strict = common.strict, options.min_feature = common.min_feature;
  if (!common.subdivide.empty())
    options.form = common.subdivide == "faithful"  ? graph::SubdivideForm::faithful
                   : common.subdivide == "quality" ? graph::SubdivideForm::quality
                                                   : graph::SubdivideForm::compact;
  std::vector<Real> given;
  graph::visit_options(given_values_, [&](const char*, const auto& value, const char*, auto, auto) {
    given.push_back(static_cast<Real>(value));
  });
  std::size_t i = 0;
  graph::visit_options(options, [&](const char*, auto& value, const char*, auto, auto) {
    if (flags_[i].second->count() > 0) value = static_cast<std::remove_reference_t<decltype(value)>>(given[i]);
    ++i;
  });
  graph::check_options(options);
  return options;
}

nlohmann::json OptionFlags::to_json(const graph::LayoutOptions& options) const {
  nlohmann::json out;
  std::size_t i = 0;
  graph::visit_options(options, [&](const char* name, const auto& value, const char*, auto, auto) {
    out[name] = {{"value", value}, {"given", flags_[i].second->count() > 0}};
    ++i;
  });
  return out;
}

}  // namespace intarsia::tools
