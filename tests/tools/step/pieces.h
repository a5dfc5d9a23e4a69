// Patches with known truth.
#pragma once

#include <cmath>

#include "tools/step/patch_piece.h"

namespace intarsia::test {

// The image of a grid over [0, 1]^2 as one patch of four sides; position(u, v) with u x v outwards.
template <class Position>
tools::PatchPiece grid_piece(Index nu, Index nv, const Position& position) {
  tools::PatchPiece piece;
  for (Index i = 0; i <= nu; ++i)
    for (Index j = 0; j <= nv; ++j) {
      piece.vertex.push_back(static_cast<Index>(piece.point.size()));
      piece.point.push_back(position(static_cast<Real>(i) / nu, static_cast<Real>(j) / nv));
    }
  const auto at = [&](Index i, Index j) { return i * (nv + 1) + j; };
  for (Index i = 0; i < nu; ++i)
    for (Index j = 0; j < nv; ++j) {
      piece.triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      piece.triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (Index f = 0; f < piece.triangle.size(); ++f) piece.face.push_back(f);
  tools::PatchPiece::Loop loop;
  const auto side = [&](Index half_arc) { loop.side.push_back({half_arc, static_cast<Index>(loop.point.size())}); };
  side(0);
  for (Index i = 0; i < nu; ++i) loop.point.push_back(at(i, 0));
  side(2);
  for (Index j = 0; j < nv; ++j) loop.point.push_back(at(nu, j));
  side(4);
  for (Index i = nu; i > 0; --i) loop.point.push_back(at(i, nv));
  side(6);
  for (Index j = nv; j > 0; --j) loop.point.push_back(at(0, j));
  for (std::size_t i = 0; i < loop.point.size(); ++i)
    loop.length += (piece.point[loop.point[i]] - piece.point[loop.point[(i + 1) % loop.point.size()]]).norm();
  piece.loop.push_back(loop);
  piece.euler = 1;
  return piece;
}

// Part of a unit cylinder about z of that angle, height 1.
inline tools::PatchPiece cylinder_sector(Index nu, Index nv, Real angle) {
  return grid_piece(nu, nv, [&](Real u, Real v) { return Vec3(std::cos(angle * u), std::sin(angle * u), v); });
}

// A square bent onto a unit sphere around +z, out to the polar angle `reach` in the middles of its sides.
inline tools::PatchPiece sphere_cap(Index n, Real reach) {
  return grid_piece(n, n, [&](Real u, Real v) {
    const Real x = 2 * u - 1, y = 2 * v - 1, most = std::max(std::abs(x), std::abs(y));
    const Real r = std::hypot(x, y), polar = reach * most;
    return r == 0 ? Vec3(0, 0, 1) : Vec3(std::sin(polar) * x / r, std::sin(polar) * y / r, std::cos(polar));
  });
}

}  // namespace intarsia::test
