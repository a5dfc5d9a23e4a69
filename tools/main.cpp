// Picks a command, catches once, returns the exit status.
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "tools/commands.h"
#include "tools/config_file.h"
#include "tools/exit_code.h"
#include "tools/report.h"
#include "tools/shell_text.h"

namespace {

int fail(const intarsia::Error& e) {
  const std::string where = e.stage().empty() ? "" : e.stage() + ": ";
  if (e.code() == intarsia::ErrorCode::cancelled)
    spdlog::error("interrupted; nothing was written");
  else
    spdlog::error("{}{}", where, e.what());
  return intarsia::tools::exit_code_of(e.code());
}

// No command, or none of this name.
void explain_commands(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return;
  }
  const std::string& word = words.front();
  std::error_code unknown;
  if (std::filesystem::is_regular_file(word, unknown))
    std::fprintf(stderr, "'%s' is no command; for a layout of that mesh: intarsia run %s -o FOLDER\n", word.c_str(),
                 word.c_str());
  else
    std::fprintf(stderr, "'%s' is no command; intarsia --help lists them\n", word.c_str());
}

// What CLI11 says, and what may have been meant.
int usage_error(const CLI::App& app, const CLI::ParseError& e) {
  if (e.get_exit_code() != 0 && app.get_subcommands().empty())
    explain_commands(app);
  else if (app.exit(e) == 0)
    return intarsia::tools::kExitDone;
  const std::string hint = intarsia::tools::hint_for_unknown(app);
  if (!hint.empty()) std::fprintf(stderr, "%s\n", hint.c_str());
  return intarsia::tools::kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace intarsia::tools;
  spdlog::set_default_logger(spdlog::stderr_color_mt("intarsia"));
  spdlog::set_pattern("%n: %l: %v");
  CLI::App app("Intarsia: patch layouts of triangle meshes along their ridges and valleys", "intarsia");
  app.require_subcommand(1);
  app.set_version_flag("--version", "intarsia " INTARSIA_VERSION);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like any other
  int exit_code = kExitDone;
  add_run_command(app, exit_code);
  add_batch_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_step_command(app, exit_code);
  add_view_command(app, exit_code);
  add_render_command(app, exit_code);
  add_features_command(app, exit_code);
  add_info_command(app, exit_code);
  add_make_command(app, exit_code);
  add_table1_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_distance_command(app, exit_code);
  add_eval_command(app, exit_code);
  add_seg_eval_command(app, exit_code);
  add_baseline_command(app, exit_code);
  add_shell_commands(app, exit_code);
  allow_config_without_input(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return usage_error(app, e);
  } catch (const intarsia::Error& e) {
    return fail(e);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory; try a smaller mesh or more memory");
    return kExitLimit;
  } catch (const std::system_error& e) {
    spdlog::error("{}", e.what());  // of standard output; all other files have errors of their own
    return std::ferror(stdout) != 0 ? kExitWrite : kExitInternal;
  } catch (const std::exception& e) {
    spdlog::error("internal error: {}", e.what());
    return kExitInternal;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    spdlog::error("standard output cannot be written");
    return kExitWrite;
  }
  return exit_code;
}
