// Polylines over a surface, drawn with a depth test against the faces of a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "tools/picture/raster.h"

namespace intarsia::tools {

struct LineStyle {
  Rgb colour;
  float width = 2;  // pixels
};

// Later polylines are painted over earlier ones.
struct Lines {
  std::vector<Vec3> point;
  std::vector<std::size_t> offset{0};  // polyline -> its points
  std::vector<LineStyle> style;        // per polyline

  std::size_t count() const { return style.size(); }
  void add(std::span<const Vec3> points, const LineStyle& s) {
    point.insert(point.end(), points.begin(), points.end());
    offset.push_back(point.size());
    style.push_back(s);
  }
};

// Fixed colours and widths of the curve kinds; widths are for a picture about 560 pixels high.
LineStyle style_of(CurveKind kind);

// All curves of a network in their fixed colours, the important kinds on top.
Lines lines_of(const MeshView& mesh, const CurveNetwork& network);

// The marked edges of a refined mesh in the colours of their kinds.
Lines lines_of(const MeshView& refined, std::span<const std::uint8_t> on_network, std::span<const CurveKind> edge_kind);

// The same lines in one style, for a picture where only the course matters.
Lines restyled(Lines lines, const LineStyle& style);

// line[sample] = 1 + the last polyline that covers the sample and is not hidden, 0 where there is none. A line is still
// seen when it lies up to its width and one pixel behind the surface (in pixels of depth): curves on the surface stay
// whole where it rises beside them.
void draw_lines(const Work& work, const Frame& frame, const Lines& lines, std::vector<std::uint32_t>& line);

}  // namespace intarsia::tools
