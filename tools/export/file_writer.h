// A file that is written piece by piece: text or little-endian bytes, a megabyte at a time, whole or not there.
#pragma once

#include <bit>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/io/write_file.h"

namespace intarsia::tools {

static_assert(std::endian::native == std::endian::little);

class FileWriter {
 public:
  // Errors (of all members): write_failed naming the file.
  explicit FileWriter(const std::filesystem::path& path) : file_(path) { buffer_.reserve(kRoom + 4096); }

  template <class... T>
  void text(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<T>(values)...);
    spill();
  }
  void bytes(std::string_view b) {
    buffer_.append(b);
    spill();
  }
  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    buffer_.append(raw, sizeof(T));
    spill();
  }
  void commit() {
    file_.write(buffer_);
    buffer_.clear();
    file_.commit();
  }

 private:
  static constexpr std::size_t kRoom = std::size_t{1} << 20;
  void spill() {
    if (buffer_.size() < kRoom) return;
    file_.write(buffer_);
    buffer_.clear();
  }

  AtomicFile file_;
  std::string buffer_;
};

}  // namespace intarsia::tools
