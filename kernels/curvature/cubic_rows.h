// What the three rows of a fit point, its height and its two slopes, are made of: the coefficients of the normal
// equations as combinations of moments, worked out by the compiler. Shared by the fit of one vertex (cubic_system.h)
// and the fit of eight (cubic_lanes.h).
#pragma once

#include <array>
#include <cstddef>

#include "kernels/curvature/cubic_system.h"

namespace intarsia::kernels {

// One factor * x^i y^j; factor 0 where a row does not know the unknown.
struct Monomial {
  Real factor;
  std::size_t i, j;
};
// Monomials are ordered by degree, then by the power of y.
constexpr std::size_t place(std::size_t i, std::size_t j) { return (i + j) * (i + j + 1) / 2 + j; }

// Height, slope in x and slope in y of every unknown.
inline constexpr Monomial kNothing{0, 0, 0};
inline constexpr std::array<std::array<Monomial, kCubicTerms>, 3> kRow{{
    {{{0.5, 2, 0},
      {1, 1, 1},
      {0.5, 0, 2},
      {1.0 / 6, 3, 0},
      {0.5, 2, 1},
      {0.5, 1, 2},
      {1.0 / 6, 0, 3},
      {1, 1, 0},
      {1, 0, 1},
      {1, 0, 0}}},
    {{{1, 1, 0}, {1, 0, 1}, kNothing, {0.5, 2, 0}, {1, 1, 1}, {0.5, 0, 2}, kNothing, {1, 0, 0}, kNothing, kNothing}},
    {{kNothing, {1, 1, 0}, {1, 0, 1}, kNothing, {0.5, 2, 0}, {1, 1, 1}, {0.5, 0, 2}, kNothing, {1, 0, 0}, kNothing}},
}};

// Entry (r, c), c <= r, of the normal matrix as a combination of three moments; and of the right-hand side.
struct NormalEntry {
  std::array<Real, 3> factor;
  std::array<std::size_t, 3> moment;
};
struct NormalTable {
  std::array<NormalEntry, kCubicTerms*(kCubicTerms + 1) / 2> matrix;
  std::array<NormalEntry, kCubicTerms> right;
};
constexpr NormalTable make_normal_table() {
  NormalTable t{};
  for (std::size_t r = 0, at = 0; r < kCubicTerms; ++r) {
    for (std::size_t c = 0; c <= r; ++c, ++at)
      for (std::size_t row = 0; row < 3; ++row) {
        const Monomial &m = kRow[row][r], &n = kRow[row][c];
        t.matrix[at].factor[row] = m.factor * n.factor;
        t.matrix[at].moment[row] = m.factor * n.factor == 0 ? 0 : place(m.i + n.i, m.j + n.j);
      }
    for (std::size_t row = 0; row < 3; ++row) {
      const Monomial& m = kRow[row][r];
      t.right[r].factor[row] = m.factor;
      t.right[r].moment[row] = m.factor == 0 ? 0 : place(m.i, m.j);
    }
  }
  return t;
}
inline constexpr NormalTable kNormalTable = make_normal_table();

}  // namespace intarsia::kernels
