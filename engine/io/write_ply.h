// Binary little-endian PLY from columns. The columns refer to the caller's arrays: these must live until write_ply
// ends.
//
//   PlyFile ply;
//   ply.element("vertex", n).xyz<double>(mesh.x, mesh.y, mesh.z).column<double>("kmax", fields.kmax);
//   ply.element("face", f).triangles(mesh.corner).column<std::int32_t>("patch", label);
//   write_ply(work, path, ply);
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/types.h"
#include "engine/parallel/work.h"

namespace intarsia {

template <class T>
concept PlyScalar = std::is_same_v<T, double> || std::is_same_v<T, float> || std::is_same_v<T, std::int32_t> ||
    std::is_same_v<T, std::uint8_t>;

class PlyFile {
 public:
  class Element {
   public:
    Element(std::string name, std::size_t count) : name_(std::move(name)), count_(count) {}

    // One property. `source` is an array of `count` values (of any arithmetic or enumeration type), or a function of
    // the row that may run on several threads at once. Values are converted to T; write_ply refuses those that do not
    // fit (such as kNone in an int column).
    template <PlyScalar T, class Source>
    Element& column(std::string name, Source&& source) {
      using Plain = std::remove_cvref_t<Source>;
      if constexpr (std::is_invocable_v<const Plain&, std::size_t>) {
        add<T>(std::move(name), Plain(std::forward<Source>(source)));
      } else {
        static_assert(std::is_lvalue_reference_v<Source> || std::ranges::borrowed_range<Plain>,
                      "the array must live until write_ply ends");
        const std::span values(std::as_const(source));
        if (values.size() != count_) wrong_length(name);
        add<T>(std::move(name), [values](std::size_t row) { return values[row]; });
      }
      return *this;
    }
    template <PlyScalar T>
    Element& xyz(std::span<const Real> x, std::span<const Real> y, std::span<const Real> z) {
      return column<T>("x", x).template column<T>("y", y).template column<T>("z", z);
    }
    // The property list uchar int vertex_indices, three for each row.
    Element& triangles(std::span<const Index> corner);

   private:
    friend void write_ply(const Work&, const std::filesystem::path&, const PlyFile&);
    struct Column {
      std::string name, declaration;
      std::size_t bytes;
      // Fills rows [begin, end) at `to`, `stride` bytes apart; returns the first row whose value does not fit, or end.
      std::function<std::size_t(std::size_t begin, std::size_t end, char* to, std::size_t stride)> fill;
    };

    template <class T>
    static constexpr const char* type_name() {
      if constexpr (std::is_same_v<T, double>) return "double";
      if constexpr (std::is_same_v<T, float>) return "float";
      if constexpr (std::is_same_v<T, std::int32_t>) return "int";
      return "uchar";
    }
    template <class T, class V>
    static bool convert(V value, T& to) {
      if constexpr (std::is_enum_v<V>) {
        return convert(static_cast<std::underlying_type_t<V>>(value), to);
      } else if constexpr (std::is_same_v<V, bool>) {
        to = static_cast<T>(value ? 1 : 0);
        return true;
      } else if constexpr (std::is_floating_point_v<T>) {
        to = static_cast<T>(value);
        return std::isfinite(to);
      } else {
        static_assert(std::is_integral_v<V>, "round to an integer first");
        to = static_cast<T>(value);
        return std::cmp_equal(to, value);
      }
    }
    template <class T, class F>
    void add(std::string name, F value) {
      std::string declaration = std::string("property ") + type_name<T>() + " " + name;
      const auto fill = [value](std::size_t begin, std::size_t end, char* to, std::size_t stride) {
        std::size_t bad = end;
        for (std::size_t row = end; row-- > begin;) {
          T scalar{};
          if (!convert(value(row), scalar)) bad = row;
          std::memcpy(to + (row - begin) * stride, &scalar, sizeof scalar);
        }
        return bad;
      };
      column_.push_back({std::move(name), std::move(declaration), sizeof(T), fill});
    }
    [[noreturn]] void wrong_length(const std::string& column_name) const;

    std::string name_;
    std::size_t count_;
    std::vector<Column> column_;
  };

  // The reference stays valid while more elements are added.
  Element& element(std::string name, std::size_t count) { return element_.emplace_back(std::move(name), count); }
  // One line of the header.
  void comment(std::string line) { comment_.push_back(std::move(line)); }

 private:
  friend void write_ply(const Work&, const std::filesystem::path&, const PlyFile&);
  std::vector<std::string> comment_;
  std::deque<Element> element_;
};

// Ensures: the file is whole or, after an error, an earlier file of that name is as it was.
// Errors: numeric (element = row) if a value is not finite or does not fit its type; write_failed naming the file;
// cancelled.
void write_ply(const Work& work, const std::filesystem::path& path, const PlyFile& ply);

}  // namespace intarsia
