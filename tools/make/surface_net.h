// Triangles of a closed field's surface from a well-composed lattice: surface nets (Gibson 1998), every vertex moved by
// tangential relaxation and Newton steps until it lies on the surface, every quad split into its better two triangles.
#pragma once

#include <memory>

#include "tools/make/lattice.h"
#include "tools/make/mesh_source.h"

namespace intarsia::tools {

class SurfaceNet final : public MeshSource {
 public:
  SurfaceNet(const Work& work, std::shared_ptr<const Field> field, Real spacing, const Disturbance& disturbance);

  std::uint64_t vertex_count() const override { return lattice_.vertex_count(); }
  std::uint64_t face_count() const override { return 2 * lattice_.quad_count(); }
  std::size_t piece_count() const override { return lattice_.brick_count(); }
  std::uint64_t first_vertex(std::size_t piece) const override { return lattice_.first_vertex(piece); }
  std::uint64_t first_face(std::size_t piece) const override { return 2 * lattice_.first_quad(piece); }
  void make(const Work& work, std::size_t piece, Piece& out) const override;

 private:
  std::shared_ptr<const Field> field_;
  Lattice lattice_;
  Disturbance disturbance_;
};

}  // namespace intarsia::tools
