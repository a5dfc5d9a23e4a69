#include "kernels/surface/check_soup.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/reduce.h"

namespace intarsia::kernels {
namespace {

constexpr const char* kRepairHint =
    "; repair the mesh (for example with a clean-up filter of a mesh editor) and try again";

std::string text(Index i) { return std::to_string(i); }

Index smallest(Index a, Index b) { return std::min(a, b); }

// The smallest i in [0, items) with bad(i), or kNone.
template <class Bad>
Index first_bad(const Work& work, std::size_t items, const Bad& bad) {
  return reduce(
      work, Cost::light, items, kNone,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (bad(static_cast<Index>(i))) return static_cast<Index>(i);
        return kNone;
      },
      smallest);
}

Vec3 point(const Soup& s, Index v) { return {s.x[v], s.y[v], s.z[v]}; }

// Free of overflow and underflow: each side is scaled to size 1 first.
bool has_area(const Soup& s, Index f) {
  const Vec3 a = point(s, s.corner[3 * std::size_t{f}]);
  const Vec3 u = point(s, s.corner[3 * std::size_t{f} + 1]) - a, w = point(s, s.corner[3 * std::size_t{f} + 2]) - a;
  const Real m = u.cwiseAbs().maxCoeff(), n = w.cwiseAbs().maxCoeff();
  return m > 0 && n > 0 && (u / m).cross(w / n).squaredNorm() > 0;
}

Index first_repeated(const Work& work, const Soup& soup) {
  return first_bad(work, soup.face_count(), [&](Index f) {
    const Index* c = &soup.corner[3 * std::size_t{f}];
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  });
}

enum class Defect : std::uint8_t { none, crowded_edge, direction, fan };

// The faces around one vertex v: `next` and `prev` are the vertices after and before v in each face.
struct Star {
  struct Spoke {
    Index next, prev, corner;
  };
  std::vector<Spoke> spoke;  // by (next, corner)
  std::vector<Index> prev;   // ascending
  std::vector<Index> next;   // ascending

  void read(const Soup& soup, std::span<const Index> corners) {
    spoke.clear(), prev.clear(), next.clear();
    for (Index c : corners) {
      const Index f = c / 3 * 3, i = c - f;
      spoke.push_back({soup.corner[f + (i + 1) % 3], soup.corner[f + (i + 2) % 3], c});
    }
    std::sort(spoke.begin(), spoke.end(),
              [](const Spoke& a, const Spoke& b) { return a.next != b.next ? a.next < b.next : a.corner < b.corner; });
    for (const Spoke& s : spoke) next.push_back(s.next), prev.push_back(s.prev);
    std::sort(prev.begin(), prev.end());
  }
  static std::size_t count(const std::vector<Index>& sorted, Index v) {
    const auto range = std::equal_range(sorted.begin(), sorted.end(), v);
    return static_cast<std::size_t>(range.second - range.first);
  }
  std::size_t faces_on(Index v) const { return count(next, v) + count(prev, v); }

