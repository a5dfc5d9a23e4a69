// Surfaces made of grids of quads: sheets that unroll into a rectangle (plane, cylinder, half-pipe) and the cube.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "tools/make/mesh_source.h"

namespace intarsia::tools {

// A planar curve of straight lines and arcs without kinks, by arc length, in the x-z plane; normals to its left.
class Profile {
 public:
  // Starts at (x, z), running in the direction `angle` from the x axis towards z.
  Profile(Real x, Real z, Real angle) : x_(x), z_(z), angle_(angle) {}
  void line(Real length) { add(length, 0); }
  void arc(Real radius, Real turn) { add(radius * std::abs(turn), turn); }  // turn > 0: to the left

  Real length() const { return length_; }
  void at(Real s, Vec3& point, Vec3& normal) const;
  // Distance of (p.x, p.z) from the curve, to either side.
  Real distance(const Vec3& p) const;
  const std::vector<Real>& joints() const { return joints_; }  // arc lengths where its parts begin

 private:
  struct Part {
    Real start, length, turn, x, z, angle;
  };
  void add(Real length, Real turn);

  std::vector<Part> parts_;
  std::vector<Real> joints_;
  Real length_ = 0, x_, z_, angle_;
};

struct Sheet {
  Profile profile;      // swept along y
  Real depth = 1;       // y from -depth / 2 to depth / 2
  bool closed = false;  // the profile ends where it starts
};

// About `triangles` triangles. Border vertices move along the border only.
std::unique_ptr<MeshSource> sheet_grid(const Sheet& sheet, std::uint64_t triangles, const Disturbance& disturbance);
// A cube [-half, half]^3 with sharp edges; vertices on an edge move along it only, corners stay.
std::unique_ptr<MeshSource> cube_grid(Real half, std::uint64_t triangles, const Disturbance& disturbance);

}  // namespace intarsia::tools
