#include "engine/parallel/connect_mesh.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/reduce.h"

namespace intarsia {
namespace {

// The directed edge opposite corner c runs from `tail` to `head`.
struct HalfEdge {
  Index tail, head;
  Index low() const { return std::min(tail, head); }
  Index high() const { return std::max(tail, head); }
};

HalfEdge half_edge(const std::vector<Index>& corner, std::size_t c) {
  const std::size_t f = c / 3 * 3;
  return {corner[f + (c + 1 - f) % 3], corner[f + (c + 2 - f) % 3]};
}

// Half-edges grouped by their smaller vertex, each row sorted by (larger vertex, corner).
struct Buckets {
  std::vector<Index> offset;
  std::vector<std::uint64_t> key;  // larger vertex << 32 | corner
};

Buckets bucket_half_edges(const Work& work, const Mesh& mesh) {
  Buckets b;
  b.offset.assign(std::size_t{mesh.vertex_count()} + 1, 0);
  const std::size_t corners = mesh.corner.size();
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    std::atomic_ref<Index>(b.offset[half_edge(mesh.corner, c).low()]).fetch_add(1, std::memory_order_relaxed);
  });
  b.key.resize(exclusive_scan<Index>(work, b.offset));
  std::vector<Index> cursor(b.offset);
  for_each(work, Cost::light, corners, [&](std::size_t c) {
    const HalfEdge h = half_edge(mesh.corner, c);
    const Index at = std::atomic_ref<Index>(cursor[h.low()]).fetch_add(1, std::memory_order_relaxed);
    b.key[at] = (std::uint64_t{h.high()} << 32) | c;
  });
  for_each(work, Cost::light, mesh.vertex_count(),
           [&](std::size_t v) { sort_short(b.key.begin() + b.offset[v], b.key.begin() + b.offset[v + 1]); });
  return b;
}

void write_edges(const Work& work, const Buckets& b, Mesh& mesh) {
  const Index vertices = mesh.vertex_count();
  const auto starts_edge = [&](Index v, Index i) {
    return i == b.offset[v] || (b.key[i] >> 32) != (b.key[i - 1] >> 32);
  };
  std::vector<Index> first(vertices);
  for_each(work, Cost::light, vertices, [&](std::size_t v) {
    Index n = 0;
    for (Index i = b.offset[v]; i < b.offset[v + 1]; ++i) n += starts_edge(static_cast<Index>(v), i) ? 1 : 0;
    first[v] = n;
  });
  const Index edges = exclusive_scan<Index>(work, first);
  mesh.edge_v0.resize(edges), mesh.edge_v1.resize(edges);
  mesh.edge_f0.resize(edges), mesh.edge_f1.assign(edges, kNone);
  mesh.face_edge.resize(mesh.corner.size());
  const Index bad = reduce(
      work, Cost::light, vertices, kNone,
      [&](std::size_t begin, std::size_t end) {
        Index worst = kNone;
        for (std::size_t v = begin; v < end; ++v) {
          Index e = first[v] - 1;
          bool forward = false;
          for (Index i = b.offset[v]; i < b.offset[v + 1]; ++i) {
            const Index c = static_cast<Index>(b.key[i]), f = c / 3;
            const bool along = half_edge(mesh.corner, c).tail == v;
            if (starts_edge(static_cast<Index>(v), i)) {
              ++e;
              mesh.edge_v0[e] = static_cast<Index>(v), mesh.edge_v1[e] = static_cast<Index>(b.key[i] >> 32);
              mesh.edge_f0[e] = f;
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
}

}  // namespace

void connect_faces(const Work& work, Mesh& mesh) {
  write_edges(work, bucket_half_edges(work, mesh), mesh);
  mesh.vertex_faces = build_csr(
      work, mesh.vertex_count(), mesh.corner.size(), [&](std::size_t c) { return mesh.corner[c]; },
      [](std::size_t c) { return static_cast<Index>(c / 3); });
}

void connect_mesh(const Work& work, Mesh& mesh) {
  connect_faces(work, mesh);
  mesh.vertex_vertices = build_csr(
      work, mesh.vertex_count(), std::size_t{mesh.edge_count()} * 2,
      [&](std::size_t i) { return i % 2 ? mesh.edge_v1[i / 2] : mesh.edge_v0[i / 2]; },
      [&](std::size_t i) { return i % 2 ? mesh.edge_v0[i / 2] : mesh.edge_v1[i / 2]; });
}

}  // namespace intarsia
