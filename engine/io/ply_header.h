// The header of a PLY file (Turk 1994): format, elements, properties, and where the data begin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace intarsia {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline std::size_t size_of(PlyType type) {
  constexpr std::size_t kSize[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSize[static_cast<std::size_t>(type)];
}
inline bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  // of the scalar, or of the items of a list
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> property;

  // Position of the first property of that name, or -1.
  int find(std::string_view property_name) const;
  bool has_list() const;
  // Bytes that one item takes at least: exactly, for binary items without lists.
  std::uint64_t least_bytes(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> element;  // in the order of the data
  std::size_t data_begin = 0;       // offset of the first byte after the header

  const PlyElement* find(std::string_view element_name) const;
};

// Ensures: the promised items can fit into the bytes behind the header, so that counts may be allocated.
// Errors: bad_file.
PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view file);

}  // namespace intarsia
