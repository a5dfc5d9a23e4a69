#include "engine/data/group_walk.h"

#include <algorithm>

namespace intarsia {

namespace {

constexpr std::uint32_t kOld = std::uint32_t{1} << 31;  // stamps of earlier walks lie at least this far below base_

// Room for `size` items; grows in large steps.
template <class T>
void make_room(std::vector<T>& list, std::size_t size) {
  if (list.size() < size) list.resize(2 * size);
}

// Keeps the compiler from making a branch of what is computed from x.
inline std::uint32_t hidden(std::uint32_t x) {
  asm("" : "+r"(x));
  return x;
}

}  // namespace

GroupWalker::GroupWalker(const MeshView& mesh, std::span<const std::uint8_t> barrier)
    : mesh_(mesh), vertex_stamp_(mesh.vertex_count(), 0) {
  if (barrier.empty()) return;
  stop_.assign(mesh.vertex_count(), 0);
  for (std::size_t e = 0; e < barrier.size(); ++e)
    if (barrier[e]) stop_[mesh.edge_v0[e]] = stop_[mesh.edge_v1[e]] = 1;
}

void GroupWalker::new_epoch() {
  base_ += size_;
  if (base_ >= kOld - kNone / 8) {  // far from kOld by more than any walk can meet
    std::fill(vertex_stamp_.begin(), vertex_stamp_.end(), 0u);
    base_ = 1;
  }
  if (++walk_ == 0) {
    std::fill(face_stamp_.begin(), face_stamp_.end(), 0u);
    walk_ = 1;
  }
}

// Places of the neighbours of the vertices at places begin .. end - 1. With `add`, neighbours that the walk has not met
// join the list. Without a branch on that: it is a coin toss that processors cannot predict.
template <bool add>
void GroupWalker::look_around(Index begin, Index end) {
  const Index* offset = mesh_.vertex_vertices.offset.data();
  const Index* item = mesh_.vertex_vertices.item.data();
  std::uint32_t* stamp = vertex_stamp_.data();
  const std::uint32_t base = base_;
  const bool barred = add && !stop_.empty();
  Index size = size_;
  make_room(queue_, size + kRow * (end - begin) + kRow);
  make_room(near_, kRow * std::size_t{end});
  Index* queue = queue_.data();
  for (Index i = begin; i < end; ++i) {
    const Index v = queue[i];
    const Index* row = item + offset[v];
    const Index valence = offset[v + 1] - offset[v];
    Index* place = near_.data() + kRow * std::size_t{i};
    if (valence == 0 || (barred && i >= count_ && stop_[v])) {
      std::fill(place, place + kRow, i);
      continue;
    }
    const auto meet = [&](Index w) {
      const std::uint32_t x = stamp[w] - base;
      if constexpr (!add) return std::min(x, size);
      const std::uint32_t met = hidden((x >> 31) - 1);  // all ones, or 0
      const std::uint32_t at = (x & met) | (size & ~met);
      stamp[w] = base + at;
      queue[size] = w;
      size += met + 1;
      return at;
    };
    const Index last = valence - 1;
    for (Index j = 0; j < kRow; ++j) place[j] = meet(row[std::min(j, last)]);
    if (valence <= kRow) continue;
    if (add) make_room(queue_, size + valence + kRow * std::size_t{end - i});
    queue = queue_.data();
    const Index from = static_cast<Index>(far_.size());
    for (Index j = kRow; j < valence; ++j) far_.push_back(meet(row[j]));
    long_rows_.push_back({i, from, static_cast<Index>(far_.size())});
  }
  size_ = size;
}

bool GroupWalker::meet(Index first, Index count, int rings, Index most) {
  new_epoch();
  rings_ = rings;
  face_rings_ = 0;
  face_end_.fill(0);
  long_rows_.clear(), far_.clear();
  make_room(queue_, count);
  for (Index b = 0; b < count; ++b) {
    queue_[b] = first + b;
    vertex_stamp_[first + b] = base_ + b;
  }
  size_ = count_ = count;
  end_[0] = count;
  for (int k = 1; k <= rings; ++k) {
    look_around<true>(k == 1 ? 0 : end_[static_cast<std::size_t>(k - 2)], end_[static_cast<std::size_t>(k - 1)]);
    end_[static_cast<std::size_t>(k)] = size_;
    if (size_ > most) return false;
  }
  return true;
}

void GroupWalker::reach() {
  if (!stop_.empty()) {  // a vertex that ends a walk may still be reached by ways found after it
    long_rows_.clear(), far_.clear();
    look_around<false>(0, size_);
  } else if (rings_ > 0) {
    look_around<false>(end_[static_cast<std::size_t>(rings_ - 1)], size_);
  }
  for (int k = 0; k <= rings_; ++k) spread(static_cast<std::size_t>(k));
}

// Who reaches what within k rings, from the same for k - 1. Above end_[k] there are zeros, also for "not met".
void GroupWalker::spread(std::size_t k) {
  std::vector<Mask>& to = within_[k];
  make_room(to, std::size_t{size_} + 1);
  std::fill(to.begin() + end_[k], to.begin() + size_ + 1, Mask{0});
  if (k == 0) {
    for (Index b = 0; b < count_; ++b) to[b] = Mask{1} << b;
    return;
  }
  const Mask* old = within_[k - 1].data();
  const Mask* from = old;
  if (!stop_.empty()) {
    make_room(passes_, std::size_t{size_} + 1);
    for (Index i = 0; i < size_; ++i) passes_[i] = stop_[queue_[i]] ? (i < count_ ? Mask{1} << i : 0) : old[i];
    passes_[size_] = 0;
    from = passes_.data();
  }
  const Index* near = near_.data();
  for (Index i = 0; i < end_[k]; ++i, near += kRow)
    to[i] = old[i] | (((from[near[0]] | from[near[1]]) | (from[near[2]] | from[near[3]])) |
                      ((from[near[4]] | from[near[5]]) | (from[near[6]] | from[near[7]])));
  for (const LongRow& r : long_rows_) {
    if (r.place >= end_[k]) break;
    for (Index j = r.begin; j < r.end; ++j) to[r.place] |= from[far_[j]];
  }
}

void GroupWalker::collect_faces(int rings) {
  const Index* offset = mesh_.vertex_faces.offset.data();
  const Index* item = mesh_.vertex_faces.item.data();
  if (face_stamp_.empty()) face_stamp_.assign(mesh_.face_count(), 0);
  std::uint32_t* stamp = face_stamp_.data();
  const std::uint32_t now = walk_, base = base_;
  Index size = 0;
  for (int k = 1; k <= rings; ++k) {
    const Index begin = k == 1 ? 0 : end_[static_cast<std::size_t>(k - 2)], end = end_[static_cast<std::size_t>(k - 1)];
    make_room(faces_, size + kRow * (end - begin) + kRow);
    for (Index i = begin; i < end; ++i) {
      const Index v = queue_[i];
      const Index* row = item + offset[v];
      const Index valence = offset[v + 1] - offset[v];
      if (valence == 0) continue;
      Index* list = faces_.data();
      const Index last = valence - 1;
      const auto meet = [&](Index f) {
        const Index fresh = stamp[f] != now;
        stamp[f] = now;
        list[size] = f;
        size += fresh;
      };
      for (Index j = 0; j < kRow; ++j) meet(row[std::min(j, last)]);
      if (valence > kRow) {
        make_room(faces_, size + valence + kRow * std::size_t{end - i});
        list = faces_.data();
        for (Index j = kRow; j < valence; ++j) meet(row[j]);
      }
    }
    face_end_[static_cast<std::size_t>(k)] = size;
  }
  face_rings_ = rings;
  make_room(face_places_, size);
  const Index* face = faces_.data();
  const Index* corner = mesh_.corner.data();
  const std::uint32_t* met = vertex_stamp_.data();
  const Index none = size_;
  std::array<Index, 3>* place = face_places_.data();
  for (Index i = 0; i < size; ++i) {
    const Index* c = corner + 3 * std::size_t{face[i]};
    const Index p0 = met[c[0]] - base, p1 = met[c[1]] - base, p2 = met[c[2]] - base;
    place[i] = {std::min(p0, none), std::min(p1, none), std::min(p2, none)};
  }
}

std::span<const GroupWalker::Mask> GroupWalker::face_within(int k) {
  const std::size_t n = face_end_[static_cast<std::size_t>(k)];
  std::vector<Mask>& to = face_within_[static_cast<std::size_t>(k)];
  make_room(to, n);
  const Mask* from = within_[static_cast<std::size_t>(k - 1)].data();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& p = face_places_[i];
    to[i] = from[p[0]] | from[p[1]] | from[p[2]];
  }
  return {to.data(), n};
}

}  // namespace intarsia
