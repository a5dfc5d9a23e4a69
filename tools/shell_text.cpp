#include "tools/shell_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/exit_code.h"

namespace intarsia::tools {
namespace {

// Text that roff must not take for its own language.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\n')
      out += "\n.br\n";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

bool is_shown(const CLI::Option& option) { return !option.get_group().empty(); }

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  std::vector<const CLI::App*> out;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    if (!command->get_group().empty()) out.push_back(command);
  return out;
}

// "a|b|c" of an option that takes one of a few words, from what the check says of itself: TEXT:{a,b,c}.
std::vector<std::string> words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{"), close = type.rfind('}');
  std::vector<std::string> words;
  if (open == std::string::npos || close == std::string::npos || type.find("->") != std::string::npos) return words;
  for (std::size_t at = open + 2; at < close;) {
    const std::size_t comma = std::min(type.find(',', at), close);
    words.push_back(type.substr(at, comma - at));
    at = comma + 1;
  }
  return words;
}

// "-o, --output", or the name of a positional argument.
std::string names_of(const CLI::Option& option) {
  if (option.get_positional()) return option.get_single_name();
  std::string out;
  for (const std::string& name : option.get_snames()) out += (out.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) out += (out.empty() ? "--" : ", --") + name;
  return out;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

void describe(std::string& out, const CLI::Option& option) {
  out += ".TP\n\\fB" + roff(names_of(option)) + "\\fR";
  if (takes_value(option) && !option.get_positional()) {
    std::string word;
    for (const std::string& w : words_of(option)) word += (word.empty() ? "" : "|") + w;
    out += word.empty() ? " \\fIVALUE\\fR" : " \\fI" + roff(word) + "\\fR";
  }
  out += "\n" + roff(option.get_description());
  if (!option.get_default_str().empty()) out += roff(" (default: " + option.get_default_str() + ")");
  out += "\n";
}

void describe(std::string& out, const CLI::App& command) {
  out += ".SS \"intarsia " + roff(command.get_name());
  for (const CLI::Option* option : command.get_options())
    if (is_shown(*option) && option->get_positional())
      out += option->get_required() ? " " + roff(option->get_name()) : " [" + roff(option->get_name()) + "]";
  out += " [options]\"\n" + roff(command.get_description()) + "\n";
  const std::vector<const CLI::Option*> options = command.get_options();
  for (const bool method : {false, true}) {
    const auto belongs = [method](const CLI::Option* o) {
      return is_shown(*o) && (o->get_group() == "Method") == method;
    };
    if (std::none_of(options.begin(), options.end(), belongs)) continue;
    if (method) out += ".PP\nOptions of the method:\n";
    for (const CLI::Option* option : options)
      if (belongs(option)) describe(out, *option);
  }
}

// "--a --b -c" of everything that begins with a dash.
std::string dashed(const CLI::App& command) {
  std::string out;
  for (const CLI::Option* option : command.get_options()) {
    if (!is_shown(*option)) continue;
    for (const std::string& name : option->get_lnames()) out += "--" + name + " ";
    for (const std::string& name : option->get_snames()) out += "-" + name + " ";
  }
  if (!out.empty()) out.pop_back();
  return out;
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string out = ".TH INTARSIA 1 \"\" \"intarsia " INTARSIA_VERSION "\" \"User Commands\"\n";
  out += ".SH NAME\nintarsia \\- " + roff("patch layouts of triangle meshes along their ridges and valleys") + "\n";
  out += ".SH SYNOPSIS\n.B intarsia run\n.I mesh\n.B \\-o\n.I folder\n[\\fB\\-\\-patches\\fR \\fIn\\fR]\n.br\n";
  out += ".B intarsia\n.I command\n[\\fIoptions\\fR]\n";
  out +=
      ".SH DESCRIPTION\n" +
      roff(
          "Intarsia finds the ridges, valleys and creases of a triangle mesh, extends them "
          "until they form a closed network, divides what bends too much, and smooths the borders. Every triangle gets "
          "the number of its patch. Meshes are read as PLY, STL, OBJ or OFF; results are a folder of files.") +
      "\n";
  out += ".SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options())
    if (is_shown(*option)) describe(out, *option);
  out += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) describe(out, *command);
  out += ".SH EXIT STATUS\n";
  constexpr std::pair<int, const char*> kStatus[] = {
      {kExitDone, "done; a layout is complete and valid"},
      {kExitInternal, "internal error"},
      {kExitUsage, "wrong usage"},
      {kExitUnreadable, "input unreadable"},
      {kExitRejected, "input rejected: readable, but no surface that the method can take"},
      {kExitDegraded, "finished, but a guarantee of the layout does not hold"},
      {kExitLimit, "stopped by a limit of memory, size or time"},
      {kExitWrite, "output could not be written"},
      {kExitBatch, "batch: some meshes failed"},
      {kExitInterrupted, "interrupted; nothing was written"}};
  for (const auto& [status, text] : kStatus) out += fmt::format(".TP\n.B {}\n{}\n", status, roff(text));
  out += ".SH EXAMPLES\n.nf\n" + roff(
                                     "intarsia make part -o part.ply\nintarsia run part.ply -o out --patches 40\n"
                                     "intarsia view out");
  out += "\n.fi\n";
  return out;
}

std::string bash_completion(const CLI::App& app) {
  std::string commands;
  for (const CLI::App* command : commands_of(app)) commands += command->get_name() + " ";
  std::string out = "# bash completion for intarsia " INTARSIA_VERSION "\n_intarsia() {\n";
  out += "  local cur=\"${COMP_WORDS[COMP_CWORD]}\" prev=\"\" command=\"\" options=\"\" values=\"\" i\n";
  out += "  ((COMP_CWORD > 0)) && prev=\"${COMP_WORDS[COMP_CWORD-1]}\"\n";
  out += "  for ((i = 1; i < COMP_CWORD; ++i)); do\n";
  out += "    [[ \"${COMP_WORDS[i]}\" != -* ]] && command=\"${COMP_WORDS[i]}\" && break\n  done\n";
  out += "  COMPREPLY=()\n";
  out += "  if [[ -z \"$command\" ]]; then\n";
  out += "    COMPREPLY=($(compgen -W \"" + commands + dashed(app) + "\" -- \"$cur\"))\n    return\n  fi\n";
  out += "  case \"$command\" in\n";
  for (const CLI::App* command : commands_of(app)) {
    out += "    " + command->get_name() + ")\n      options=\"" + dashed(*command) + "\"\n";
    std::string cases;
    for (const CLI::Option* option : command->get_options()) {
      if (!is_shown(*option)) continue;
      std::string words;
      for (const std::string& w : words_of(*option)) words += (words.empty() ? "" : " ") + w;
      if (words.empty()) continue;
      if (option->get_positional()) {
        out += "      values=\"" + words + "\"\n";
        continue;
      }
      std::string names = names_of(*option);
      for (std::size_t comma; (comma = names.find(", ")) != std::string::npos;) names.replace(comma, 2, "|");
      cases += "        " + names + ") COMPREPLY=($(compgen -W \"" + words + "\" -- \"$cur\")); return ;;\n";
    }
    if (!cases.empty()) out += "      case \"$prev\" in\n" + cases + "      esac\n";
    out += "      ;;\n";
  }
  out += "  esac\n";
  out += "  if [[ \"$cur\" == -* ]]; then\n    COMPREPLY=($(compgen -W \"$options\" -- \"$cur\"))\n";
  out += "  elif [[ -n \"$values\" && \"$prev\" == \"$command\" ]]; then\n";
  out += "    COMPREPLY=($(compgen -W \"$values\" -- \"$cur\"))\n";
  out += "  else\n    compopt -o filenames 2>/dev/null\n    COMPREPLY=($(compgen -f -- \"$cur\"))\n  fi\n}\n";
  out += "complete -F _intarsia intarsia\n";
  return out;
}

std::string zsh_completion(const CLI::App& app) {
  return "#compdef intarsia\nautoload -U +X bashcompinit && bashcompinit\n" + bash_completion(app);
}

void add_shell_commands(CLI::App& app, int& exit_code) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion = app.add_subcommand("completion", "print the completion for a shell; source it to try it");
  completion->add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->callback([&app, &exit_code, shell] {
    fmt::print("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app));
    exit_code = kExitDone;
  });
  CLI::App* man = app.add_subcommand("man-page", "print the manual page")->group("");
  man->callback([&app, &exit_code] {
    fmt::print("{}", man_page(app));
    exit_code = kExitDone;
  });
}

}  // namespace intarsia::tools
