// The manual page names everything that --help names; the completion completes in a real bash.
#include <algorithm>
#include <regex>
#include <set>

#include <doctest/doctest.h>

#include "tests/tools/program.h"
#include "tools/exit_code.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  std::vector<std::string> out;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) out.push_back((*i)[1]);
  return out;
}

// Commands as the program's help lists them: two spaces, a name, spaces, what it does, below "Subcommands:".
std::vector<std::string> commands_in(const std::string& help) {
  return matches(help.substr(help.find("Subcommands:")), "^  ([a-z][a-z0-9-]+) ");
}

std::string without_dashes_escaped(std::string roff) {
  for (std::size_t at; (at = roff.find("\\-")) != std::string::npos;) roff.replace(at, 2, "-");
  return roff;
}

}  // namespace

TEST_CASE("the manual page has every command and every option of --help") {
  const test::ProgramFolder dir("man");
  const auto run = [&](const std::vector<std::string>& arguments) {
    const auto r = test::run_program(INTARSIA_PROGRAM, arguments, dir);
    REQUIRE(r.status == kExitDone);
    return r.out;
  };
  const std::string page = run({"man-page"}), plain = without_dashes_escaped(page);
  const std::vector<std::string> commands = commands_in(run({"--help"}));
  REQUIRE(commands.size() >= 14);
  std::size_t options = 0;
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::size_t begin = plain.find(".SS \"intarsia " + command + " ");
    REQUIRE(begin != std::string::npos);
    const std::string section = plain.substr(begin, plain.find("\n.S", begin + 1) - begin);
    for (const std::string& option : matches(run({command, "--help"}), "^ +(?:-[a-zA-Z],)?(--[a-z][a-z0-9.-]*)")) {
      CAPTURE(option);
      ++options;
      CHECK(section.find(option) != std::string::npos);
    }
  }
  CHECK(options > 150);
  // Where groff is installed: it has nothing to complain about.
  if (std::system("command -v groff >/dev/null") == 0) {
    std::ofstream(dir / "intarsia.1", std::ios::binary) << page;
    const std::string line = "groff -man -Tutf8 -ww -z '" + (dir / "intarsia.1") + "' 2>'" + (dir / "groff.txt") + "'";
    CHECK(std::system(line.c_str()) == 0);
    CHECK(test::file_text(dir / "groff.txt") == "");
  }
}

TEST_CASE("completion: commands, options, values of options") {
  const test::ProgramFolder dir("completion");
  if (std::system("command -v bash >/dev/null") != 0) {
    MESSAGE("skipped: no bash");
    return;
  }
  const auto r = test::run_program(INTARSIA_PROGRAM, {"completion", "bash"}, dir);
  REQUIRE(r.status == kExitDone);
  std::ofstream(dir / "intarsia.bash", std::ios::binary) << r.out;
  const auto complete = [&](const std::string& words) {
    const std::string script = "cd '" + (dir / "") + "'; source intarsia.bash; COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _intarsia; echo \"${COMPREPLY[@]}\"";
    const auto result = test::run_program("/bin/bash", {"-c", script}, dir);
    CHECK(result.err == "");
    return result.out;
  };
  CHECK(complete("intarsia ru") == "run\n");
  CHECK(complete("intarsia fea") == "features\n");
  CHECK(complete("intarsia man") == "\n");
  CHECK(complete("intarsia run --pane") == "--panels\n");
  CHECK(complete("intarsia run part.ply --mode ''") == "robust paper\n");
  CHECK(complete("intarsia run part.ply --subdivide q") == "quality\n");
  CHECK(complete("intarsia run intarsia.ba") == "intarsia.bash\n");
  CHECK(complete("intarsia completion z") == "zsh\n");
  const auto zsh = test::run_program(INTARSIA_PROGRAM, {"completion", "zsh"}, dir);
  CHECK(zsh.out.rfind("#compdef intarsia\n", 0) == 0);
}
