// The connected pieces of a soup: how much of the surface each is, and which way it faces.
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct SoupPieces {
  std::vector<Index> piece;  // per triangle, pieces numbered by their smallest vertices; empty if there is only one
  // per piece
  std::vector<Real> area, volume;  // volume: signed, about the middle of the box; of closed pieces the true one
  std::vector<Vec3> low, high;
  std::vector<std::uint8_t> closed;
  Real total_area = 0;

  Index count() const { return static_cast<Index>(area.size()); }
  Index piece_of(std::size_t triangle) const { return piece.empty() ? 0 : piece[triangle]; }
};

// Triangles that share vertices are connected. on_border: per vertex, 1 if it lies on a border edge.
SoupPieces soup_pieces(const Work& work, const Soup& soup, std::span<const std::uint8_t> on_border, const Vec3& middle);

// Pieces to drop: less than `share` of the area each, and not more than `most` of the area altogether (else none: then
// the small pieces are what the surface is made of). Ascending.
std::vector<Index> specks(const SoupPieces& pieces, Real share, Real most);

// Closed pieces to turn inside out. All of them if together they hold a negative volume; then those that still do,
// unless they lie in the box of another closed piece: such a piece is the wall of a cavity. Ascending.
std::vector<Index> inward_pieces(const SoupPieces& pieces);

}  // namespace intarsia::kernels
