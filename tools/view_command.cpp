#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "tools/commands.h"
#include "tools/exit_code.h"

namespace intarsia::tools {
namespace {

namespace fs = std::filesystem;

fs::path page_of(const fs::path& input) {
  std::error_code error;
  if (fs::is_regular_file(input, error)) {
    if (input.extension() == ".html") return fs::canonical(input);
    throw Error(ErrorCode::bad_file, input.string() + ": is no page; give the folder that intarsia run wrote");
  }
  const fs::path page = input / "view.html";
  if (fs::is_regular_file(page, error)) return fs::canonical(page);
  if (!fs::is_directory(input, error)) throw Error(ErrorCode::bad_file, input.string() + ": there is no such folder");
  throw Error(ErrorCode::bad_file, input.string() + ": it holds no view.html; write one with: intarsia convert " +
                                       input.string() + " --write html");
}

bool has_display() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* value = std::getenv(name); value && *value) return true;
  return false;
}

// The desktop's opener, which returns at once. False if there is none, or if it fails.
bool open_page(const fs::path& page) {
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::execlp("xdg-open", "xdg-open", page.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  struct Flags {
    std::string input;
    bool print = false;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("view", "open the page of a result in the browser");
  command->add_option("input", flags->input, "folder written by intarsia run, or a page")->required();
  command->add_flag("--print", flags->print, "only print where the page is");
  command->callback([flags, &exit_code] {
    const fs::path page = page_of(flags->input);
    fmt::print("{}\n", page.string());
    if (!flags->print && !(has_display() && open_page(page)))
      spdlog::info("no browser could be started here; open the file above in one");
    exit_code = kExitDone;
  });
}

}  // namespace intarsia::tools