  // True if some edge at the vertex has one face.
  bool is_open() const {
    const auto alone = [this](Index v) { return faces_on(v) == 1; };
    return std::any_of(next.begin(), next.end(), alone) || std::any_of(prev.begin(), prev.end(), alone);
  }
  // Only spokes to larger vertices are asked, so that each edge is judged once.
  Defect edge_defect(Index v, Index& other) const {
    Defect worst = Defect::none;
    const auto judge = [&](const std::vector<Index>& row) {
      for (std::size_t i = 1; i < row.size(); ++i)
        if (row[i] == row[i - 1] && row[i] > v) {
          const Defect d = faces_on(row[i]) > 2 ? Defect::crowded_edge : Defect::direction;
          if (worst == Defect::none || (d == Defect::crowded_edge && worst == Defect::direction) ||
              (d == worst && row[i] < other))
            worst = d, other = row[i];
        }
    };
    judge(next), judge(prev);
    return worst;
  }
  // True if walking from face to face around the vertex reaches all of them.
  bool is_one_fan() const {
    if (spoke.size() < 2) return true;
    Index first = spoke.front().next;
    for (const Spoke& s : spoke)
      if (!std::binary_search(prev.begin(), prev.end(), s.next)) {  // no face before this one: a border
        first = s.next;
        break;
      }
    std::size_t seen = 0;
    for (Index at = first; seen < spoke.size();) {  // bounded: edges to smaller vertices are judged elsewhere
      const auto it =
          std::lower_bound(spoke.begin(), spoke.end(), at, [](const Spoke& s, Index v) { return s.next < v; });
      if (it == spoke.end() || it->next != at) break;
      ++seen;
      at = it->prev;
      if (at == first) break;
    }
    return seen == spoke.size();
  }
};

// True if the star is beyond doubt in order: few faces, no two of them running along an edge in the same direction, and
// one fan. Most stars are; the others are looked at closely.
// Then `open` tells whether it is open.
bool is_plain_star(const Soup& soup, std::span<const Index> corners, bool& open) {
  constexpr std::size_t kFew = 12;
  const std::size_t n = corners.size();
  if (n > kFew) return false;
  Index next[kFew], prev[kFew];
  for (std::size_t i = 0; i < n; ++i) {
    const Index f = corners[i] / 3 * 3, c = corners[i] - f;
    next[i] = soup.corner[f + (c == 2 ? 0 : c + 1)], prev[i] = soup.corner[f + (c == 0 ? 2 : c - 1)];
  }
  // Where no two faces have the same next or the same prev vertex, each follows at most one and is followed by at most
  // one: they form rings and open fans, and an open fan ends with a face that nothing follows.
  std::size_t follower[kFew], followed = 0;
  for (std::size_t i = 0; i < n; ++i) {
    follower[i] = n;
    bool twice = false;
    for (std::size_t j = 0; j < n; ++j) {
      twice |= j != i && (next[j] == next[i] || prev[j] == prev[i]);
      follower[i] = next[j] == prev[i] ? j : follower[i];
    }
    if (twice) return false;
    followed += follower[i] < n;
  }
  if (followed + 1 < n) return false;
  open = followed < n;
  std::size_t first = 0;
  if (followed < n) {
    std::size_t sum = n * (n - 1) / 2;  // of all faces, less those that follow one: what follows none
    for (std::size_t i = 0; i < n; ++i) sum -= follower[i] < n ? follower[i] : 0;
    first = sum;
  }
  std::size_t seen = 0;
  for (std::size_t at = first; seen < n && at < n; ++seen) {
    at = follower[at];
    if (at == first) return seen + 1 == n;
  }
  return seen == n;
}

struct Finding {
  Index crowded = kNone, direction = kNone, fan = kNone;  // smallest vertex of each kind of defect
};

[[noreturn]] void refuse_edge(const Soup& soup, const Csr& corners, Index v, Defect defect) {
  Star star;
  star.read(soup, corners.row(v));
  Index other = kNone;
  star.edge_defect(v, other);
  Index lowest = kNone;
  std::string list;
  for (Index c : corners.row(v)) {
    const Index f = c / 3;
    const Index* k = &soup.corner[3 * std::size_t{f}];
    if (k[0] != other && k[1] != other && k[2] != other) continue;
    lowest = std::min(lowest, soup.source_of(f));
    list += (list.empty() ? "" : ", ") + text(soup.source_of(f));
  }
  const std::string edge = "the edge between vertices " + text(v) + " and " + text(other);
  throw Error(ErrorCode::rejected,
              defect == Defect::crowded_edge
                  ? edge + " has more than two faces (" + list + ")" + kRepairHint
                  : "faces " + list + " run along " + edge + " in the same direction; orient the faces consistently",
              lowest);
}

Csr corners_by_vertex(const Work& work, const Soup& soup) {
  return build_csr(
      work, soup.vertex_count(), soup.corner.size(), [&](std::size_t c) { return soup.corner[c]; },
      [](std::size_t c) { return static_cast<Index>(c); });
}

// on_border: per vertex, set where the star is open; may be null.
Finding judge_stars(const Work& work, const Soup& soup, const Csr& corners, std::uint8_t* on_border) {
  return reduce(
      work, Cost::light, corners.rows(), Finding{},
      [&](std::size_t begin, std::size_t end) {
        Finding part;
        Star star;
        for (std::size_t i = begin; i < end; ++i) {
          const Index v = static_cast<Index>(i);
          bool open = false;
          const bool plain = is_plain_star(soup, corners.row(v), open);
          if (on_border) on_border[v] = open ? 1 : 0;
          if (plain) continue;
          star.read(soup, corners.row(v));
          if (on_border) on_border[v] = star.is_open() ? 1 : 0;
          Index other = kNone;
          const Defect d = star.edge_defect(v, other);
          if (d == Defect::crowded_edge) part.crowded = std::min(part.crowded, v);
          if (d == Defect::direction) part.direction = std::min(part.direction, v);
          if (d == Defect::none && part.fan == kNone && !star.is_one_fan()) part.fan = v;
        }
        return part;
      },
      [](const Finding& a, const Finding& b) {
        return Finding{std::min(a.crowded, b.crowded), std::min(a.direction, b.direction), std::min(a.fan, b.fan)};
      });
}

void check_stars(const Work& work, const Soup& soup) {
  const Csr corners = corners_by_vertex(work, soup);
  const Finding found = judge_stars(work, soup, corners, nullptr);
  if (found.crowded != kNone) refuse_edge(soup, corners, found.crowded, Defect::crowded_edge);
  if (found.direction != kNone) refuse_edge(soup, corners, found.direction, Defect::direction);
  if (found.fan != kNone)
    throw Error(ErrorCode::rejected,
                "vertex " + text(found.fan) +
                    " joins parts of the surface that touch only there; split the vertex, one copy for each part",
                found.fan);
}

}  // namespace

