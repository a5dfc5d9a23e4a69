// Small meshes with known truth. Closed shapes are oriented outward, open ones upward (+z).
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/data/mesh.h"

namespace intarsia::test {

inline Index add_vertex(Soup& s, const Vec3& p) {
  s.x.push_back(p.x()), s.y.push_back(p.y()), s.z.push_back(p.z());
  return s.vertex_count() - 1;
}
inline void add_face(Soup& s, Index a, Index b, Index c) { s.corner.insert(s.corner.end(), {a, b, c}); }
inline Vec3 point(const Soup& s, Index v) { return {s.x[v], s.y[v], s.z[v]}; }

// Replaces every position p by map(p).
template <class Map>
Soup transformed(Soup s, const Map& map) {
  for (Index v = 0; v < s.vertex_count(); ++v) {
    const Vec3 p = map(point(s, v));
    s.x[v] = p.x(), s.y[v] = p.y(), s.z[v] = p.z();
  }
  return s;
}

inline Soup scaled(const Soup& s, Real factor) {
  return transformed(s, [&](const Vec3& p) -> Vec3 { return factor * p; });
}

inline Soup reversed(Soup s) {
  for (std::size_t f = 0; f < s.face_count(); ++f) std::swap(s.corner[3 * f + 1], s.corner[3 * f + 2]);
  return s;
}

// b's vertices and faces after a's.
inline Soup joined(Soup a, const Soup& b) {
  const Index base = a.vertex_count();
  a.x.insert(a.x.end(), b.x.begin(), b.x.end());
  a.y.insert(a.y.end(), b.y.begin(), b.y.end());
  a.z.insert(a.z.end(), b.z.begin(), b.z.end());
  for (Index c : b.corner) a.corner.push_back(base + c);
  return a;
}

// The same surface with vertices and faces renumbered and every face's corners rotated at random.
inline Soup shuffle(const Soup& s, std::uint64_t seed) {
  const Random random(seed, 77);
  const auto permutation = [&](Index n, std::uint64_t draw) {
    std::vector<Index> p(n);
    std::iota(p.begin(), p.end(), Index{0});
    for (Index i = n; i > 1; --i) std::swap(p[i - 1], p[random.bits(i, draw) % i]);
    return p;
  };
  const std::vector<Index> to = permutation(s.vertex_count(), 0), from = permutation(s.face_count(), 1);
  Soup out;
  out.x.resize(s.x.size()), out.y.resize(s.x.size()), out.z.resize(s.x.size());
  for (Index v = 0; v < s.vertex_count(); ++v) out.x[to[v]] = s.x[v], out.y[to[v]] = s.y[v], out.z[to[v]] = s.z[v];
  for (Index f : from) {
    const std::size_t turn = random.bits(f, 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) out.corner.push_back(to[s.corner[3 * std::size_t{f} + (i + turn) % 3]]);
    if (!s.source_face.empty()) out.source_face.push_back(s.source_face[f]);
  }
  return out;
}

// Unit sphere: icosahedron split `level` times; 10 * 4^level + 2 vertices, 20 * 4^level faces.
inline Soup icosphere(int level) {
  Soup s;
  const Real g = std::numbers::phi;
  for (const Vec3& p :
       {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g),
        Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
    add_vertex(s, p.normalized());
  s.corner = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
              3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto split = [&](Index a, Index b) {
      const auto [at, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, s.vertex_count());
      if (fresh) add_vertex(s, (point(s, a) + point(s, b)).normalized());
      return at->second;
    };
    std::vector<Index> old;
    old.swap(s.corner);
    for (std::size_t c = 0; c < old.size(); c += 3) {
      const Index a = old[c], b = old[c + 1], d = old[c + 2];
      const Index ab = split(a, b), bd = split(b, d), da = split(d, a);
      add_face(s, a, ab, da), add_face(s, b, bd, ab), add_face(s, d, da, bd), add_face(s, ab, bd, da);
    }
  }
  return s;
}

inline Soup ellipsoid(int level, Real a, Real b, Real c) {
  return transformed(icosphere(level), [&](const Vec3& p) { return Vec3(a * p.x(), b * p.y(), c * p.z()); });
}

// How the cells of a grid are cut: all the same way (valence 6), or in turn along rows and columns (valence 4 and 8).
enum class Diagonals { regular, alternating };

// nu by nv cells of the unit square mapped by position(u, v), counter-clockwise in (u, v). A direction may wrap around:
// then its last row of vertices is its first.
template <class Position>
Soup grid(Index nu, Index nv, bool wrap_u, bool wrap_v, Diagonals diagonals, const Position& position) {
  Soup s;
  const Index columns = wrap_u ? nu : nu + 1, rows = wrap_v ? nv : nv + 1;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) add_vertex(s, position(Real(i) / nu, Real(j) / nv));
  const auto at = [&](Index i, Index j) { return (j % rows) * columns + i % columns; };
  for (Index j = 0; j < nv; ++j)
    for (Index i = 0; i < nu; ++i) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (diagonals == Diagonals::regular || (i + j) % 2 == 0)
        add_face(s, a, b, c), add_face(s, a, c, d);
      else
        add_face(s, a, b, d), add_face(s, b, c, d);
    }
  return s;
}

