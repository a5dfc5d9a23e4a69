#include "kernels/surface/canonical_order.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <tuple>

#include "engine/parallel/compact.h"
#include "engine/parallel/scan.h"
#include "kernels/surface/duplicate_rank.h"
#include "kernels/surface/kd_order.h"

namespace intarsia::kernels {
namespace {

std::vector<Index> used_vertices(const Work& work, const Soup& soup) {
  std::vector<std::uint8_t> used(soup.vertex_count(), 0);
  for_each(work, Cost::light, soup.corner.size(), [&](std::size_t c) {
    std::atomic_ref<std::uint8_t>(used[soup.corner[c]]).store(1, std::memory_order_relaxed);
  });
  return compact(work, used.size(), [&](std::size_t v) { return used[v] != 0; });
}

// mesh vertex -> place in `used`
std::vector<Index> order_vertices(const Work& work, const Soup& soup, const Vec3Array& point,
                                  std::span<const Index> used) {
  std::vector<Index> order(used.size());
  if (kd_order(work, point, {}, order)) return order;
  const std::vector<Index> place = inverse_order(work, used, soup.vertex_count());
  std::vector<Index> corner(soup.corner.size());
  for_each(work, Cost::light, corner.size(), [&](std::size_t c) { corner[c] = place[soup.corner[c]]; });
  kd_order(work, point, duplicate_rank(work, point, corner), order);
  return order;
}

struct OrderedFace {
  Index second, third, source;
  bool operator<(const OrderedFace& o) const {
    return std::tie(second, third, source) < std::tie(o.second, o.third, o.source);
  }
};

// Fills mesh.corner and returns mesh face -> soup triangle: faces grouped by their smallest vertex, then sorted.
std::vector<Index> order_faces(const Work& work, const Soup& soup, const std::vector<Index>& number, Index vertices,
                               Mesh& mesh) {
  const std::size_t faces = soup.face_count();
  const auto rotated = [&](std::size_t f) {
    std::array<Index, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = number[soup.corner[3 * f + i]];
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
  };
  std::vector<Index> offset(std::size_t{vertices} + 1, 0);
  for_each(work, Cost::light, faces, [&](std::size_t f) {
    std::atomic_ref<Index>(offset[rotated(f)[0]]).fetch_add(1, std::memory_order_relaxed);
  });
  exclusive_scan<Index>(work, offset);
  std::vector<Index> cursor(offset);
  std::vector<OrderedFace> ordered(faces);
  for_each(work, Cost::light, faces, [&](std::size_t f) {
    const auto v = rotated(f);
    ordered[std::atomic_ref<Index>(cursor[v[0]]).fetch_add(1, std::memory_order_relaxed)] = {v[1], v[2],
                                                                                             static_cast<Index>(f)};
  });
  std::vector<Index> source(faces);
  mesh.corner.resize(3 * faces);
  for_each(work, Cost::light, vertices, [&](std::size_t v) {
    std::sort(ordered.begin() + offset[v], ordered.begin() + offset[v + 1]);
    for (std::size_t f = offset[v]; f < offset[v + 1]; ++f) {
      mesh.corner[3 * f] = static_cast<Index>(v);
      mesh.corner[3 * f + 1] = ordered[f].second, mesh.corner[3 * f + 2] = ordered[f].third;
      source[f] = ordered[f].source;
    }
  });
  return source;
}

}  // namespace

std::vector<Index> inverse_order(const Work& work, std::span<const Index> order, Index old_count) {
  std::vector<Index> inverse(old_count, kNone);
  for_each(work, Cost::light, order.size(), [&](std::size_t i) { inverse[order[i]] = static_cast<Index>(i); });
  return inverse;
}

SurfaceOrder canonical_order(const Work& work, const Soup& soup, const BoxTransform& transform, Mesh& mesh) {
  SurfaceOrder out;
  const std::vector<Index> used = used_vertices(work, soup);
  const std::size_t n = used.size();
  {
    Vec3Array point(n);
    for_each(work, Cost::light, n, [&](std::size_t i) {
      const Index v = used[i];
      point.set(i, transform.to_unit({soup.x[v], soup.y[v], soup.z[v]}));
    });
    const std::vector<Index> order = order_vertices(work, soup, point, used);
    out.vertex.resize(n);
    mesh.x.resize(n), mesh.y.resize(n), mesh.z.resize(n);
    for_each(work, Cost::light, n, [&](std::size_t i) {
      out.vertex[i] = used[order[i]];
      mesh.x[i] = point.x[order[i]], mesh.y[i] = point.y[order[i]], mesh.z[i] = point.z[order[i]];
    });
  }
  const std::vector<Index> number = inverse_order(work, out.vertex, soup.vertex_count());
  out.face = order_faces(work, soup, number, static_cast<Index>(n), mesh);
  return out;
}

}  // namespace intarsia::kernels
