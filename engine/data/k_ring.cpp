#include "engine/data/k_ring.h"

#include <algorithm>

namespace intarsia {

RingWalker::RingWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier)
    : mesh_(mesh), vertex_stamp_(mesh.vertex_count(), 0), face_stamp_(mesh.face_count(), 0) {
  queue_.reserve(1024);
  faces_.reserve(1024);
  if (barrier.empty()) return;
  stop_.assign(mesh.vertex_count(), 0);
  for (std::size_t e = 0; e < barrier.size(); ++e)
    if (barrier[e]) stop_[mesh.edge_v0[e]] = stop_[mesh.edge_v1[e]] = 1;
}

void RingWalker::new_epoch() {
  if (++epoch_ != 0) return;
  std::fill(vertex_stamp_.begin(), vertex_stamp_.end(), 0u);
  std::fill(face_stamp_.begin(), face_stamp_.end(), 0u);
  epoch_ = 1;
}

void RingWalker::walk(Index v, int rings, Index cap) {
  new_epoch();
  queue_.clear();
  queue_.push_back(v);
  vertex_stamp_[v] = epoch_;
  end_[0] = 1;
  depth_ = 0;
  capped_ = false;
  face_rings_ = 0;
  face_end_[0] = 0;
  extend(rings, cap);
}

void RingWalker::extend(int rings, Index cap) {
  const Index* offset = mesh_.vertex_vertices.offset.data();
  const Index* item = mesh_.vertex_vertices.item.data();
  while (depth_ < rings && !capped_) {
    const Index begin = depth_ == 0 ? 0 : end_[depth_ - 1], end = end_[depth_];
    for (Index i = begin; i < end; ++i) {
      const Index u = queue_[i];
      if (i > 0 && !stop_.empty() && stop_[u]) continue;
      for (Index at = offset[u]; at < offset[u + 1]; ++at) {
        const Index w = item[at];
        if (vertex_stamp_[w] == epoch_) continue;
        vertex_stamp_[w] = epoch_;
        queue_.push_back(w);
      }
      if (queue_.size() > std::size_t{cap} + 1) {
        capped_ = true;
        queue_.resize(depth_ == 0 ? std::size_t{cap} + 1 : std::size_t{end});
        if (depth_ == 0) end_[++depth_] = static_cast<Index>(queue_.size());
        return;
      }
    }
    if (queue_.size() == end) return;
    end_[++depth_] = static_cast<Index>(queue_.size());
  }
}

void RingWalker::collect_faces(int rings) {
  const Index* offset = mesh_.vertex_faces.offset.data();
  const Index* item = mesh_.vertex_faces.item.data();
  faces_.clear();
  const int last = std::min({rings, depth_ + 1, kMaxRings});
  for (int k = 1; k <= last; ++k) {
    for (Index i = k == 1 ? 0 : end_[k - 2]; i < end_[k - 1]; ++i)
      for (Index at = offset[queue_[i]]; at < offset[queue_[i] + 1]; ++at) {
        const Index f = item[at];
        if (face_stamp_[f] == epoch_) continue;
        face_stamp_[f] = epoch_;
        faces_.push_back(f);
      }
    face_end_[k] = static_cast<Index>(faces_.size());
  }
  face_rings_ = last;
}

std::span<const Index> RingWalker::ring(int k) const {
  if (k > depth_ || k < 0) return {};
  const Index begin = k == 0 ? 0 : end_[k - 1];
  return {queue_.data() + begin, end_[k] - begin};
}

}  // namespace intarsia