// z = height(x, y) over [x0, x1] x [y0, y1].
template <class Height>
Soup height_field(Index nx, Index ny, Real x0, Real x1, Real y0, Real y1, const Height& height,
                  Diagonals diagonals = Diagonals::regular) {
  return grid(nx, ny, false, false, diagonals, [&](Real u, Real v) {
    const Real x = x0 + (x1 - x0) * u, y = y0 + (y1 - y0) * v;
    return Vec3(x, y, height(x, y));
  });
}

// Unit square in the plane z = 0.
inline Soup plane(Index nx, Index ny, Diagonals diagonals = Diagonals::regular) {
  return height_field(
      nx, ny, 0, 1, 0, 1, [](Real, Real) { return 0.0; }, diagonals);
}

// Torus around the z axis; `around` cells along the large circle.
inline Soup torus(Real large, Real small, Index around, Index across, Diagonals diagonals = Diagonals::regular) {
  return grid(around, across, true, true, diagonals, [&](Real u, Real v) {
    const Real a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, r = large + small * std::cos(b);
    return Vec3(r * std::cos(a), r * std::sin(a), small * std::sin(b));
  });
}

// Open tube of the given radii (elliptic if they differ) around the z axis, z in [0, height].
inline Soup cylinder(Real radius_x, Real radius_y, Real height, Index around, Index along,
                     Diagonals diagonals = Diagonals::regular) {
  return grid(around, along, true, false, diagonals, [&](Real u, Real v) {
    const Real a = 2 * std::numbers::pi * u;
    return Vec3(radius_x * std::cos(a), radius_y * std::sin(a), height * v);
  });
}

// Surface of the unit cube [0, 1]^3 with n x n cells a side; 6 n^2 + 2 vertices, 12 n^2 faces.
inline Soup cube(Index n = 1) {
  Soup s;
  std::map<std::array<Index, 3>, Index> at;
  const auto vertex = [&](const std::array<Index, 3>& p) {
    const auto [it, fresh] = at.try_emplace(p, s.vertex_count());
    if (fresh) add_vertex(s, Vec3(p[0], p[1], p[2]) / n);
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
          const auto corner = [&](Index a, Index b) {
            std::array<Index, 3> p{};
            p[axis] = side ? n : 0, p[(axis + 1) % 3] = a, p[(axis + 2) % 3] = b;
            return vertex(p);
          };
          Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
          if (side == 0) std::swap(b, d);
          add_face(s, a, b, c), add_face(s, a, c, d);
        }
  return s;
}

// Moves every vertex by a random vector of at most `amount` in each coordinate, as `project` allows: project(old,
// moved) returns the position to take, for example the moved point put back on the surface.
template <class Project>
Soup jittered(Soup s, Real amount, std::uint64_t seed, const Project& project) {
  const Random random(seed, 78);
  for (Index v = 0; v < s.vertex_count(); ++v) {
    Vec3 d;
    for (int i = 0; i < 3; ++i) d[i] = amount * (2 * random.uniform(v, static_cast<std::uint64_t>(i)) - 1);
    const Vec3 old = point(s, v), p = project(old, Vec3(old + d));
    s.x[v] = p.x(), s.y[v] = p.y(), s.z[v] = p.z();
  }
  return s;
}
inline Soup jittered(const Soup& s, Real amount, std::uint64_t seed) {
  return jittered(s, amount, seed, [](const Vec3&, const Vec3& moved) { return moved; });
}

}  // namespace intarsia::test
