#include "tools/config_file.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/nearest_word.h"

namespace intarsia::tools {
namespace {

// Of one run, not of the method.
const std::set<std::string>& personal() {
  static const std::set<std::string> names = {"help",   "config", "print-config", "dry-run", "input",   "output",
                                              "report", "trace",  "checkpoint",   "quiet",   "progress"};
  return names;
}

std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_single_name() : option.get_lnames().front();
}

std::vector<std::string> names_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* o : command.get_options())
    if (o->get_configurable() && name_of(*o) != "help" && name_of(*o) != "config") names.push_back(name_of(*o));
  return names;
}

CLI::Option* find(CLI::App& command, const std::string& name) {
  for (CLI::Option* o : command.get_options())
    if (name_of(*o) == name) return o;
  return nullptr;
}

std::string quoted(const std::string& value) {
  const bool plain =
      !value.empty() && (value == "true" || value == "false" ||
                         (value.find_first_not_of("0123456789.+-e") == std::string::npos &&
                          value.find_first_of("0123456789") != std::string::npos && value.back() != 'e'));
  return plain ? value : '"' + value + '"';
}

std::string value_text(const std::vector<std::string>& values) {
  if (values.size() == 1) return quoted(values.front());
  std::string list;
  for (const std::string& v : values) list += (list.empty() ? "" : ", ") + quoted(v);
  return "[" + list + "]";
}

}  // namespace

void add_config_flags(CLI::App& app, CommonFlags& flags) {
  app.add_option("--config", flags.config, "options from a TOML file; what the command line gives comes first")
      ->check(CLI::ExistingFile);
  app.add_flag("--print-config", flags.print_config, "print such a file with everything this run would use, and stop");
}

void apply_config(CLI::App& command, const std::string& file) {
  if (file.empty()) return;
  const auto bad = [&](const std::string& why) { return Error(ErrorCode::bad_argument, file + ": " + why); };
  std::vector<CLI::ConfigItem> items;
  try {
    items = CLI::ConfigTOML().from_file(file);
  } catch (const CLI::Error& e) {
    throw bad(e.what());
  }
  for (const CLI::ConfigItem& item : items) {
    if (item.name == "++" || item.name == "--") continue;  // where sections begin and end
    const std::string name = item.fullname();
    CLI::Option* option = find(command, name);
    if (option == nullptr || name == "help" || name == "config") {
      const std::string near = likely_word(name, names_of(command));
      throw bad("there is no option '" + name + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    if (option->count() > 0) continue;
    try {
      for (const std::string& value : item.inputs) option->add_result(value);
      option->run_callback();
    } catch (const CLI::Error& e) {
      throw bad("'" + name + "': " + e.what());
    }
  }
}

std::string config_text(const CLI::App& command, const OptionFlags& method, const graph::LayoutOptions& options) {
  std::string top;
  std::map<std::string, std::string> sections;
  const auto add = [&](const std::string& name, const std::string& value) {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos)
      top += name + " = " + value + "\n";
    else
      sections[name.substr(0, dot)] += name.substr(dot + 1) + " = " + value + "\n";
  };
  const nlohmann::json values = method.to_json(options);
  for (const CLI::Option* o : command.get_options()) {
    const std::string name = name_of(*o);
    if (personal().count(name) != 0 || !o->get_configurable()) continue;
    if (values.contains(name)) {
      const nlohmann::json& value = values[name]["value"];
      if (value != nlohmann::json(kNone)) add(name, value.dump());  // kNone: without limit, which has no number
    } else if (o->count() > 0) {
      add(name, o->get_expected_min() == 0 ? "true" : value_text(o->results()));
    } else if (!o->get_default_str().empty()) {
      add(name, quoted(o->get_default_str()));
    }
  }
  std::string text = "# " + command.get_name() + ": options of intarsia " INTARSIA_VERSION "\n" + top;
  for (const auto& [section, lines] : sections) text += "\n[" + section + "]\n" + lines;
  return text;
}

void allow_config_without_input(CLI::App& app, int argc, char** argv) {
  if (std::none_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--print-config"; })) return;
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options()) option->required(false);
}

std::string hint_for_unknown(const CLI::App& app) {
  std::vector<std::string> unknown = app.remaining(true), known;
  const std::vector<CLI::App*> used = app.get_subcommands();
  if (used.empty()) {
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(command->get_name());
  } else {
    for (const std::string& name : names_of(*used.front())) known.push_back("--" + name);
    std::erase_if(unknown, [](const std::string& word) { return word.rfind("--", 0) != 0; });
  }
  if (unknown.empty()) return {};
  const std::string near = likely_word(unknown.front().substr(0, unknown.front().find('=')), known);
  return near.empty() ? std::string() : "Did you mean " + near + "?";
}

}  // namespace intarsia::tools
