#include "kernels/surface/canonical_order.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <tuple>

#include "engine/parallel/build_csr.h"
#include "engine/parallel/compact.h"
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

std::array<Index, 3> rotated(const Soup& soup, const std::vector<Index>& number, Index f) {
  std::array<Index, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = number[soup.corner[3 * std::size_t{f} + i]];
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

// mesh face -> soup triangle, sorted by the rotated corners
std::vector<Index> order_faces(const Work& work, const Soup& soup, const std::vector<Index>& number, Index vertices) {
  Csr by_first = build_csr(
      work, vertices, soup.face_count(), [&](std::size_t f) { return rotated(soup, number, static_cast<Index>(f))[0]; },
      [](std::size_t f) { return static_cast<Index>(f); });
  for_each(work, Cost::light, vertices, [&](std::size_t v) {
    std::sort(by_first.item.begin() + by_first.offset[v], by_first.item.begin() + by_first.offset[v + 1],
              [&](Index a, Index b) {
                const auto p = rotated(soup, number, a), q = rotated(soup, number, b);
                return std::tie(p[1], p[2], a) < std::tie(q[1], q[2], b);
              });
  });
  return std::move(by_first.item);
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
  out.face = order_faces(work, soup, number, static_cast<Index>(n));
  mesh.corner.resize(soup.corner.size());
  for_each(work, Cost::light, out.face.size(), [&](std::size_t f) {
    const auto v = rotated(soup, number, out.face[f]);
    std::copy(v.begin(), v.end(), mesh.corner.begin() + static_cast<std::ptrdiff_t>(3 * f));
  });
  return out;
}

}  // namespace intarsia::kernels
