// --config, --print-config: every option of a command in a TOML file, in and out.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "tools/option_flags.h"

namespace intarsia::tools {

void add_config_flags(CLI::App& app, CommonFlags& flags);

// Gives the command's options the values of the file, but for those that the command line gave. Keys are the names of
// options without dashes; `flat = 0.2` in a section `[scale]` is `scale.flat`. Call it first of all in the command's
// callback. Errors: bad_argument naming the file, the key and the nearest known one.
void apply_config(CLI::App& command, const std::string& file);

// What the command would run with, as such a file: the method's options with the values of their mode, and everything
// else that was given. Files and folders of this one run are left out.
std::string config_text(const CLI::App& command, const OptionFlags& method, const graph::LayoutOptions& options);

// With --print-config among the arguments nothing else has to be given.
void allow_config_without_input(CLI::App& app, int argc, char** argv);

// After a failed parse: "did you mean ...?" for the first word that no option or command took; empty if nothing is
// near.
std::string hint_for_unknown(const CLI::App& app);

}  // namespace intarsia::tools
