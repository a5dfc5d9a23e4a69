#include "tools/view/page_data.h"

namespace intarsia::tools {

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

}  // namespace intarsia::tools
