#include "tools/picture/png_file.h"

#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>
#include <png.h>

#include "engine/base/error.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11),
                        static_cast<std::uint8_t>(x * y)};
  return image;
}

Image decode(const std::vector<std::uint8_t>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) != 0);
  CHECK(PNG_IMAGE_SAMPLE_CHANNELS(png.format) == 3);
  png.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  REQUIRE(png_image_finish_read(&png, nullptr, image.pixel.data(), 0, nullptr) != 0);
  return image;
}

}  // namespace

TEST_CASE("an image comes back from libpng as it went in") {
  for (const auto& [w, h] : {std::pair{1, 1}, {37, 5}, {200, 133}}) {
    const Image image = gradient(w, h), back = decode(encode_png(image));
    CHECK(back.width == w);
    CHECK(back.height == h);
    CHECK(back.pixel == image.pixel);
  }
}

TEST_CASE("a file holds the same bytes") {
  const auto path = std::filesystem::temp_directory_path() / "intarsia_png_file_test.png";
  const Image image = gradient(64, 48);
  write_png(path, image);
  std::ifstream in(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  CHECK(bytes == encode_png(image));
  std::filesystem::remove(path);
}

TEST_CASE("failures are write errors") {
  const auto code_of = [](const auto& call) {
    try {
      call();
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::internal;
  };
  CHECK(code_of([] { write_png("/nonexistent-folder/preview.png", gradient(4, 4)); }) == ErrorCode::write_failed);
  CHECK(code_of([] { encode_png(Image()); }) == ErrorCode::write_failed);  // libpng refuses it: the jump is caught
}
