// Images as PNG files (8 bits, RGB), through libpng.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/picture/image.h"

namespace intarsia::tools {

// Requires: width * height pixels.
// Errors: write_failed.
std::vector<std::uint8_t> encode_png(const Image& image);

// Errors: write_failed; a file begun is removed.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace intarsia::tools
