// Makes an oriented 2-manifold of whatever triangles a file holds, and remembers what came from where.
#pragma once

#include <array>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "kernels/surface/fault.h"

namespace intarsia::kernels {

struct CleanOptions {
  bool strict = false;        // refuse instead: check_soup's errors
  Real weld_distance = 1e-6;  // border vertices nearer than this are joined, diagonals; 0 = not even equal ones
  Real speck_area = 1e-4;     // pieces below this share of the area are dropped; 0 = none
  Real most_specks = 0.05;    // share of the area that may be dropped in this way
  bool turn_outward = true;   // closed pieces that face inwards are turned
};

enum class CleanAction : std::uint8_t {
  repeated_corners,  // triangles with a corner twice: dropped
  welded,            // vertices joined to another at the same place
  duplicates,        // triangles with the corners of a triangle before: dropped
  turned,            // triangles turned to the orientation of their piece
  cut_crowded,       // edges of three triangles or more: cut, named by their smallest triangle
  cut_unorientable,  // edges along which a one-sided piece was cut
  split_vertices,    // new vertices where fans of triangles only touch, or lie on both sides of a cut
  turned_outward,    // triangles of closed pieces that faced inwards
  specks,            // triangles of specks: dropped
  count
};
const char* name_of(CleanAction action);  // a stable word with hyphens
const char* text_of(CleanAction action);  // to follow a number
inline constexpr std::size_t kCleanActions = static_cast<std::size_t>(CleanAction::count);

struct Cleaning {
  bool changed = false;
  std::array<Fault, kCleanActions> done;  // faces as Soup::source_of names them; vertices of the input
  Index speck_pieces = 0;
  // Only if changed:
  Soup soup;                          // the input's vertices with their numbers, then copies; its source_face: files'
  std::vector<Index> input_triangle;  // triangle -> triangle of the input, ascending
  std::vector<Index> triangle_of;     // input triangle -> triangle, also of duplicates; kNone where it was dropped
  std::vector<Index> copy_of;         // vertex of the input of each copy
  std::vector<Index> becomes;         // vertex of the input -> the one it was welded to; empty if none was

  const Fault& of(CleanAction a) const { return done[static_cast<std::size_t>(a)]; }
};

// Linear but for sorting; parallel where there is nothing to do. Order of work: drop triangles with a corner twice,
// weld borders, drop duplicates, orient pieces by the larger part of their area, cut where more than two triangles meet
// or no orientation exists, give every fan its own vertex, turn what faces inwards, drop specks. Triangles without area
// and with three different corners stay: without them there would be slits. Ensures: changed is false, or check_soup
// accepts the soup. Bits do not depend on threads. Errors: too_large, rejected: check_corners' errors (also if nothing
// is left); with strict all of check_soup's.
Cleaning clean_soup(const Work& work, const Soup& soup, const CleanOptions& options);

}  // namespace intarsia::kernels
