// Writes PLY text or bytes value by value, in any of the three formats: the counterpart of the reader, for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

namespace intarsia::test {

class PlyBuilder {
 public:
  explicit PlyBuilder(std::string format, std::string line_end = "\n")
      : format_(std::move(format)), end_(std::move(line_end)) {
    line("ply");
    line("format " + format_ + " 1.0");
  }
  PlyBuilder& line(const std::string& text) {
    bytes_ += text + end_;
    return *this;
  }
  // A value of the PLY type named.
  PlyBuilder& put(const std::string& type, double value) {
    if (format_ == "ascii") {
      std::ostringstream text;
      text.precision(17);
      text << value;
      bytes_ += text.str() + " ";
    } else if (type == "char" || type == "int8") {
      raw(static_cast<std::int8_t>(value));
    } else if (type == "uchar" || type == "uint8") {
      raw(static_cast<std::uint8_t>(value));
    } else if (type == "short" || type == "int16") {
      raw(static_cast<std::int16_t>(value));
    } else if (type == "ushort" || type == "uint16") {
      raw(static_cast<std::uint16_t>(value));
    } else if (type == "int" || type == "int32") {
      raw(static_cast<std::int32_t>(value));
    } else if (type == "uint" || type == "uint32") {
      raw(static_cast<std::uint32_t>(value));
    } else if (type == "float" || type == "float32") {
      raw(static_cast<float>(value));
    } else {
      raw(value);
    }
    return *this;
  }
  // The end of an item; only text shows it.
  PlyBuilder& item() {
    if (format_ == "ascii") bytes_ += end_;
    return *this;
  }
  PlyBuilder& bytes(const std::string& more) {
    bytes_ += more;
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  template <class T>
  void raw(T value) {
    char text[sizeof(T)];
    std::memcpy(text, &value, sizeof(T));
    if (format_ == "binary_big_endian") std::reverse(text, text + sizeof(T));
    bytes_.append(text, sizeof(T));
  }

  std::string format_, end_, bytes_;
};

}  // namespace intarsia::test
