// "1 patch", "2 patches": numbers of things as people write them.
#pragma once

#include <string>

#include <fmt/format.h>

namespace intarsia::tools {

template <class Number>
std::string counted(Number n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

template <class Number>
std::string counted(Number n, const std::string& one) {
  return counted(n, one, one + "s");
}

}  // namespace intarsia::tools
