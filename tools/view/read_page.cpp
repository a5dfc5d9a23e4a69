#include "tools/view/read_page.h"

#include "engine/base/error.h"
#include "tools/view/write_page.h"

namespace intarsia::tools {
namespace {

// Every read is checked: a page may have been cut or edited.
class PageReader {
 public:
  PageReader(const std::filesystem::path& page, std::string_view bytes) : page_(page), bytes_(bytes) {}

  std::uint32_t whole() {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 7) {
      const std::uint32_t byte = next();
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
    damaged();
  }
  std::int32_t integer() {
    const std::uint32_t folded = whole();
    return folded % 2 ? -static_cast<std::int32_t>(folded / 2) - 1 : static_cast<std::int32_t>(folded / 2);
  }
  void skip(std::size_t n) {
    if (n > bytes_.size() - at_) damaged();
    at_ += n;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void damaged() const {
    throw Error(ErrorCode::bad_file, page_.string() + ": its lines are damaged; let intarsia run write it again");
  }

 private:
  std::uint32_t next() {
    if (at_ >= bytes_.size()) damaged();
    return static_cast<unsigned char>(bytes_[at_++]);
  }

  const std::filesystem::path& page_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

PageLines read_lines(PageReader& from, const PageGrid& grid, std::size_t measures) {
  PageLines lines;
  const std::uint32_t count = from.whole(), total = from.whole();
  if (count > from.left() || total > from.left()) from.damaged();
  std::int64_t step[3] = {0, 0, 0};
  for (std::uint32_t l = 0; l < count; ++l) {
    const std::uint32_t kind = from.whole(), points = from.whole();
    if (kind >= kCurveKinds || points > total - lines.point.size()) from.damaged();
    from.skip(measures * sizeof(float));
    for (std::uint32_t i = 0; i < points; ++i) {
      for (std::int64_t& s : step) s += from.integer();
      lines.point.push_back(grid.low + grid.step * Vec3(static_cast<Real>(step[0]), static_cast<Real>(step[1]),
                                                        static_cast<Real>(step[2])));
    }
    lines.kind.push_back(static_cast<CurveKind>(kind));
    lines.offset.push_back(lines.point.size());
  }
  return lines;
}

}  // namespace

PageFeatures page_features(const std::filesystem::path& page, std::string_view bytes, const PageGrid& grid) {
  PageReader from(page, bytes);
  PageFeatures features;
  features.raw = read_lines(from, grid, 3);  // L, R and T
  features.chosen = read_lines(from, grid, 0);
  return features;
}

PageFeatures read_page_features(const std::filesystem::path& page, const PageGrid& grid) {
  const std::string bytes = bytes_of_base64(read_page_parts(page).features);
  if (bytes.empty()) {
    const bool exists = std::filesystem::exists(page);
    throw Error(ErrorCode::bad_file, page.string() +
                                         (exists ? ": it has no feature lines" : ": there is no such page") +
                                         ", and the lines before the patches are kept there alone; write it with "
                                         "intarsia run MESH -o DIR --write html");
  }
  return page_features(page, bytes, grid);
}

}  // namespace intarsia::tools
