#include "tools/picture/palette.h"

#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "engine/parallel/connect_mesh.h"
#include "tests/tools/picture/picture_shapes.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

Csr rows_of(const std::vector<std::vector<Index>>& rows) {
  Csr csr;
  csr.offset.push_back(0);
  for (const auto& row : rows) {
    csr.item.insert(csr.item.end(), row.begin(), row.end());
    csr.offset.push_back(static_cast<Index>(csr.item.size()));
  }
  return csr;
}

Csr grid(Index side) {
  std::vector<std::vector<Index>> rows(side * side);
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j) {
      auto& row = rows[i * side + j];
      if (i > 0) row.push_back((i - 1) * side + j);
      if (j > 0) row.push_back(i * side + j - 1);
      if (j + 1 < side) row.push_back(i * side + j + 1);
      if (i + 1 < side) row.push_back((i + 1) * side + j);
    }
  return rows_of(rows);
}

int difference(Rgb a, Rgb b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

}  // namespace

TEST_CASE("neighbouring patches get clearly different colours") {
  const Csr adjacency = grid(12);
  const std::vector<Rgb> colour = patch_colours({}, adjacency);
  REQUIRE(colour.size() == 144);
  std::set<int> used;
  for (Index p = 0; p < adjacency.rows(); ++p) {
    used.insert(colour[p].r << 16 | colour[p].g << 8 | colour[p].b);
    for (Index q : adjacency.row(p)) CHECK(difference(colour[p], colour[q]) > 60);
  }
  CHECK(used.size() > 10);
}

TEST_CASE("even eighty patches that all touch get eighty colours") {
  std::vector<std::vector<Index>> rows(80);
  for (Index p = 0; p < 80; ++p)
    for (Index q = 0; q < 80; ++q)
      if (p != q) rows[p].push_back(q);
  const std::vector<Rgb> colour = patch_colours({}, rows_of(rows));
  std::set<int> used;
  for (Rgb c : colour) used.insert(c.r << 16 | c.g << 8 | c.b);
  CHECK(used.size() == 80);
}

TEST_CASE("colours are light enough for dark lines and not glaring") {
  for (Rgb c : patch_colours({}, grid(8))) {
    const double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    CHECK(luma > 120);
    CHECK(luma < 240);
  }
}

TEST_CASE("no patches, one patch") {
  CHECK(patch_colours({}, Csr{}).empty());
  CHECK(patch_colours({}, rows_of({{}})).size() == 1);
}

TEST_CASE("patches are adjacent where faces of two labels share an edge") {
  const Triangles t = box({1, 1, 1});
  Mesh mesh;
  mesh.x = t.x, mesh.y = t.y, mesh.z = t.z, mesh.corner = t.corner;
  connect_mesh({}, mesh);
  std::vector<Index> label(12);
  for (Index f = 0; f < 12; ++f) label[f] = f / 2;  // the sides: -z +z -y +y -x +x
  const Csr adjacency = adjacent_patches({}, mesh, label, 6);
  REQUIRE(adjacency.rows() == 6);
  for (Index p = 0; p < 6; ++p) {
    std::vector<Index> expected;
    for (Index q = 0; q < 6; ++q)
      if (q / 2 != p / 2) expected.push_back(q);
    CHECK(std::vector<Index>(adjacency.row(p).begin(), adjacency.row(p).end()) == expected);
  }
  label[0] = label[1] = kNone;
  CHECK(adjacent_patches({}, mesh, label, 6).row(0).empty());
}
