#include "tools/picture/png_file.h"

#include <csetjmp>
#include <cstdio>
#include <new>
#include <string>

#include <png.h>

#include "engine/base/error.h"

namespace intarsia::tools {
namespace {

constexpr int kCompression = 4;  // half the time of the default, files a tenth larger

// libpng leaves by longjmp, which skips destructors: everything with a destructor lives here, outside the jump.
struct Sink {
  std::vector<std::uint8_t> bytes;
  char message[128] = "";
};

void take(png_structp png, png_bytep data, png_size_t size) {
  bool ok = true;
  try {
    auto& bytes = static_cast<Sink*>(png_get_io_ptr(png))->bytes;
    bytes.insert(bytes.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    ok = false;
  }
  if (!ok) png_error(png, "out of memory");
}

void no_flush(png_structp) {}

void keep_message(png_structp png, png_const_charp text) {
  std::snprintf(static_cast<Sink*>(png_get_error_ptr(png))->message, sizeof Sink::message, "%s", text);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

bool encode(const Image& image, Sink& sink) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, keep_message, ignore_warning);
  if (!png) return false;
  png_infop info = png_create_info_struct(png);
  if (!info) {
    png_destroy_write_struct(&png, nullptr);
    return false;
  }
  if (setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &sink, take, no_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, kCompression);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(png, info);
  const std::size_t width = static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y)
    png_write_row(png, reinterpret_cast<png_const_bytep>(image.pixel.data() + static_cast<std::size_t>(y) * width));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  static_assert(sizeof(Rgb) == 3);
  Sink sink;
  if (!encode(image, sink))
    throw Error(ErrorCode::write_failed, std::string("the picture could not be encoded: ") + sink.message);
  return std::move(sink.bytes);
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) throw Error(ErrorCode::write_failed, "cannot create " + path.string());
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (std::fclose(file) == 0 && written) return;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw Error(ErrorCode::write_failed, "cannot write " + path.string() + ": disk full?");
}

}  // namespace intarsia::tools
