#include "kernels/surface/split_long_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "engine/parallel/reduce.h"
#include "kernels/surface/soup_sides.h"

namespace intarsia::kernels {
namespace {

// Triangles that are divided in place. Side 3 t + i runs from corner i of triangle t to corner i + 1.
class Splitter {
 public:
  Splitter(const Work& work, const Soup& soup, Real length) : work_(work), length_(length) {
    out_.soup = soup;
    out_.soup.source_face.clear();
    const std::vector<Side> side = sorted_sides(work, soup.corner);
    partner_.assign(side.size(), kNone);
    for (std::size_t i = 1; i < side.size(); ++i)
      if (side[i].same_edge(side[i - 1])) partner_[side[i].at] = side[i - 1].at, partner_[side[i - 1].at] = side[i].at;
    out_.parent.resize(soup.face_count());
    for (Index t = 0; t < soup.face_count(); ++t) out_.parent[t] = t;
  }

  SplitSoup run() {
    for (Index t = 0; t < out_.parent.size(); ++t) {  // grows: the parts come after all others
      while (length_of(longest(t)) > length_) bisect(end_of_path(t));
      if ((t & 0xfff) == 0) work_.check();
    }
    return std::move(out_);
  }

 private:
  Index& corner(Index c) { return out_.soup.corner[c]; }
  static Index next(Index s) { return s % 3 == 2 ? s - 2 : s + 1; }
  Vec3 point(Index v) const { return {out_.soup.x[v], out_.soup.y[v], out_.soup.z[v]}; }
  Real length_of(Index s) { return (point(corner(next(s))) - point(corner(s))).norm(); }

  // Edges by length, then by their vertices: both triangles of an edge agree on the order.
  std::tuple<Real, Index, Index> rank(Index s) {
    const Index a = corner(s), b = corner(next(s));
    return {(point(std::min(a, b)) - point(std::max(a, b))).norm(), std::min(a, b), std::max(a, b)};
  }
  Index longest(Index t) {
    Index best = 3 * t;
    for (Index s = 3 * t + 1; s < 3 * t + 3; ++s)
      if (rank(s) > rank(best)) best = s;
    return best;
  }
  // The side that is the longest of both its triangles, on the way over longer and longer ones.
  Index end_of_path(Index t) {
    for (Index s = longest(t);;) {
      const Index p = partner_[s];
      if (p == kNone) return s;
      const Index q = longest(p / 3);
      if (q == p) return s;
      s = q;
    }
  }

  void join(Index s, Index p) {
    partner_[s] = p;
    if (p != kNone) partner_[p] = s;
  }

  // Halves the triangle of side s at m: it keeps the first half of s. Returns the side of the other half.
  Index halve(Index s, Index m) {
    const Index t = s / 3, part = static_cast<Index>(out_.parent.size());
    const Index b = next(s), c = next(b);
    out_.parent.push_back(out_.parent[t]);
    out_.soup.corner.insert(out_.soup.corner.end(), {m, corner(b), corner(c)});
    partner_.resize(partner_.size() + 3, kNone);
    join(3 * part + 1, partner_[b]);
    corner(b) = m;
    join(b, 3 * part + 2);
    return 3 * part;
  }

  void bisect(Index s) {
    const Index p = partner_[s], m = out_.soup.vertex_count();
    const Vec3 middle = 0.5 * (point(corner(s)) + point(corner(next(s))));
    out_.soup.x.push_back(middle.x()), out_.soup.y.push_back(middle.y()), out_.soup.z.push_back(middle.z());
    const Index other = halve(s, m);
    partner_[s] = kNone;
    if (p == kNone) return;
    const Index across = halve(p, m);
    join(s, across), join(other, p);
  }

  const Work& work_;
  Real length_;
  std::vector<Index> partner_;
  SplitSoup out_;
};

}  // namespace

Real edge_variation(const Work& work, const Soup& soup) {
  using Sums = std::array<Real, 2>;
  const Sums sums = reduce(
      work, Cost::light, soup.corner.size(), Sums{},
      [&](std::size_t begin, std::size_t end) {
        Sums part{};
        for (std::size_t c = begin; c < end; ++c) {
          const Index a = soup.corner[c], b = soup.corner[c % 3 == 2 ? c - 2 : c + 1];
          const Real dx = soup.x[a] - soup.x[b], dy = soup.y[a] - soup.y[b], dz = soup.z[a] - soup.z[b];
          const Real square = dx * dx + dy * dy + dz * dz;
          part[0] += std::sqrt(square), part[1] += square;
        }
        return part;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a[0] + b[0], a[1] + b[1]};
      });
  if (!(sums[0] > 0)) return 0;
  const Real n = static_cast<Real>(soup.corner.size()), mean = sums[0] / n;
  return std::sqrt(std::max<Real>(0, sums[1] / n - mean * mean)) / mean;
}

// Expects of a triangle with longest side a and height h about 4 (a / l) max(1, h / l) parts with sides up to l.
bool is_polyhedral(const Work& work, const Soup& soup, const SplitEdgesOptions& options) {
  constexpr Real kFlat = 0.02, kSharp = 0.5, kFewBetween = 0.02;  // radians; share of the edges
  const Index faces = soup.face_count();
  if (faces > options.few) return false;
  std::vector<Vec3> normal(faces);
  const auto at = [&](Index v) { return Vec3(soup.x[v], soup.y[v], soup.z[v]); };
  for (Index f = 0; f < faces; ++f) {
    const Index* c = &soup.corner[3 * std::size_t{f}];
    normal[f] = (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0]));
  }
  const std::vector<Side> side = sorted_sides(work, soup.corner);
  Index edges = 0, between = 0, sharp = 0;
  for_each_edge(work, side, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const Vec3 &m = normal[side[begin].triangle()], &n = normal[side[begin + 1].triangle()];
    const Real turn = std::atan2(m.cross(n).norm(), m.dot(n));
    ++edges;
    between += turn > kFlat && turn < kSharp ? 1 : 0;
    sharp += turn >= kSharp ? 1 : 0;
  });
  return sharp > 0 && between <= kFewBetween * edges;
}

bool has_pillows(const Work& work, const Soup& soup) {
  const std::vector<Side> side = sorted_sides(work, soup.corner);
  const auto opposite = [&](const Side& s) {
    return soup.corner[3 * s.triangle() + (s.at + 2 - 3 * s.triangle()) % 3];
  };
  bool found = false;
  for_each_edge(work, side, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end; ++i) found = found || opposite(side[i]) == opposite(side[begin]);
  });
  return found;
}

Real split_length(const Work& work, const Soup& soup, Real diagonal, const SplitEdgesOptions& options) {
  const auto parts = [&](Real length) {
    return sum(work, Cost::light, soup.corner.size() / 3, Real(0), [&](std::size_t t) {
      Vec3 p[3];
      for (int i = 0; i < 3; ++i) {
        const Index v = soup.corner[3 * t + i];
        p[i] = {soup.x[v], soup.y[v], soup.z[v]};
      }
      const Real longest =
          std::sqrt(std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()}));
      if (longest <= length) return Real(1);
      const Real height = (p[1] - p[0]).cross(p[2] - p[0]).norm() / longest;
      return 4 * longest / length * std::max<Real>(1, height / length);
    });
  };
  Real length = options.length;
  while (length < 1 && parts(length * diagonal) > options.most_triangles) length *= 1.25;
  return length;
}

SplitSoup split_long_edges(const Work& work, const Soup& soup, Real length) {
  return Splitter(work, soup, length).run();
}

}  // namespace intarsia::kernels
