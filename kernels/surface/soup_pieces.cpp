#include "kernels/surface/soup_pieces.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include <Eigen/Geometry>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();

struct Piece {
  Real area = 0, volume = 0;
  Vec3 low = Vec3::Constant(kFar), high = Vec3::Constant(-kFar);
  bool closed = true;

  void add(const Soup& soup, std::size_t t, std::span<const std::uint8_t> on_border, const Vec3& middle) {
    Vec3 at[3];
    for (int i = 0; i < 3; ++i) {
      const Index v = soup.corner[3 * t + i];
      at[i] = Vec3(soup.x[v], soup.y[v], soup.z[v]) - middle;
      low = low.cwiseMin(at[i]), high = high.cwiseMax(at[i]);
      closed = closed && on_border[v] == 0;
    }
    const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]);
    area += normal.norm() / 2, volume += normal.dot(at[0]) / 6;
  }
};

Piece join(const Piece& a, const Piece& b) {
  return {a.area + b.area, a.volume + b.volume, a.low.cwiseMin(b.low), a.high.cwiseMax(b.high), a.closed && b.closed};
}

// Numbers of the pieces by vertex: kNone where no triangle is.
Index number_pieces(const Work& work, const Soup& soup, std::vector<Index>& number) {
  UnionFind joined(soup.vertex_count());
  std::vector<std::uint8_t> used(soup.vertex_count(), 0);
  for_each(work, Cost::light, soup.corner.size() / 3, [&](std::size_t t) {
    joined.unite(soup.corner[3 * t], soup.corner[3 * t + 1]);
    joined.unite(soup.corner[3 * t], soup.corner[3 * t + 2]);
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
      std::atomic_ref<std::uint8_t>(used[soup.corner[c]]).store(1, std::memory_order_relaxed);
  });
  const std::vector<Index> root =
      compact(work, used.size(), [&](std::size_t v) { return used[v] && joined.find(static_cast<Index>(v)) == v; });
  if (root.size() == 1) return 1;
  number.assign(soup.vertex_count(), kNone);
  for (std::size_t p = 0; p < root.size(); ++p) number[root[p]] = static_cast<Index>(p);
  for_each(work, Cost::light, number.size(), [&](std::size_t v) {
    const Index r = joined.find(static_cast<Index>(v));
    if (r != v && used[v]) number[v] = number[r];
  });
  return static_cast<Index>(root.size());
}

}  // namespace

SoupPieces soup_pieces(const Work& work, const Soup& soup, std::span<const std::uint8_t> on_border,
                       const Vec3& middle) {
  const std::size_t triangles = soup.corner.size() / 3;
  std::vector<Index> number;
  std::vector<Piece> piece(number_pieces(work, soup, number));
  SoupPieces out;
  if (piece.size() == 1) {
    piece[0] = reduce(
        work, Cost::light, triangles, Piece{},
        [&](std::size_t begin, std::size_t end) {
          Piece part;
          for (std::size_t t = begin; t < end; ++t) part.add(soup, t, on_border, middle);
          return part;
        },
        join);
  } else {
    out.piece.resize(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {  // serial: sums in the order of the file
      out.piece[t] = number[soup.corner[3 * t]];
      piece[out.piece[t]].add(soup, t, on_border, middle);
      if ((t & 0xffff) == 0) work.check();
    }
  }
  for (const Piece& p : piece) {
    out.area.push_back(p.area), out.volume.push_back(p.volume), out.closed.push_back(p.closed ? 1 : 0);
    out.low.push_back(p.low), out.high.push_back(p.high);
    out.total_area += p.area;
  }
  return out;
}

std::vector<Index> specks(const SoupPieces& pieces, Real share, Real most) {
  std::vector<Index> small;
  Real dropped = 0;
  for (Index p = 0; p < pieces.count(); ++p)
    if (pieces.area[p] < share * pieces.total_area) small.push_back(p), dropped += pieces.area[p];
  if (dropped > most * pieces.total_area) small.clear();
  return small;
}

std::vector<Index> inward_pieces(const SoupPieces& pieces) {
  Real sum = 0;
  std::vector<Index> closed;
  for (Index p = 0; p < pieces.count(); ++p)
    if (pieces.closed[p]) sum += pieces.volume[p], closed.push_back(p);
  const Real sign = sum < 0 ? -1 : 1;
  const auto inside = [&](Index p, Index q) {
    return p != q && (pieces.low[p].array() >= pieces.low[q].array()).all() &&
           (pieces.high[p].array() <= pieces.high[q].array()).all();
  };
  // Few boxes hold others: only the large are asked.
  constexpr std::size_t kAsked = 64;
  std::vector<Index> large = closed;
  std::sort(large.begin(), large.end(), [&](Index p, Index q) {
    return pieces.area[p] != pieces.area[q] ? pieces.area[p] > pieces.area[q] : p < q;
  });
  if (large.size() > kAsked) large.resize(kAsked);
  std::vector<Index> turned;
  for (const Index p : closed) {
    bool turn = sign < 0;
    if (sign * pieces.volume[p] < 0 && std::none_of(large.begin(), large.end(), [&](Index q) { return inside(p, q); }))
      turn = !turn;
    if (turn) turned.push_back(p);
  }
  return turned;
}

}  // namespace intarsia::kernels
