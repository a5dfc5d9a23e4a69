#include "tools/step/patch_piece.h"

#include <algorithm>
#include <numeric>

#include "engine/base/error.h"
#include "engine/data/patch_labels.h"

namespace intarsia::tools {
namespace {

Index root_of(std::vector<Index>& parent, Index c) {
  while (parent[c] != c) c = parent[c] = parent[parent[c]];
  return c;
}

void join(std::vector<Index>& parent, Index a, Index b) {
  a = root_of(parent, a), b = root_of(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace

std::vector<Index> PatchPiece::side_points(const Loop& l, std::size_t s) const {
  const std::size_t begin = l.side[s].begin, n = l.point.size();
  const std::size_t end = s + 1 < l.side.size() ? l.side[s + 1].begin : n;
  std::vector<Index> out;
  for (std::size_t i = begin; i <= end; ++i) out.push_back(l.point[i % n]);
  return out;
}

PatchPieces::PatchPieces(const MeshView& mesh, std::span<const Index> label, const LayoutGraph& graph)
    : mesh_(mesh), label_(label), graph_(graph) {
  PatchLabels labels;
  labels.patch_of_face.assign(label.begin(), label.end());
  labels.count = graph.patch_count();
  faces_ = faces_of_patches(labels);
  place_.resize(mesh.face_count());
  for (Index p = 0; p < faces_.rows(); ++p) {
    const auto row = faces_.row(p);
    for (std::size_t i = 0; i < row.size(); ++i) place_[row[i]] = static_cast<Index>(i);
  }
  is_border_.assign(mesh.edge_count(), 0);
  for (const Index e : graph.arc_edges.item) is_border_[e] = 1;
}

PatchPiece PatchPieces::piece(Index patch) const {
  const auto faces = faces_.row(patch);
  PatchPiece piece;
  piece.face.assign(faces.begin(), faces.end());
  std::vector<Index> parent(3 * faces.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  std::size_t open_edges = 0;
  for (std::size_t t = 0; t < faces.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Index f = faces[t], e = mesh_.face_edge[3 * f + i], other = mesh_.other_face(e, f);
      if (other == kNone || is_border_[e] || label_[other] != patch) {
        ++open_edges;
        continue;
      }
      for (const Index v : {mesh_.edge_v0[e], mesh_.edge_v1[e]})
        join(parent, static_cast<Index>(3 * t) + static_cast<Index>(mesh_.corner_of(f, v)),
             3 * place_[other] + static_cast<Index>(mesh_.corner_of(other, v)));
    }
  std::vector<Index> number(parent.size(), kNone);
  piece.triangle.resize(faces.size());
  for (Index c = 0; c < parent.size(); ++c) {
    const Index r = root_of(parent, c);  // not above c
    const Index v = mesh_.corner[3 * faces[c / 3] + c % 3];
    if (number[r] == kNone) {
      number[r] = static_cast<Index>(piece.vertex.size());
      piece.vertex.push_back(v), piece.point.push_back(mesh_.point(v));
    }
    piece.triangle[c / 3][c % 3] = number[r];
  }
  const std::size_t edges = (3 * faces.size() + open_edges) / 2;
  piece.euler = static_cast<int>(piece.point.size()) - static_cast<int>(edges) + static_cast<int>(faces.size());

  for (const Index l : graph_.patch_loops.row(patch)) {
    PatchPiece::Loop loop;
    for (const Index half : graph_.loop.row(l)) {
      loop.side.push_back({half, static_cast<Index>(loop.point.size())});
      const auto edge = graph_.arc_edges.row(half / 2);
      const auto vertex = graph_.arc.row(half / 2);
      for (std::size_t i = 0; i < edge.size(); ++i) {
        const std::size_t k = half % 2 ? edge.size() - 1 - i : i;
        const Index from = vertex[half % 2 ? k + 1 : k], to = vertex[half % 2 ? k : k + 1];
        Index at = kNone;
        for (const Index f : {mesh_.edge_f0[edge[k]], mesh_.edge_f1[edge[k]]}) {
          if (f == kNone || label_[f] != patch) continue;
          const int c = mesh_.corner_of(f, from);
          if (mesh_.corner[3 * f + (c + 1) % 3] == to) at = piece.triangle[place_[f]][c];
        }
        if (at == kNone)
          throw Error(ErrorCode::bad_file, "network.json: arc " + std::to_string(half / 2) + " does not bound patch " +
                                               std::to_string(patch) + "; let intarsia run write the result again");
        loop.point.push_back(at);
        loop.length += (mesh_.point(to) - mesh_.point(from)).norm();
      }
    }
    piece.loop.push_back(std::move(loop));
  }
  std::stable_sort(piece.loop.begin(), piece.loop.end(),
                   [](const auto& a, const auto& b) { return a.length > b.length; });
  return piece;
}

}  // namespace intarsia::tools
