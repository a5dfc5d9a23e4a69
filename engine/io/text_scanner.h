// Blank-separated words of a text in memory, and numbers from words. Independent of the locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <system_error>

namespace intarsia {

inline bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f'; }

class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  // The next word; empty at the end of the text.
  std::string_view word() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* begin = at_;
    while (at_ != end_ && !is_blank(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }
  // What is left of the current line, without its end; moves to the next line. Ends: \n, \r\n, \r.
  std::string_view line() {
    const char* begin = at_;
    while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
    const std::string_view text(begin, static_cast<std::size_t>(at_ - begin));
    if (at_ != end_ && *at_ == '\r') ++at_;
    if (at_ != end_ && *at_ == '\n' && (at_ == begin + text.size() || at_[-1] == '\r')) ++at_;
    return text;
  }
  bool at_end() const { return at_ == end_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  const char* at_;
  const char* end_;
};

// The whole word must be the number. Values beyond the range of T become infinite or zero, as in IEEE arithmetic.
template <class T>
bool parse_real(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc{}) return stop == end && !word.empty();
  if (error != std::errc::result_out_of_range || stop != end) return false;
  long double wide = 0;
  if (std::from_chars(word.data(), end, wide).ec != std::errc{}) return false;
  value = static_cast<T>(wide);
  return true;
}

inline bool parse_integer(std::string_view word, std::int64_t& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace intarsia
