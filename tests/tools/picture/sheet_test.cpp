#include "tools/picture/sheet.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "tests/tools/picture/picture_shapes.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

const Rgb kWhite = {255, 255, 255};

bool is_blank(const Image& image, int left, int top, int width, int height) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x)
      if (image.contains(x, y) && !(image.at(x, y) == kWhite)) return false;
  return true;
}

}  // namespace

TEST_CASE("cells stand below their heads, whatever the shape of the object; empty cells stay blank") {
  const Triangles ball = sphere(20, 40), flat = box({3, 0.4, 1});
  SheetOptions options;
  options.width = 120, options.height = 100, options.margin = 90;
  const std::vector<std::string> names{"input", "first method", "second method"};
  const Image head = draw_sheet_head(names, options);
  for (const Triangles* object : {&ball, &flat}) {
    SheetRow row{"object", "12 triangles\n3 patches", {}};
    row.cell.push_back({.caption = "", .strong = false, .shape = object->shape(), .lines = {}});
    row.cell.emplace_back();
    row.cell.push_back({.caption = "R 1.00", .strong = true, .shape = object->shape(), .lines = {}});
    const Image rows = draw_sheet_rows({}, std::vector{row, row}, options);
    CHECK(rows.width == head.width);
    const int step = (rows.width - options.margin) / 3;
    CHECK(!is_blank(rows, 0, 0, options.margin, rows.height));
    CHECK(!is_blank(rows, options.margin, 0, step, rows.height));
    CHECK(is_blank(rows, options.margin + step + 7, 0, step - 7, rows.height));
    CHECK(!is_blank(rows, options.margin + 2 * step, 0, step, rows.height));
    CHECK(!is_blank(rows, options.margin, rows.height / 2, step, rows.height / 2));
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 3);
    CHECK(draw_sheet_rows({}, std::vector{row, row}, options).pixel == rows.pixel);
  }
  for (int c = 0; c < 3; ++c) CHECK(!is_blank(head, options.margin + c * 134, 0, 134, head.height));
}

TEST_CASE("pictures above each other keep their pixels and gain white at the right") {
  const Image a(3, 2, {1, 2, 3}), b(5, 1, {4, 5, 6});
  const Image both = above(a, b);
  CHECK(both.width == 5);
  CHECK(both.height == 3);
  CHECK(both.at(2, 1) == Rgb{1, 2, 3});
  CHECK(both.at(3, 1) == kWhite);
  CHECK(both.at(4, 2) == Rgb{4, 5, 6});
}

TEST_CASE("a sheet without a first picture is refused") {
  CHECK_THROWS_AS(draw_sheet_rows({}, std::vector<SheetRow>{}, {}), Error);
  CHECK_THROWS_AS(draw_sheet_rows({}, std::vector{SheetRow{"empty", "", {SheetCell{}}}}, {}), Error);
}
