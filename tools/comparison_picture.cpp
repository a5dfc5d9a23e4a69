#include "tools/comparison_picture.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "tools/picture/palette.h"
#include "tools/rebuilt_shape.h"

namespace intarsia::tools {
namespace {

constexpr LineStyle kThinBorder{{44, 44, 50}, 1.0f};

std::string thousandths(double value) { return fmt::format("{:.2f}", 1e3 * value); }

// Least R of a way of rebuilding, as it is printed: what is printed alike is alike.
std::string least_rms(const MeshNumbers& numbers, RebuiltNumbers MethodNumbers::*way) {
  double least = std::numeric_limits<double>::infinity();
  for (const MethodNumbers& m : numbers.methods)
    if ((m.*way).made) least = std::min(least, (m.*way).rms);
  return thousandths(least);
}

SheetRow layout_row(const graph::Surface& surface, const MeshNumbers& numbers, const std::vector<DrawnMethod>& drawn,
                    const std::vector<std::vector<Rgb>>& colour, bool rebuilt) {
  SheetRow row;
  row.title = numbers.mesh;
  row.note = fmt::format("{} triangles\n{} patches", numbers.triangles, numbers.wanted);
  row.cell.push_back({.caption = "", .strong = false, .shape = shape_of(surface.mesh.view()), .lines = {}});
  const std::string least = least_rms(numbers, &MethodNumbers::triangulated);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const graph::Layout& layout = drawn[i].layout;
    const MethodNumbers& m = numbers.methods[i];
    SheetCell cell;
    cell.caption = rebuilt ? fmt::format("q {:.2f}", m.q_median)
                           : fmt::format("R {}   q {:.2f}", thousandths(m.triangulated.rms), m.q_median);
    if (m.patches != numbers.wanted) cell.caption += fmt::format("   {} patches", m.patches);
    cell.strong = !rebuilt && thousandths(m.triangulated.rms) == least;
    cell.shape = shape_of(layout.refined.mesh.view());
    cell.shape.face_label = layout.labels.patch_of_face, cell.shape.label_colour = colour[i];
    cell.lines =
        restyled(lines_of(layout.refined.mesh, layout.refined.on_network, layout.refined.edge_kind), kThinBorder);
    row.cell.push_back(std::move(cell));
  }
  return row;
}

SheetRow rebuilt_row(const char* title, const MeshNumbers& numbers, RebuiltNumbers MethodNumbers::*way,
                     const std::vector<DrawnMethod>& drawn, graph::Rebuilt graph::Evaluation::*surface,
                     const std::vector<std::vector<Rgb>>& colour, bool smooth) {
  SheetRow row;
  row.title = title;
  row.cell.emplace_back();
  const std::string least = least_rms(numbers, way);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const RebuiltNumbers& n = numbers.methods[i].*way;
    SheetCell cell;
    if (n.made) {
      const kernels::Reconstruction& rebuilt = (drawn[i].evaluation.*surface).surface;
      cell.caption = fmt::format("H {}   R {}", thousandths(n.hausdorff), thousandths(n.rms));
      cell.strong = thousandths(n.rms) == least;
      cell.shape = shape_of(rebuilt, colour[i], smooth);
      cell.lines = border_lines(rebuilt, kThinBorder);
    }
    row.cell.push_back(std::move(cell));
  }
  return row;
}

}  // namespace

Image draw_comparison(const Work& work, const graph::Surface& surface, const MeshNumbers& numbers,
                      const std::vector<DrawnMethod>& drawn, bool rebuilt, const SheetOptions& options) {
  std::vector<std::vector<Rgb>> colour;
  colour.reserve(drawn.size());
  for (const DrawnMethod& d : drawn)
    colour.push_back(patch_colours(
        work, adjacent_patches(work, d.layout.refined.mesh, d.layout.labels.patch_of_face, d.layout.labels.count)));
  std::vector<SheetRow> rows{layout_row(surface, numbers, drawn, colour, rebuilt)};
  if (rebuilt) {
    rows.push_back(rebuilt_row("triangulated", numbers, &MethodNumbers::triangulated, drawn,
                               &graph::Evaluation::triangulated, colour, false));
    rows.push_back(
        rebuilt_row("filled", numbers, &MethodNumbers::filled, drawn, &graph::Evaluation::filled, colour, true));
  }
  return draw_sheet_rows(work, rows, options);
}

Image join_comparisons(const std::vector<Image>& rows, const std::vector<std::string>& methods,
                       const SheetOptions& options) {
  std::vector<std::string> column{"input"};
  column.insert(column.end(), methods.begin(), methods.end());
  Image image = draw_sheet_head(column, options);
  for (const Image& row : rows) image = above(image, row);
  return above(image, draw_sheet_foot("H Hausdorff, R root mean square distance, thousandths of the diagonal; q median "
                                      "of perimeter^2 / (4 pi area); bold: least R",
                                      image.width));
}

}  // namespace intarsia::tools
