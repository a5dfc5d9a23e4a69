#include "engine/data/k_ring.h"

#include <algorithm>

namespace intarsia {

RingWalker::RingWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier)
    : mesh_(mesh),
      vertex_stamp_(mesh.vertex_count(), 0),
      face_stamp_(mesh.face_count(), 0),
      queue_(1024),
      faces_(1024) {
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
  queue_[0] = v;
  vertex_stamp_[v] = epoch_;
  end_[0] = 1;
  depth_ = 0;
  capped_ = false;
  face_rings_ = 0;
  face_end_[0] = 0;
  extend(rings, cap);
}

namespace {

// Appends the items of a row that do not carry the stamp yet and stamps them. Without a branch: whether an item is new
// is a coin toss that processors cannot predict.
Index append_new(const Index* begin, const Index* end, std::uint32_t epoch, std::vector<std::uint32_t>& stamps,
                 std::vector<Index>& list, Index size) {
  if (list.size() < size + static_cast<std::size_t>(end - begin)) list.resize(2 * list.size() + (end - begin));
  std::uint32_t* stamp = stamps.data();
  Index* out = list.data();
  for (; begin != end; ++begin) {
    const Index item = *begin;
    const Index fresh = stamp[item] != epoch;
    stamp[item] = epoch;
    out[size] = item;
    size += fresh;
  }
  return size;
}

}  // namespace

void RingWalker::extend(int rings, Index cap) {
  const Index* offset = mesh_.vertex_vertices.offset.data();
  const Index* item = mesh_.vertex_vertices.item.data();
  while (depth_ < rings && !capped_) {
    const Index begin = depth_ == 0 ? 0 : end_[depth_ - 1], end = end_[depth_];
    Index size = end;
    for (Index i = begin; i < end; ++i) {
      const Index u = queue_[i];
      if (i > 0 && !stop_.empty() && stop_[u]) continue;
      size = append_new(item + offset[u], item + offset[u + 1], epoch_, vertex_stamp_, queue_, size);
      if (size > cap + 1) {
        capped_ = true;
        if (depth_ == 0) end_[++depth_] = cap + 1;
        return;
      }
    }
    if (size == end) return;
    end_[++depth_] = size;
  }
}

void RingWalker::collect_faces(int rings) {
  const Index* offset = mesh_.vertex_faces.offset.data();
  const Index* item = mesh_.vertex_faces.item.data();
  Index size = 0;
  const int last = std::min({rings, depth_ + 1, kMaxRings});
  for (int k = 1; k <= last; ++k) {
    for (Index i = k == 1 ? 0 : end_[k - 2]; i < end_[k - 1]; ++i) {
      const Index u = queue_[i];
      size = append_new(item + offset[u], item + offset[u + 1], epoch_, face_stamp_, faces_, size);
    }
    face_end_[k] = size;
  }
  face_rings_ = last;
}

std::span<const Index> RingWalker::ring(int k) const {
  if (k > depth_ || k < 0) return {};
  const Index begin = k == 0 ? 0 : end_[k - 1];
  return {queue_.data() + begin, end_[k] - begin};
}

}  // namespace intarsia
