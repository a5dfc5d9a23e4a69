// Flags that many commands have, and checks of values that say what is wanted.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <CLI/CLI.hpp>

namespace intarsia::tools {

// A whole number from `least` to `most`.
CLI::Validator whole_number(std::int64_t least, std::int64_t most = std::numeric_limits<std::int64_t>::max());

// The name of a file that ends like this (".ply"), in large or small letters: what is written has that form.
CLI::Validator file_ending(std::string ending);

// --max-memory: bytes, or with K M G (of 1024). 0 is no limit.
void add_memory_flag(CLI::App& app, std::uint64_t& bytes, const std::string& help);
void add_threads_flag(CLI::App& app, int& threads, const std::string& help = "threads");
void add_quiet_flag(CLI::App& app, bool& quiet);

}  // namespace intarsia::tools
