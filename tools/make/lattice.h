// The inside of a field on a cubic lattice of points, one bit each, stored only in bricks of 64 x 64 x 64 points near
// the surface.
//
// The boundary of the set of inside points, taken as voxels, is a closed surface of quads: one quad per lattice edge
// that changes sign, one vertex per lattice cell whose eight corners differ. It is a manifold if and only if the set is
// well-composed (Latecki 1997: no 2 x 2 square with only its diagonal inside, no 2 x 2 x 2 cube with only two opposite
// corners inside or outside); where it is not, single points next to the surface are added until it is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/parallel/work.h"
#include "tools/make/field.h"

namespace intarsia::tools {

inline constexpr int kBrick = 64;                      // points (and cells) along a side of a brick
inline constexpr std::size_t kRows = kBrick * kBrick;  // rows along x, one 64-bit word each

using Point3i = std::array<int, 3>;

struct LatticeFrame {
  Vec3 origin = Vec3::Zero();
  Vec3 step_x = Vec3::UnitX(), step_y = Vec3::UnitY(), step_z = Vec3::UnitZ();  // orthogonal, each `spacing` long
  Real spacing = 1;

  Vec3 at(Real i, Real j, Real k) const { return origin + i * step_x + j * step_y + k * step_z; }
};

// Points and cells are addressed by global integer coordinates; cell (i, j, k) has the corners i..i+1, j..j+1, k..k+1.
class Lattice {
 public:
  // A lattice that covers the field's box, turned and shifted by `seed` so that its directions mean nothing on the
  // shape.
  Lattice(const Work& work, const Field& field, Real spacing, std::uint64_t seed);

  std::uint64_t vertex_count() const { return vertex_offset_.back(); }  // cells on the surface
  std::uint64_t quad_count() const { return quad_offset_.back(); }      // lattice edges that change sign
  std::size_t brick_count() const { return bricks_.size(); }            // stored bricks
  std::uint64_t first_vertex(std::size_t brick) const { return vertex_offset_[brick]; }
  std::uint64_t first_quad(std::size_t brick) const { return quad_offset_[brick]; }
  Point3i brick_corner(std::size_t brick) const;  // first point of a stored brick
  const LatticeFrame& frame() const { return frame_; }

  // The 64 points (cells on the surface) that start at (i, j, k), i a multiple of 64, bit 0 first. Outside the lattice:
  // 0.
  std::uint64_t inside_row(int i, int j, int k) const;
  std::uint64_t cell_row(int i, int j, int k) const;
  // Number of a cell on the surface, in the order of bricks, then z, y, x.
  std::uint64_t vertex_id(int i, int j, int k) const;

 private:
  std::size_t brick_of(int i, int j, int k) const;
  void find_bricks(const Work& work, const Field& field);
  void sample_brick(const Field& field, std::size_t brick);
  void sample_box(const Field& field, std::size_t brick, const Point3i& local, int size);
  void make_well_composed(const Work& work, const Field& field);
  void number(const Work& work);
  bool inside(int i, int j, int k) const;
  std::array<std::uint64_t, 8> corners_row(int i, int j, int k) const;

  LatticeFrame frame_;
  std::array<int, 3> size_{};          // bricks along each axis
  std::vector<Index> slot_;            // brick of the box -> stored brick, or kNone
  std::vector<std::uint8_t> solid_;    // brick of the box that is not stored: 1 if inside
  std::vector<Index> bricks_;          // stored brick -> brick of the box, ascending
  std::vector<std::uint64_t> inside_;  // kRows per stored brick
  std::vector<std::uint64_t> cells_;   // kRows per stored brick
  std::vector<std::uint32_t> rank_;    // kRows per stored brick: cells of the brick before the row
  std::vector<std::uint64_t> vertex_offset_, quad_offset_;
};

}  // namespace intarsia::tools
