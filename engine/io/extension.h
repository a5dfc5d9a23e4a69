// The ending of a file's name in small letters, as it tells the kind of file: ".ply" of "Scan.PLY".
#pragma once

#include <filesystem>
#include <string>

namespace intarsia {

inline std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

}  // namespace intarsia
