// A mesh that is made in independent pieces, in any order, each with known places for its vertices and triangles: in
// memory and on disk the result is the same, whatever the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::tools {

// How vertices leave their even positions.
struct Disturbance {
  Real irregularity = 0;  // length of a random step along the surface, 1 = half of the way to the nearest neighbour
  Real noise = 0;         // standard deviation of a step along the normal, as a length
  std::uint64_t seed = 1;
};

struct Piece {
  std::vector<Vec3> point;
  std::vector<Index> corner;  // global vertex ids, three per triangle
  void clear() { point.clear(), corner.clear(); }
};

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  virtual std::uint64_t vertex_count() const = 0;
  virtual std::uint64_t face_count() const = 0;
  virtual std::size_t piece_count() const = 0;
  virtual std::uint64_t first_vertex(std::size_t piece) const = 0;
  virtual std::uint64_t first_face(std::size_t piece) const = 0;
  // Fills `out` (cleared first). Returns early, with an incomplete piece, only if the run was cancelled.
  virtual void make(const Work& work, std::size_t piece, Piece& out) const = 0;
};

}  // namespace intarsia::tools
