#include "engine/io/file_error.h"

#include <system_error>

namespace intarsia {

void throw_bad_file(const std::filesystem::path& path, const std::string& what, const std::string& cure,
                    std::uint64_t element) {
  const Index id = element < kNone ? static_cast<Index>(element) : kNone;
  throw Error(ErrorCode::bad_file, path.string() + ": " + what + "; " + cure, id);
}

void throw_write_failed(const std::filesystem::path& path, const std::string& what, int errno_value) {
  std::string message = path.string() + ": " + what;
  if (errno_value != 0) message += " (" + std::generic_category().message(errno_value) + ")";
  throw Error(ErrorCode::write_failed, message);
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown;
  for (const char c : text.substr(0, kLongest)) {
    const auto u = static_cast<unsigned char>(c);
    shown += u < 0x20 || u >= 0x7f ? '?' : c;
  }
  return text.size() > kLongest ? shown + "..." : shown;
}

}  // namespace intarsia
