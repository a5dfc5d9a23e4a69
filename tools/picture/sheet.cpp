#include "tools/picture/sheet.h"

#include <sstream>

#include "tools/picture/best_view.h"
#include "tools/picture/font.h"

namespace intarsia::tools {
namespace {

constexpr int kGap = 14, kHead = 46, kCaption = 34, kFoot = 40;  // pixels
const TextStyle kTitle = {16.0f, 0.145f, {28, 30, 36}};
const TextStyle kNote = {13.0f, 0.12f, {98, 102, 112}};
const TextStyle kPlain = {13.5f, 0.12f, {70, 74, 84}};
const TextStyle kStrong = {13.5f, 0.2f, {10, 12, 16}};

int left_of(std::size_t column, const SheetOptions& o) {
  return o.margin + kGap + static_cast<int>(column) * (o.width + kGap);
}

float middle_of(std::size_t column, const SheetOptions& o) {
  return static_cast<float>(left_of(column, o)) + 0.5f * static_cast<float>(o.width);
}

void draw_row_title(Image& image, const SheetRow& row, float middle, float room) {
  std::istringstream notes(row.note);
  std::vector<std::string> line;
  for (std::string text; std::getline(notes, text);) line.push_back(text);
  constexpr float kStep = 21;
  float y = middle - 0.5f * kStep * static_cast<float>(line.size()) + 0.5f * kTitle.size;
  draw_text_within(image, kGap, y, row.title, kTitle, room);
  for (const std::string& text : line) draw_text_within(image, kGap, y += kStep, text, kNote, room);
}

}  // namespace

Image draw_sheet_head(std::span<const std::string> column, const SheetOptions& options) {
  Image image(left_of(column.size(), options), kHead);
  for (std::size_t c = 0; c < column.size(); ++c)
    draw_centred(image, middle_of(c, options), 30, column[c], kTitle, static_cast<float>(options.width));
  return image;
}

Image draw_sheet_rows(const Work& work, std::span<const SheetRow> rows, const SheetOptions& options) {
  if (rows.empty() || rows[0].cell.empty() || rows[0].cell[0].shape.face_count() == 0)
    throw Error(ErrorCode::bad_argument, "a sheet's rows need a picture in their first cell");
  const Shape& first = rows[0].cell[0].shape;
  FitOptions fit;
  fit.width = options.width, fit.height = options.height;
  const View view = options.view ? *options.view : best_view(work, first);
  const Camera camera = fit_camera_tightly(work, first, view, fit, std::min(options.width, options.height) / 2);

  std::size_t columns = 0;
  for (const SheetRow& row : rows) columns = std::max(columns, row.cell.size());
  const int step = camera.height + kCaption;
  Image image(left_of(columns, options), static_cast<int>(rows.size()) * step + kGap);
  Scene scene;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int top = static_cast<int>(r) * step;
    const float middle = static_cast<float>(top) + 0.5f * static_cast<float>(camera.height);
    draw_row_title(image, rows[r], middle, static_cast<float>(options.margin - kGap));
    for (std::size_t c = 0; c < rows[r].cell.size(); ++c) {
      const SheetCell& cell = rows[r].cell[c];
      if (cell.shape.face_count() == 0) continue;
      prepare_scene(work, cell.shape, camera, options.samples, {}, scene);
      shade(work, cell.shape, cell.lines, scene, image, left_of(c, options) + (options.width - camera.width) / 2, top);
      draw_centred(image, middle_of(c, options), static_cast<float>(top + camera.height + 18), cell.caption,
                   cell.strong ? kStrong : kPlain, static_cast<float>(options.width));
    }
  }
  return image;
}

Image draw_sheet_foot(const std::string& text, int width) {
  Image image(width, kFoot);
  const auto room = static_cast<float>(width);
  draw_centred(image, 0.5f * room, 22, text, kNote, room - 2 * kGap);
  return image;
}

Image above(const Image& upper, const Image& lower) {
  Image out(std::max(upper.width, lower.width), upper.height + lower.height);
  for (int y = 0; y < upper.height; ++y) std::copy_n(&upper.at(0, y), upper.width, &out.at(0, y));
  for (int y = 0; y < lower.height; ++y) std::copy_n(&lower.at(0, y), lower.width, &out.at(0, upper.height + y));
  return out;
}

}  // namespace intarsia::tools
