#include "tools/usual_flags.h"

#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "engine/io/extension.h"
#include "engine/run/context.h"

namespace intarsia::tools {

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && stop == end && value >= least && value <= most) return {};
    return most == std::numeric_limits<std::int64_t>::max()
               ? fmt::format("must be a whole number, {} or more, not '{}'", least, text)
               : fmt::format("must be a whole number from {} to {}, not '{}'", least, most, text);
  };
  return {check, ""};
}

CLI::Validator file_ending(std::string ending) {
  const auto check = [ending = std::move(ending)](const std::string& name) -> std::string {
    return lower_extension(name) == ending
               ? ""
               : fmt::format("'{}' must end with {}: that is what is written", name, ending);
  };
  return {check, ""};
}

void add_threads_flag(CLI::App& app, int& threads, const std::string& help) {
  app.add_option("-t,--threads", threads, help + "; 0 = all allowed processors")->check(whole_number(0, kMostThreads));
}

void add_memory_flag(CLI::App& app, std::uint64_t& bytes, const std::string& help) {
  // CLI11 takes what is below zero and makes a very large number of it.
  const auto check = [](std::string& text) -> std::string {
    if (!text.empty() && std::isdigit(static_cast<unsigned char>(text[0]))) return {};
    return fmt::format("must be a number of bytes, such as 800M or 12G, not '{}'", text);
  };
  app.add_option("--max-memory", bytes, help)
      ->transform(CLI::AsSizeValue(false))
      ->transform(CLI::Validator(check, ""));  // the last one comes first
}

void add_quiet_flag(CLI::App& app, bool& quiet) { app.add_flag("-q,--quiet", quiet, "print nothing but errors"); }

}  // namespace intarsia::tools
