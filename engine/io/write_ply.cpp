#include "engine/io/write_ply.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "engine/io/file_error.h"
#include "engine/io/write_file.h"
#include "engine/parallel/for_each.h"

namespace intarsia {

static_assert(std::endian::native == std::endian::little);

PlyFile::Element& PlyFile::Element::triangles(std::span<const Index> corner) {
  if (corner.size() != 3 * count_) wrong_length("vertex_indices");
  const auto fill = [corner](std::size_t begin, std::size_t end, char* to, std::size_t stride) {
    constexpr Index kMost = std::numeric_limits<std::int32_t>::max();
    std::size_t bad = end;
    for (std::size_t row = end; row-- > begin;) {
      char* at = to + (row - begin) * stride;
      const Index* face = corner.data() + 3 * row;
      if (std::max({face[0], face[1], face[2]}) > kMost) bad = row;
      *at = 3;
      std::memcpy(at + 1, face, 3 * sizeof(Index));
    }
    return bad;
  };
  column_.push_back({"vertex_indices", "property list uchar int vertex_indices", 1 + 3 * sizeof(Index), fill});
  return *this;
}

void PlyFile::Element::wrong_length(const std::string& column_name) const {
  throw Error(ErrorCode::internal, "column " + column_name + " of PLY element " + name_ + " does not have " +
                                       std::to_string(count_) + " rows");
}

void write_ply(const Work& work, const std::filesystem::path& path, const PlyFile& ply) {
  AtomicFile file(path);
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (std::string line : ply.comment_) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    header += "comment " + line + "\n";
  }
  for (const auto& element : ply.element_) {
    header += "element " + element.name_ + " " + std::to_string(element.count_) + "\n";
    for (const auto& column : element.column_) header += column.declaration + "\n";
  }
  file.write(header + "end_header\n");

  std::vector<char> buffer;
  for (const auto& element : ply.element_) {
    std::size_t stride = 0;
    for (const auto& column : element.column_) stride += column.bytes;
    if (stride == 0) continue;
    constexpr std::size_t kBlock = static_cast<std::size_t>(Cost::light), kBufferBytes = std::size_t{4} << 20;
    const std::size_t rows = std::max(kBlock, kBufferBytes / stride / kBlock * kBlock);  // written at a time
    for (std::size_t first = 0; first < element.count_; first += rows) {
      const std::size_t last = std::min(element.count_, first + rows);
      buffer.resize((last - first) * stride);
      std::vector<std::size_t> bad(block_count(Cost::light, last - first) * element.column_.size(), element.count_);
      for_each_block(work, Cost::light, last - first, [&](std::size_t begin, std::size_t end, std::size_t block) {
        char* to = buffer.data() + begin * stride;
        for (std::size_t c = 0; c < element.column_.size(); to += element.column_[c].bytes, ++c) {
          const std::size_t row = element.column_[c].fill(first + begin, first + end, to, stride);
          if (row < first + end) bad[block * element.column_.size() + c] = row;
        }
      });
      const auto worst = std::min_element(bad.begin(), bad.end());
      if (*worst < element.count_) {
        const auto& column = element.column_[static_cast<std::size_t>(worst - bad.begin()) % element.column_.size()];
        throw Error(ErrorCode::numeric,
                    path.string() + ": " + column.name + " of " + element.name_ + " " + std::to_string(*worst) +
                        " is not finite or too large for its type; nothing was written",
                    static_cast<Index>(*worst));
      }
      file.write({buffer.data(), buffer.size()});
    }
  }
  file.commit();
}

}  // namespace intarsia
