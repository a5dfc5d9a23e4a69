#include "tools/view/page_data.h"

namespace intarsia::tools {

PageGrid grid_of(const MeshView& mesh) {
  PageGrid grid;
  grid.low = grid.high = mesh.point(mesh.corner.front());
  for (const Index v : mesh.corner)
    grid.low = grid.low.cwiseMin(mesh.point(v)), grid.high = grid.high.cwiseMax(mesh.point(v));
  grid.step = (grid.high - grid.low).maxCoeff() / kPageSteps;
  return grid;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u; };
    const std::uint32_t group = at(0) << 16 | at(1) << 8 | at(2);
    text += kDigit[group >> 18];
    text += kDigit[group >> 12 & 63];
    text += i + 1 < bytes.size() ? kDigit[group >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kDigit[group & 63] : '=';
  }
  return text;
}

std::string bytes_of_base64(const std::string& text) {
  const auto digit = [](char c) -> int {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
  };
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  int digits = 0, padding = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int d = c == '=' ? 0 : digit(c);
    if (d < 0 || (padding > 0 && c != '=')) return "";
    padding += c == '=' ? 1 : 0;
    group = group << 6 | static_cast<std::uint32_t>(d);
    if (++digits % 4 != 0) continue;
    for (int k = 2; k >= 0; --k)
      if (2 - k < 3 - padding) bytes += static_cast<char>(group >> 8 * k & 255);
    group = 0;
  }
  return digits % 4 == 0 && padding < 3 ? bytes : "";
}

}  // namespace intarsia::tools
