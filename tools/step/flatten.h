// One-to-one maps of patches into the plane.
#pragma once

#include <span>

#include "tools/step/patch_piece.h"
#include "tools/step/spline.h"

namespace intarsia::tools {

enum class Flattening { projection, stretched, circle };  // in the order in which they are tried

// Orthogonal projection along the mean normal. Empty where that would fold the patch or stretch it more than twice.
std::vector<Vec2> project(const PatchPiece& piece);

// Tutte (1963): the longest loop on a circle, every inner point the mean of its neighbours weighted by clamped
// cotangents; holes are filled with a fan before. One-to-one for every disc with holes. Area as the patch's own.
// Requires: is_flat_in_kind().
std::vector<Vec2> map_to_circle(const PatchPiece& piece);

// From a one-to-one map towards one with little distortion: symmetric Dirichlet energy by reweighted least squares
// (Rabinovich et al. 2017, SLIM), no triangle turned over. The border moves freely; the result is the last iterate
// whose border does not cross itself, in the worst case `start`.
std::vector<Vec2> reduce_distortion(const PatchPiece& piece, std::span<const Vec2> start, int iterations = 30);

// Whether the loops, drawn with straight lines between their points, cross themselves or each other.
bool borders_cross(const PatchPiece& piece, std::span<const Vec2> uv);

// Area of the triangles that are turned over, and of all, in the plane.
struct TurnedArea {
  Real turned = 0, all = 0;
};
TurnedArea turned_area(const PatchPiece& piece, std::span<const Vec2> uv);

// Turns the map so that its bounding rectangle is smallest; counter-clockwise, nothing mirrored.
void align_to_axes(std::vector<Vec2>& uv);

}  // namespace intarsia::tools
