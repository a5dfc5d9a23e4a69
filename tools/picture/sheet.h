// Many objects in a table of pictures: a row per object or state, a column per method.
//
//   Image image = draw_sheet_head({"input", "ours", "VSA"}, options);
//   image = above(image, draw_sheet_rows(work, rows_of_one_object, options));
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/picture/camera.h"
#include "tools/picture/shade.h"

namespace intarsia::tools {

// A shape without faces leaves the cell empty.
struct SheetCell {
  std::string caption;  // below; ASCII
  bool strong = false;  // caption in bold
  Shape shape;
  Lines lines;
};

struct SheetRow {
  std::string title, note;  // left of the row; note is smaller, below; a line break starts a new line
  std::vector<SheetCell> cell;
};

struct SheetOptions {
  int width = 270, height = 250;  // pixels; of a cell's picture; rows shrink to the height of their object
  int margin = 150;               // pixels; for the titles of rows
  int samples = 3;                // per pixel and side
  std::optional<View> view;       // none: best_view of the first cell
};

// Names over the columns.
Image draw_sheet_head(std::span<const std::string> column, const SheetOptions& options);

// Rows in one camera, fitted to the first cell of the first row.
// Errors: bad_argument if that cell is empty or there is none.
Image draw_sheet_rows(const Work& work, std::span<const SheetRow> rows, const SheetOptions& options);

// A line of small text, centred in a picture of that width.
Image draw_sheet_foot(const std::string& text, int width);

// One picture above the other on white, left sides aligned.
Image above(const Image& upper, const Image& lower);

}  // namespace intarsia::tools
