// What the picture tools need to know of a surface: views only, nothing is copied.
#pragma once

#include <span>

#include "engine/data/mesh.h"
#include "tools/picture/image.h"

namespace intarsia::tools {

inline constexpr Rgb kClay = {212, 212, 214};  // faces without a colour of their own

// Triangles to draw. Needs no connectivity; degenerate faces are skipped, open and badly oriented surfaces are drawn
// from both sides.
struct Shape {
  std::span<const Real> x, y, z;
  std::span<const Index> corner;      // 3 per face
  std::span<const Rgb> face_colour;   // one per face, or empty
  std::span<const Index> face_label;  // used where face_colour is empty: label -> label_colour; kNone = clay
  std::span<const Rgb> label_colour;
  Vec3View vertex_normal;  // unit, or empty: estimated (see normals.h)
  bool smooth = true;      // false: one normal per face

  Index face_count() const { return static_cast<Index>(corner.size() / 3); }
  Vec3 point(Index v) const { return {x[v], y[v], z[v]}; }
  Rgb colour_of(Index f) const {
    if (!face_colour.empty()) return face_colour[f];
    if (face_label.empty() || face_label[f] >= label_colour.size()) return kClay;
    return label_colour[face_label[f]];
  }
  // True if both draw the very same arrays of points and corners.
  bool same_geometry(const Shape& o) const {
    return x.data() == o.x.data() && y.data() == o.y.data() && z.data() == o.z.data() && x.size() == o.x.size() &&
           corner.data() == o.corner.data() && corner.size() == o.corner.size();
  }
};

inline Shape shape_of(const MeshView& mesh) {
  Shape s;
  s.x = mesh.x, s.y = mesh.y, s.z = mesh.z, s.corner = mesh.corner;
  return s;
}

}  // namespace intarsia::tools
