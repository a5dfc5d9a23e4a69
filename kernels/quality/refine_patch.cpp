#include "kernels/quality/refine_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace intarsia::kernels {
namespace {

// Triangles that know their neighbours. Edge i of a triangle is opposite its corner i.
class FlipMesh {
 public:
  FlipMesh(std::vector<Vec3>& point, std::vector<std::array<Index, 3>>& triangle)
      : point_(point), triangle_(triangle), neighbour_(triangle.size(), {kNone, kNone, kNone}) {
    struct Side {
      Index a, b, triangle, i;
      bool forward;
    };
    std::vector<Side> side;
    side.reserve(3 * triangle.size());
    for (Index t = 0; t < triangle.size(); ++t)
      for (Index i = 0; i < 3; ++i) {
        const Index a = triangle[t][(i + 1) % 3], b = triangle[t][(i + 2) % 3];
        side.push_back({std::min(a, b), std::max(a, b), t, i, a < b});
      }
    std::sort(side.begin(), side.end(), [](const Side& x, const Side& y) {
      return std::tuple(x.a, x.b, x.triangle, x.i) < std::tuple(y.a, y.b, y.triangle, y.i);
    });
    // Edges with more than two triangles stay as they are, like those of the border.
    for (std::size_t s = 0; s < side.size();) {
      std::size_t e = s;
      while (e < side.size() && side[e].a == side[s].a && side[e].b == side[s].b) ++e;
      if (e - s == 2 && side[s].forward != side[s + 1].forward) {
        neighbour_[side[s].triangle][side[s].i] = side[s + 1].triangle;
        neighbour_[side[s + 1].triangle][side[s + 1].i] = side[s].triangle;
      }
      s = e;
    }
  }

  void split(Index t, const Vec3& p) {
    const Index v = static_cast<Index>(point_.size());
    point_.push_back(p);
    const auto [a, b, c] = triangle_[t];
    const auto [na, nb, nc] = neighbour_[t];
    const Index u = static_cast<Index>(triangle_.size()), w = u + 1;
    triangle_[t] = {v, b, c}, neighbour_[t] = {na, u, w};
    triangle_.push_back({a, v, c}), neighbour_.push_back({t, nb, w});
    triangle_.push_back({a, b, v}), neighbour_.push_back({t, u, nc});
    replace(nb, t, u), replace(nc, t, w);
  }

