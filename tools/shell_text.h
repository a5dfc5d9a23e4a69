// The program's manual page and its completion in shells, made from the commands and options themselves.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace intarsia::tools {

// intarsia(1) as roff.
std::string man_page(const CLI::App& app);

// For bash: commands, options, and the values of options that have a few; files everywhere else.
std::string bash_completion(const CLI::App& app);
// The same for zsh, by its emulation of bash's.
std::string zsh_completion(const CLI::App& app);

// intarsia completion bash|zsh, and the hidden intarsia man-page.
void add_shell_commands(CLI::App& app, int& exit_code);

}  // namespace intarsia::tools
