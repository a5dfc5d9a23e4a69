#include "engine/parallel/connect_mesh.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/reduce.h"

namespace intarsia {
namespace {

// The edges of one vertex v to larger ones, as half-edges: key = larger vertex << 32 | opposite corner, ascending.
class Rays {
 public:
  explicit Rays(const Mesh& mesh) : mesh_(mesh) {}

  void read(Index v) {
    const auto faces = mesh_.vertex_faces.row(v);
    if (key_.size() < 2 * faces.size() + 1) key_.resize(4 * faces.size());
    std::uint64_t* key = key_.data();
    size_ = 0;
    const auto take = [&](Index other, Index corner) {  // which vertex is larger cannot be predicted: no branch
      key[size_] = (std::uint64_t{other} << 32) | corner;
      size_ += other > v;
    };
    for (const Index f : faces) {
      const Index c = 3 * f, *k = &mesh_.corner[c];
      const Index i = k[1] == v ? 1 : k[2] == v ? 2 : 0, next = i == 2 ? 0 : i + 1, last = i == 0 ? 2 : i - 1;
      take(k[next], c + last), take(k[last], c + next);
    }
    sort_few(key, size_);
  }
  std::size_t size() const { return size_; }
  Index other(std::size_t i) const { return static_cast<Index>(key_[i] >> 32); }
  Index corner(std::size_t i) const { return static_cast<Index>(key_[i]); }
  bool starts_edge(std::size_t i) const { return i == 0 || other(i) != other(i - 1); }
  Index edges() const {
    Index n = 0;
    for (std::size_t i = 0; i < size_; ++i) n += starts_edge(i);
    return n;
  }

 private:
  const Mesh& mesh_;
  std::vector<std::uint64_t> key_ = std::vector<std::uint64_t>(64);
  std::size_t size_ = 0;
};

// Fills the edges and returns the first edge of each vertex. Requires: vertex_faces.
std::vector<Index> write_edges(const Work& work, Mesh& mesh) {
  const Index vertices = mesh.vertex_count();
  std::vector<Index> first(std::size_t{vertices} + 1, 0);
  for_each_block(work, Cost::light, vertices, [&](std::size_t begin, std::size_t end, std::size_t) {
    Rays rays(mesh);
    for (std::size_t v = begin; v < end; ++v) {
      rays.read(static_cast<Index>(v));
      first[v] = rays.edges();
    }
  });
  const Index edges = exclusive_scan<Index>(work, first);
  mesh.edge_v0.resize(edges), mesh.edge_v1.resize(edges);
  mesh.edge_f0.resize(edges), mesh.edge_f1.resize(edges);
  mesh.face_edge.resize(mesh.corner.size());
  const Index bad = reduce(
      work, Cost::light, vertices, kNone,
      [&](std::size_t begin, std::size_t end) {
        Rays rays(mesh);
        Index worst = kNone;
        for (std::size_t v = begin; v < end; ++v) {
          rays.read(static_cast<Index>(v));
          Index e = first[v] - 1;
          bool forward = false;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            const Index c = rays.corner(i), f = c / 3;
            const bool along = mesh.corner[c + 1 < 3 * f + 3 ? c + 1 : 3 * f] == v;
            if (rays.starts_edge(i)) {
              ++e;
              mesh.edge_v0[e] = static_cast<Index>(v), mesh.edge_v1[e] = rays.other(i);
              mesh.edge_f0[e] = f, mesh.edge_f1[e] = kNone;
              forward = along;
            } else if (mesh.edge_f1[e] != kNone || along == forward) {
              worst = std::min(worst, mesh.edge_f0[e]);
            } else {
              mesh.edge_f1[e] = f;
            }
            mesh.face_edge[c] = e;
          }
        }
        return worst;
      },
      [](Index a, Index c) { return std::min(a, c); });
  if (bad != kNone)
    throw Error(ErrorCode::rejected,
                "face " + std::to_string(bad) + " has an edge with more than two faces or a neighbour turned over",
                bad);
  return first;
}

std::vector<Index> connect(const Work& work, Mesh& mesh) {
  mesh.vertex_faces = build_csr(
      work, mesh.vertex_count(), mesh.corner.size(), [&](std::size_t c) { return mesh.corner[c]; },
      [](std::size_t c) { return static_cast<Index>(c / 3); });
  return write_edges(work, mesh);
}

}  // namespace

void connect_faces(const Work& work, Mesh& mesh) { connect(work, mesh); }

void connect_mesh(const Work& work, Mesh& mesh) {
  const std::vector<Index> first = connect(work, mesh);
  // Edges are sorted by both ends: larger neighbours stand there already, and smaller ones are met in order.
  const Csr smaller = build_csr(
      work, mesh.vertex_count(), mesh.edge_count(), [&](std::size_t e) { return mesh.edge_v1[e]; },
      [&](std::size_t e) { return mesh.edge_v0[e]; });
  Csr& out = mesh.vertex_vertices;
  out.offset.resize(first.size());
  out.item.resize(std::size_t{mesh.edge_count()} * 2);
  for_each(work, Cost::light, first.size(), [&](std::size_t v) { out.offset[v] = smaller.offset[v] + first[v]; });
  for_each(work, Cost::light, mesh.vertex_count(), [&](std::size_t v) {
    const auto row = smaller.row(static_cast<Index>(v));
    const auto at = std::copy(row.begin(), row.end(), out.item.begin() + out.offset[v]);
    std::copy(mesh.edge_v1.begin() + first[v], mesh.edge_v1.begin() + first[v + 1], at);
  });
}

}  // namespace intarsia
