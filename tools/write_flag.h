// --write of the commands that make results.
#pragma once

#include <filesystem>

#include <CLI/CLI.hpp>

#include "tools/write_result.h"

namespace intarsia::tools {

struct WriteFlag {
  std::vector<std::string> list;
  CLI::Option* option = nullptr;

  // Errors: bad_argument with a suggestion.
  Exports exports(const std::string& input) const {
    Exports e;
    e.is_default = option->count() == 0;
    e.files = export_files(e.is_default ? default_exports() : list);
    e.name = std::filesystem::path(input).filename().string();
    return e;
  }
};

inline void add_write_flag(CLI::App& app, WriteFlag& flag, const std::string& otherwise) {
  flag.option = app.add_option("--write", flag.list, export_help() + "; default: " + otherwise)->delimiter(',');
}

}  // namespace intarsia::tools
