#include "kernels/surface/diagnose_soup.h"

#include <algorithm>
#include <array>
#include <compare>
#include <limits>

#include "engine/parallel/compact.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/sort.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

constexpr Real kZeroArea = 1e-14;  // of the squared diagonal

// A side of a triangle: ends in ascending order. `forward`: the triangle runs from the first to the second.
struct Side {
  Index a, b, triangle;
  bool forward;
  auto operator<=>(const Side&) const = default;
};

struct Corners {
  std::array<Index, 3> v;
  Index triangle;
  auto operator<=>(const Corners&) const = default;
};

std::array<Index, 3> corners_of(const Soup& soup, std::size_t t) {
  return {soup.corner[3 * t], soup.corner[3 * t + 1], soup.corner[3 * t + 2]};
}

Vec3 point(const Soup& soup, Index v) { return {soup.x[v], soup.y[v], soup.z[v]}; }

bool repeats(const std::array<Index, 3>& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

class Diagnosis {
 public:
  Diagnosis(const Work& work, const Soup& soup)
      : work_(work), soup_(soup), triangles_(soup.corner.size() / 3), used_(soup.vertex_count(), 0) {}

  SoupDiagnosis run() {
    out_.vertices = soup_.vertex_count();
    out_.triangles = triangles_;
    look_at_vertices();
    look_at_triangles();
    look_at_duplicates();
    look_at_edges();
    look_at_fans();
    count_components();
    if (out_.is_surface() && triangles_ > 0) {
      const std::int64_t used = static_cast<std::int64_t>(out_.vertices - out_.isolated_vertices.count);
      const std::int64_t euler =
          used - static_cast<std::int64_t>(out_.edges) + static_cast<std::int64_t>(out_.triangles);
      out_.genus =
          (2 * static_cast<std::int64_t>(out_.components) - static_cast<std::int64_t>(out_.border_loops) - euler) / 2;
    }
    return std::move(out_);
  }

 private:
  void look_at_vertices() {
    for (const Index v : soup_.corner) used_[v] = 1;
    const std::vector<Index> isolated = compact(work_, used_.size(), [&](std::size_t v) { return !used_[v]; });
    out_.isolated_vertices = fault_of(isolated, isolated.size());
    constexpr Real inf = std::numeric_limits<Real>::infinity();
    Vec3 low = Vec3::Constant(inf), high = -low;
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v]) {
        const Vec3 p = point(soup_, static_cast<Index>(v));
        low = low.cwiseMin(p), high = high.cwiseMax(p);
      }
    if (!(low.x() <= high.x())) return;
    out_.low = low, out_.high = high, out_.diagonal = (high - low).norm();
  }

  void look_at_triangles() {
    const auto twice_area = [&](std::size_t t) {
      const auto [a, b, c] = corners_of(soup_, t);
      const Vec3 p = point(soup_, a);
      return (point(soup_, b) - p).cross(point(soup_, c) - p).norm();
    };
    const std::vector<Index> repeated =
        compact(work_, triangles_, [&](std::size_t t) { return repeats(corners_of(soup_, t)); });
    out_.repeated_corners = named_triangles(repeated);
    const Real least = 2 * kZeroArea * out_.diagonal * out_.diagonal;
    const std::vector<Index> flat = compact(
        work_, triangles_, [&](std::size_t t) { return !repeats(corners_of(soup_, t)) && !(twice_area(t) > least); });
    out_.zero_area = named_triangles(flat);
    out_.area = sum(work_, Cost::light, triangles_, Real(0), twice_area) / 2;
  }

  Fault named_triangles(const std::vector<Index>& ids) const {
    std::vector<Index> named;
    for (std::size_t i = 0; i < std::min(ids.size(), 4 * Fault::kNamed); ++i) named.push_back(soup_.source_of(ids[i]));
    return fault_of(std::move(named), ids.size());
  }

  void look_at_duplicates() {
    std::vector<Corners> all(triangles_);
    for_each(work_, Cost::light, triangles_, [&](std::size_t t) {
      all[t] = {corners_of(soup_, t), static_cast<Index>(t)};
      std::sort(all[t].v.begin(), all[t].v.end());
    });
    sort_total(work_, all.begin(), all.end());
    std::vector<Index> again =
        compact(work_, triangles_, [&](std::size_t i) { return i > 0 && all[i].v == all[i - 1].v; });
    for (Index& i : again) i = all[i].triangle;
    std::sort(again.begin(), again.end());
    out_.duplicate_triangles = named_triangles(again);
  }

  void look_at_edges() {
    side_.resize(3 * triangles_);
    for_each(work_, Cost::light, triangles_, [&](std::size_t t) {
      const std::array<Index, 3> c = corners_of(soup_, t);
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = c[i], b = c[(i + 1) % 3];
        side_[3 * t + i] = repeats(c) ? Side{} : Side{std::min(a, b), std::max(a, b), static_cast<Index>(t), a < b};
      }
    });
    std::erase_if(side_, [](const Side& s) { return s.a == s.b; });
    sort_total(work_, side_.begin(), side_.end());
    Real length = 0;
    std::vector<Index> crowded, turned;
    UnionFind border(soup_.vertex_count());
    std::vector<Index> border_vertex;
    for (std::size_t i = 0; i < side_.size();) {
      std::size_t end = i + 1;
      while (end < side_.size() && side_[end].a == side_[i].a && side_[end].b == side_[i].b) ++end;
      const Real l = (point(soup_, side_[i].a) - point(soup_, side_[i].b)).norm();
      length += l;
      if (out_.edges++ == 0) out_.edge_least = l;
      out_.edge_least = std::min(out_.edge_least, l), out_.edge_most = std::max(out_.edge_most, l);
      const std::size_t n = end - i;
      if (n == 1) {
        ++out_.border_edges;
        border.unite(side_[i].a, side_[i].b);
        border_vertex.push_back(side_[i].a);
      }
      if (n > 2) crowded.push_back(side_[i].triangle);
      if (n == 2 && side_[i].forward == side_[i + 1].forward) turned.push_back(side_[i].triangle);
      if ((out_.edges & 0xffff) == 0) work_.check();
      i = end;
    }
    if (out_.edges > 0) out_.edge_mean = length / static_cast<Real>(out_.edges);
    for (Index& v : border_vertex) v = border.find(v);
    std::sort(border_vertex.begin(), border_vertex.end());
    out_.border_loops =
        static_cast<std::uint64_t>(std::unique(border_vertex.begin(), border_vertex.end()) - border_vertex.begin());
    std::sort(crowded.begin(), crowded.end()), std::sort(turned.begin(), turned.end());
    out_.non_manifold_edges = named_triangles(crowded);
    out_.turned_edges = named_triangles(turned);
  }

  // Corners of triangles, united across the edges of two triangles: a vertex with more than one set has several fans.
  void look_at_fans() {
    UnionFind fan(soup_.corner.size());
    const auto corner_at = [&](Index t, Index v) {
      const std::array<Index, 3> c = corners_of(soup_, t);
      return 3 * t + static_cast<Index>(c[0] == v ? 0 : c[1] == v ? 1 : 2);
    };
    for (std::size_t i = 0; i + 1 < side_.size(); ++i)
      if (side_[i].a == side_[i + 1].a && side_[i].b == side_[i + 1].b)
        for (const Index v : {side_[i].a, side_[i].b})
          fan.unite(corner_at(side_[i].triangle, v), corner_at(side_[i + 1].triangle, v));
    std::vector<Index> root(soup_.vertex_count(), kNone);
    std::vector<Index> several;
    for (std::size_t c = 0; c < soup_.corner.size(); ++c) {
      const Index v = soup_.corner[c], r = fan.find(static_cast<Index>(c));
      if (repeats(corners_of(soup_, c / 3))) continue;
      if (root[v] == kNone)
        root[v] = r;
      else if (root[v] != r)
        several.push_back(v);
    }
    std::sort(several.begin(), several.end());
    several.erase(std::unique(several.begin(), several.end()), several.end());
    out_.several_fans = fault_of(several, several.size());
  }

  void count_components() {
    UnionFind part(soup_.vertex_count());
    for (std::size_t t = 0; t < triangles_; ++t) {
      const std::array<Index, 3> c = corners_of(soup_, t);
      part.unite(c[0], c[1]), part.unite(c[1], c[2]);
    }
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v] && part.find(static_cast<Index>(v)) == v) ++out_.components;
  }

  const Work& work_;
  const Soup& soup_;
  std::size_t triangles_;
  std::vector<std::uint8_t> used_;
  std::vector<Side> side_;
  SoupDiagnosis out_;
};

}  // namespace

SoupDiagnosis diagnose_soup(const Work& work, const Soup& soup) { return Diagnosis(work, soup).run(); }

}  // namespace intarsia::kernels