  // One pass over all edges; the number of flips.
  Index flip_pass() {
    Index flips = 0;
    for (Index t = 0; t < triangle_.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        if (neighbour_[t][i] != kNone && t < neighbour_[t][i] && flip(t, i)) ++flips;
    return flips;
  }

 private:
  void replace(Index t, Index from, Index to) {
    if (t == kNone) return;
    for (Index& n : neighbour_[t])
      if (n == from) {
        n = to;
        return;
      }
  }
  // Cotangent of the angle at a in triangle (a, b, c).
  Real cotangent(Index a, Index b, Index c) const {
    const Vec3 u = point_[b] - point_[a], v = point_[c] - point_[a];
    const Real area = u.cross(v).norm(), scale = u.norm() * v.norm();
    return u.dot(v) / std::max(area, std::max(scale * 1e-9, Real(1e-300)));
  }
  // Whether some triangle around corner i of t has vertex v.
  bool is_joined(Index t, Index i, Index v) const {
    const Index centre = triangle_[t][i];
    for (const Index direction : {Index{1}, Index{2}}) {
      Index at = t;
      do {
        Index c = 0;
        while (triangle_[at][c] != centre) ++c;
        if (triangle_[at][(c + 1) % 3] == v || triangle_[at][(c + 2) % 3] == v) return true;
        at = neighbour_[at][(c + direction) % 3];
      } while (at != kNone && at != t);
      if (at == t) return false;
    }
    return false;
  }
  bool flip(Index t, Index i) {
    const Index u = neighbour_[t][i];
    Index j = 0;
    while (neighbour_[u][j] != t || triangle_[u][(j + 1) % 3] != triangle_[t][(i + 2) % 3]) ++j;
    const Index a = triangle_[t][i], b = triangle_[t][(i + 1) % 3], c = triangle_[t][(i + 2) % 3], d = triangle_[u][j];
    if (a == d) return false;
    const Real before = cotangent(a, b, c) + cotangent(d, c, b);
    if (!(before < -1e-9)) return false;
    if (!(cotangent(b, d, a) + cotangent(c, a, d) > before + 1e-9)) return false;
    if (is_joined(t, i, d)) return false;
    const Index ab = neighbour_[t][(i + 2) % 3], ca = neighbour_[t][(i + 1) % 3];
    const Index cd = neighbour_[u][(j + 2) % 3], db = neighbour_[u][(j + 1) % 3];
    triangle_[t] = {a, b, d}, neighbour_[t] = {db, u, ab};
    triangle_[u] = {d, c, a}, neighbour_[u] = {ca, t, cd};
    replace(db, u, t), replace(ca, t, u);
    return true;
  }

  std::vector<Vec3>& point_;
  std::vector<std::array<Index, 3>>& triangle_;
  std::vector<std::array<Index, 3>> neighbour_;
};

Real area_of(const std::vector<Vec3>& p, const std::vector<std::array<Index, 3>>& triangle) {
  Real area = 0;
  for (const auto& [a, b, c] : triangle) area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  return area;
}

}  // namespace

void refine_patch(std::vector<Vec3>& point, std::vector<std::array<Index, 3>>& triangle, const RefineOptions& options) {
  FlipMesh mesh(point, triangle);
  const auto relax = [&] {
    for (int pass = 0; pass < 20 && mesh.flip_pass() > 0; ++pass) {
    }
  };
  // Wanted size per point: from the border edges at it, which have one triangle.
  std::vector<Real> size(point.size(), 0), count(point.size(), 0);
  {
    std::vector<std::array<Index, 2>> side;
    for (const auto& t : triangle)
      for (std::size_t i = 0; i < 3; ++i)
        side.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    std::sort(side.begin(), side.end());
    for (std::size_t s = 0; s < side.size(); ++s) {
      if ((s > 0 && side[s] == side[s - 1]) || (s + 1 < side.size() && side[s] == side[s + 1])) continue;
      const Real length = (point[side[s][0]] - point[side[s][1]]).norm();
      for (const Index v : side[s]) size[v] += length, count[v] += 1;
    }
  }
  const Real area = area_of(point, triangle);
  const Real least = std::sqrt(area / std::max(Index{1}, options.most_inner));
  Real mean = 0;
  std::size_t known = 0;
  for (std::size_t v = 0; v < size.size(); ++v)
    if (count[v] > 0) size[v] = std::max(options.step * size[v] / count[v], least), mean += size[v], ++known;
  mean = known > 0 ? mean / static_cast<Real>(known) : least;
  for (std::size_t v = 0; v < size.size(); ++v)
    if (count[v] == 0) size[v] = mean;

  relax();
  const std::size_t most = point.size() + 4 * std::size_t{options.most_inner};
  for (int round = 0; round < options.rounds; ++round) {
    const Index triangles = static_cast<Index>(triangle.size());
    const std::size_t before = point.size();
    for (Index t = 0; t < triangles && point.size() < most; ++t) {
      const auto [a, b, c] = triangle[t];
      const Vec3 centre = (point[a] + point[b] + point[c]) / 3;
      const Real wanted = (size[a] + size[b] + size[c]) / 3;
      bool wide = true;
      for (const Index v : {a, b, c}) {
        const Real distance = std::numbers::sqrt2 * (point[v] - centre).norm();
        wide = wide && distance > wanted && distance > size[v];
      }
      if (!wide) continue;
      mesh.split(t, centre);
      size.push_back(wanted);
    }
    if (point.size() == before) break;
    relax();
  }
}

}  // namespace intarsia::kernels
