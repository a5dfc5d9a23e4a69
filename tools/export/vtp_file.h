// VTK's XML poly data (.vtp), version 1.0: one piece, all arrays appended raw, little-endian, 64-bit sizes. For
// ParaView, VTK, PyVista.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>

#include "tools/export/file_writer.h"

namespace intarsia::tools {

// Arrays are functions of the row that live until write() ends; a row has one value, points three.
//
//   VtpFile vtp;
//   vtp.points<float>(n, [&](std::size_t v) { return point[v]; });
//   vtp.triangles(faces, [&](std::size_t corner) { return corners[corner]; });
//   vtp.cell_array<std::int32_t>("patch_id", [&](std::size_t f) { return patch[f]; });
//   vtp.write(path);
class VtpFile {
 public:
  template <class T, class F>
  void points(std::size_t count, const F& point) {
    points_ = count;
    const auto rows = [=](FileWriter& out) {
      for (std::size_t v = 0; v < count; ++v) {
        const auto p = point(v);
        for (int i = 0; i < 3; ++i) out.put(static_cast<T>(p[i]));
      }
    };
    add("Points", {"Points", type_name<T>(), 3, 3 * count * sizeof(T), rows});
  }
  // Cells are either triangles or lines. corner: of 3 * count; last: of each line, one behind its last corner.
  template <class F>
  void triangles(std::size_t count, const F& corner) {
    cells("Polys", count, 3 * count, corner, [](std::size_t f) { return 3 * (f + 1); });
  }
  template <class F, class G>
  void lines(std::size_t count, std::size_t corners, const F& corner, const G& last) {
    cells("Lines", count, corners, corner, last);
  }
  template <class T, class F>
  void cell_array(const std::string& name, const F& value) {
    add("CellData", array<T>(name, cells_, value));
  }
  template <class T, class F>
  void point_array(const std::string& name, const F& value) {
    add("PointData", array<T>(name, points_, value));
  }

  // Errors: write_failed naming the file.
  void write(const std::filesystem::path& path) const;

 private:
  struct Array {
    std::string name;
    const char* type;
    int components;
    std::size_t bytes;
    std::function<void(FileWriter&)> rows;
  };
  struct Section {
    std::string name;
    std::deque<Array> array;
  };

  template <class T>
  static constexpr const char* type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    return "UInt8";
  }
  template <class T, class F>
  static Array array(const std::string& name, std::size_t count, const F& value) {
    return {name, type_name<T>(), 1, count * sizeof(T), [=](FileWriter& out) {
              for (std::size_t i = 0; i < count; ++i) out.put(static_cast<T>(value(i)));
            }};
  }
  template <class F, class G>
  void cells(const char* section, std::size_t count, std::size_t corners, const F& corner, const G& last) {
    cells_ = count, cell_section_ = section;
    add(section, array<std::int64_t>("connectivity", corners, corner));
    add(section, array<std::int64_t>("offsets", count, last));
  }
  void add(const char* section, Array array);

  std::size_t points_ = 0, cells_ = 0;
  std::string cell_section_;
  std::deque<Section> section_;
};

}  // namespace intarsia::tools
