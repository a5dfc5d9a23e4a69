// Polylines over surface points. Curves share a point by sharing its index; nothing else joins them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/data/csr.h"
#include "engine/data/refined_arrays.h"
#include "engine/data/surface_point.h"

namespace intarsia {

// Numbers as written to files.
enum class CurveKind : std::uint8_t {
  ridge = 0,
  valley = 1,
  sharp = 2,
  border = 3,
  extension = 4,
  subdivision = 5,
  given = 6,  // by the user: never moved, never merged away
};

inline constexpr int kCurveKinds = 7;
inline constexpr std::array<const char*, kCurveKinds> kKindNames = {"ridge",     "valley",      "sharp", "border",
                                                                    "extension", "subdivision", "given"};
inline const char* name_of(CurveKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

// Where curves of two kinds run along the same edge, the one that ranks first names it.
inline bool ranks_before(CurveKind a, CurveKind b) {
  if (a == CurveKind::given || b == CurveKind::given) return a == CurveKind::given && b != CurveKind::given;
  return a < b;
}

struct CurveNetwork {
  std::vector<SurfacePoint> point;
  Csr curve;                    // curve -> point indices in order (not ascending); a closed curve repeats its first
  std::vector<CurveKind> kind;  // per curve
  std::vector<Real> strength;   // per point: turn angle theta in radians, 0 where unknown

  Index curve_count() const { return curve.rows(); }
  bool is_closed(Index c) const {
    const auto row = curve.row(c);
    return row.size() > 2 && row.front() == row.back();
  }
  void add_curve(const std::vector<Index>& points, CurveKind k) {
    if (curve.offset.empty()) curve.offset.push_back(0);
    curve.item.insert(curve.item.end(), points.begin(), points.end());
    curve.offset.push_back(static_cast<Index>(curve.item.size()));
    kind.push_back(k);
  }
};

// A refinement of a mesh whose edges carry curves. Every refined face lies inside one face of the original mesh.
struct RefinedMesh {
  Mesh mesh;                             // vertices 0 .. n-1 are the original ones, in order; no vertex_vertices
  std::vector<Index> parent;             // refined face -> original face
  VertexOrigins origin;                  // refined vertex -> where it sits on the original mesh
  std::vector<std::uint8_t> on_network;  // per refined edge: 1 if it carries a curve or lies on the boundary
  std::vector<CurveKind> edge_kind;      // per refined edge; meaningless where on_network is 0
  EdgeStrengths edge_strength;           // per refined edge: turn angle of the feature it carries, 0 elsewhere

  // Does it carry a curve that the user gave?
  bool is_given(Index e) const { return !edge_kind.empty() && edge_kind[e] == CurveKind::given && on_network[e] != 0; }
};

}  // namespace intarsia
