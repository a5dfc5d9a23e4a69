// The neighbours of one vertex from the faces around it, for meshes that do not carry MeshView::vertex_vertices.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/data/mesh.h"

namespace intarsia {

// Ascending, each once.
class VertexRing {
 public:
  VertexRing(const MeshView& mesh, Index v) {
    const auto star = mesh.vertex_faces.row(v);
    Index* at = few_.data();
    if (2 * star.size() > few_.size()) many_.resize(2 * star.size()), at = many_.data();
    first_ = last_ = at;
    for (const Index f : star)
      for (const Index w : mesh.face(f))
        if (w != v) *last_++ = w;
    std::sort(first_, last_);
    last_ = std::unique(first_, last_);
  }
  VertexRing(const VertexRing&) = delete;
  VertexRing& operator=(const VertexRing&) = delete;

  const Index* begin() const { return first_; }
  const Index* end() const { return last_; }
  std::size_t size() const { return static_cast<std::size_t>(last_ - first_); }

 private:
  std::array<Index, 32> few_;
  std::vector<Index> many_;
  Index *first_, *last_;
};

}  // namespace intarsia