void check_corners(const Work& work, const Soup& soup) {
  if (soup.corner.size() >= kNone)
    throw Error(ErrorCode::too_large, "the mesh has more than " + text(kNone / 3) + " triangles; reduce it");
  if (soup.corner.empty()) throw Error(ErrorCode::rejected, "the mesh has no faces; give a triangle surface");
  const auto face = [&](Index f) { return &soup.corner[3 * std::size_t{f}]; };
  const Index faces = soup.face_count(), vertices = soup.vertex_count();
  const Index out = first_bad(
      work, faces, [&](Index f) { return face(f)[0] >= vertices || face(f)[1] >= vertices || face(f)[2] >= vertices; });
  if (out != kNone)
    throw Error(ErrorCode::rejected,
                "face " + text(soup.source_of(out)) + " names a vertex that does not exist" + kRepairHint,
                soup.source_of(out));
  const Index endless = reduce(
      work, Cost::light, soup.corner.size(), kNone,
      [&](std::size_t begin, std::size_t end) {
        Index worst = kNone;
        for (std::size_t c = begin; c < end; ++c)
          if (!point(soup, soup.corner[c]).allFinite()) worst = std::min(worst, soup.corner[c]);
        return worst;
      },
      smallest);
  if (endless != kNone)
    throw Error(ErrorCode::rejected,
                "vertex " + text(endless) + " has a coordinate that is not a finite number; remove it and its faces",
                endless);
  if (first_bad(work, faces, [&](Index f) { return has_area(soup, f); }) == kNone)
    throw Error(ErrorCode::rejected, "no face has an area; check the export of the mesh");
}

void check_soup(const Work& work, const Soup& soup) {
  check_corners(work, soup);
  const Index repeated = first_repeated(work, soup);
  if (repeated != kNone)
    throw Error(ErrorCode::rejected,
                "face " + text(soup.source_of(repeated)) + " uses a vertex twice; remove such faces and try again",
                soup.source_of(repeated));
  check_stars(work, soup);
}

SoupState look_at_soup(const Work& work, const Soup& soup) {
  SoupState state;
  state.repeated_corners = first_repeated(work, soup) != kNone;
  if (state.repeated_corners) return state;
  state.on_border.assign(soup.vertex_count(), 0);
  const Finding found = judge_stars(work, soup, corners_by_vertex(work, soup), state.on_border.data());
  state.is_surface = found.crowded == kNone && found.direction == kNone && found.fan == kNone;
  return state;
}

}  // namespace intarsia::kernels
