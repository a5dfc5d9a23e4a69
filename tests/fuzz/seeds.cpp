#include "tests/fuzz/seeds.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace intarsia::fuzz {
namespace {

template <class T>
std::string raw(T value, bool swapped = false) {
  std::string bytes(sizeof value, 0);
  std::memcpy(bytes.data(), &value, sizeof value);
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

constexpr std::array<std::array<int, 3>, 4> kPoint = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 4> kFace = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string header(const std::string& format, const std::string& vertex, const std::string& face) {
  return "ply\nformat " + format + " 1.0\ncomment made\nelement vertex 4\n" + vertex + face + "end_header\n";
}

const char* const kFloats = "property float x\nproperty float y\nproperty float z\n";
const char* const kDoubles = "property double x\nproperty double y\nproperty double z\n";
const char* const kFaces = "element face 4\nproperty list uchar int vertex_indices\n";

template <class Coordinate, class Count, class Corner>
std::string body(bool swapped) {
  std::string bytes;
  for (const auto& p : kPoint)
    for (const int c : p) bytes += raw(static_cast<Coordinate>(c), swapped);
  for (const auto& f : kFace) {
    bytes += raw(static_cast<Count>(3), swapped);
    for (const int c : f) bytes += raw(static_cast<Corner>(c), swapped);
  }
  return bytes;
}

std::string text_points(const char* prefix = "") {
  std::string text;
  for (const auto& p : kPoint)
    text += prefix + std::to_string(p[0]) + " " + std::to_string(p[1]) + ".5e-1 " + std::to_string(p[2]) + "\n";
  return text;
}

std::string text_faces(const char* prefix, int first) {
  std::string text;
  for (const auto& f : kFace) {
    text += prefix;
    for (const int c : f) text += " " + std::to_string(c + first);
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> ply_seeds() {
  const std::string labels = std::string(kFaces) + "property int patch\n";
  std::string crlf = header("ascii", kFloats, kFaces) + text_points() + text_faces("3", 0), ended;
  for (const char c : crlf) ended += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return {
      header("ascii", kFloats, kFaces) + text_points() + text_faces("3", 0),
      ended,
      header("ascii", kDoubles, "element face 1\nproperty list uchar int vertex_index\n") + text_points() +
          "4 0 1 3 2\n",
      header("ascii", kFloats, "element tristrips 1\nproperty list int int vertex_indices\n") + text_points() +
          "9 0 1 2 3 -1 0 2 1 3\n",
      header("binary_little_endian", kFloats, kFaces) + body<float, std::uint8_t, std::int32_t>(false),
      header("binary_big_endian", kDoubles, "element face 4\nproperty list uint uint vertex_indices\n") +
          body<double, std::uint32_t, std::uint32_t>(true),
      header("binary_little_endian", "property short x\nproperty short y\nproperty short z\n",
             "element face 4\nproperty list uchar uchar vertex_indices\n") +
          body<std::int16_t, std::uint8_t, std::uint8_t>(false),
      header("binary_little_endian", std::string("property list uchar uchar extra\n") + kFloats,
             "element face 0\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n") +
          std::string("\0\0\0", 3),
      header("ascii", kFloats, labels) + text_points() + "3 0 1 2 5\n3 0 1 3 5\n3 0 2 3 -1\n3 1 2 3 7\n",
  };
}

std::vector<std::string> stl_seeds() {
  std::string binary(80, 'h'), text = "solid made\n";
  binary += raw(std::uint32_t{4});
  for (const auto& f : kFace) {
    for (int i = 0; i < 3; ++i) binary += raw(0.0F);
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int c : f) {
      for (const int value : kPoint[static_cast<std::size_t>(c)]) binary += raw(static_cast<float>(value));
      const auto& p = kPoint[static_cast<std::size_t>(c)];
      text += "   vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + "e0 " + std::to_string(p[2]) + "\n";
    }
    binary += raw(std::uint16_t{0});
    text += "  endloop\n endfacet\n";
  }
  std::string says_solid = binary;
  says_solid.replace(0, 6, "solid ");
  return {binary, says_solid, text + "endsolid made\n", text + "endsolid\nsolid two\nendsolid two\n"};
}

std::vector<std::string> obj_seeds() {
  return {text_points("v ") + text_faces("f", 1),
          "# made\nmtllib no.mtl\no thing\n" + text_points("v ") +
              "vn 0 0 1\nvt 0 0\ng one\nusemtl red\nf 1/1/1 2//1 3/1\nf -4 -3 -1\nf 1 2 \\\n 3 4\ns off\nl 1 2\n"};
}

std::vector<std::string> off_seeds() {
  return {"OFF\n4 4 6\n" + text_points() + text_faces("3", 0),
          "# made\nCOFF 4 1 0\n" + text_points() + "4 0 1 2 3 255 0 0\n"};
}

std::vector<std::string> label_seeds() {
  const std::vector<std::string> meshes = ply_seeds();
  return {"0\n1\n1\n-7\n", "0\r\n12\r\n\r\n3", meshes.back(),
          header("binary_big_endian", kFloats, "element face 2\nproperty short patch\nproperty list uchar int a\n") +
              std::string(48, 1) + std::string("\0\5\0\0\6\0", 6)};
}

std::vector<std::string> surface_seeds() {
  const auto with = [](const std::string& points, const std::string& corners) {
    return static_cast<char>(points.size() / 3 - 1) + points + corners;
  };
  const std::string tetrahedron("\0\0\0\5\0\0\0\5\0\0\0\5", 12), corners("\0\2\1\0\1\3\0\3\2\1\2\3", 12);
  return {
      with(tetrahedron, corners), with(tetrahedron, corners + corners),
      with(tetrahedron, corners + std::string("\0\1\2\3\3\1", 6)),
      with(tetrahedron + std::string("\0\0\0\5\0\0\0\7\1\0\7\5", 12), corners + std::string("\4\5\6\4\7\6\0\5\7", 9))};
}

}  // namespace intarsia::fuzz
