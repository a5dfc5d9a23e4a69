#include "engine/base/length.h"

#include <charconv>
#include <cmath>

#include "engine/base/error.h"

namespace intarsia {

Length parse_length(const std::string& text) {
  Length length;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, length.value);
  const std::string unit(rest, end);
  const bool known = unit.empty() || unit == "%" || unit == "e";
  if (error != std::errc() || !known || !std::isfinite(length.value) || length.value < 0)
    throw Error(ErrorCode::bad_argument, "'" + text +
                                             "' is no length: write 1.5 (units of the model), 0.2% (of the bounding "
                                             "box's diagonal) or 3e (mean edge lengths)");
  if (unit == "%") length.value /= 100, length.unit = Length::Unit::diagonal;
  if (unit == "e") length.unit = Length::Unit::edge;
  return length;
}

std::string text_of(const Length& length) {
  char text[64];
  const Real value = length.unit == Length::Unit::diagonal ? 100 * length.value : length.value;
  const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 12);
  std::string out(text, result.ptr);
  if (length.unit == Length::Unit::diagonal) out += "%";
  if (length.unit == Length::Unit::edge) out += "e";
  return out;
}

}  // namespace intarsia
