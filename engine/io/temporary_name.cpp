#include "engine/io/temporary_name.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>

#include <unistd.h>

#include "engine/base/hash.h"

namespace intarsia {
namespace {

constexpr std::string_view kMark = ".intarsia-";

std::string hex(std::uint64_t value, int digits) {
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "%0*llx", digits, static_cast<unsigned long long>(value));
  return text.data();
}

std::uint64_t hash_of(std::string_view text) {
  Hash hash;
  hash.add(text);
  return hash.value();
}

// The part of the name that says what it stands for, for which target, on which host.
std::string prefix(Temporary kind, const std::filesystem::path& target) {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return std::string(kMark) + (kind == Temporary::new_result ? "new-" : "old-") +
         hex(hash_of(target.filename().string()), 16) + "-" + hex(hash_of(host.data()) & 0xffffffffu, 8) + "-";
}

}  // namespace

std::string temporary_name(Temporary kind, const std::filesystem::path& target) {
  static std::atomic<unsigned> counter{0};
  return prefix(kind, target) + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

bool is_abandoned(std::string_view name, Temporary kind, const std::filesystem::path& target) {
  const std::string begin = prefix(kind, target);
  if (name.substr(0, begin.size()) != begin) return false;
  name.remove_prefix(begin.size());
  pid_t owner = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), owner);
  if (error != std::errc{} || stop == name.data() + name.size() || *stop != '-' || owner <= 0) return false;
  return ::kill(owner, 0) != 0 && errno == ESRCH;
}

bool is_temporary_name(std::string_view name) {
  return name.substr(0, kMark.size()) == kMark &&
         (name.substr(kMark.size(), 4) == "new-" || name.substr(kMark.size(), 4) == "old-");
}

}  // namespace intarsia
