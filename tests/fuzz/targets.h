// What is fed with arbitrary bytes: every reader, and the stage that makes a surface of what they deliver. Used by
// libFuzzer (preset fuzz) and, for seconds, by the ordinary tests.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace intarsia::fuzz {

struct Target {
  const char* name;
  // Throws std::logic_error if a promise is broken; everything else that happens must be a clean refusal.
  void (*run)(std::string_view bytes);
  std::vector<std::string> (*seeds)();
};

// ply stl obj off labels surface
std::span<const Target> targets();
const Target& target(std::string_view name);

}  // namespace intarsia::fuzz
