#include "kernels/surface/weld_borders.h"

#include <array>
#include <cmath>
#include <compare>

#include "engine/parallel/for_each.h"
#include "engine/parallel/sort.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {
namespace {

struct Celled {
  std::array<std::int64_t, 3> cell;
  Index item;
  auto operator<=>(const Celled&) const = default;
};

}  // namespace

// Cubes of twice the distance, in eight grids moved by half a cube: what is near along every axis shares a cube in one.
std::vector<Index> weld_borders(const Work& work, const Soup& soup, std::span<const Index> border, const Vec3& low,
                                Real distance) {
  UnionFind joined(border.size());
  std::vector<Celled> celled(border.size());
  bool any = false;
  for (int grid = 0; grid < 8; ++grid) {
    for_each(work, Cost::light, border.size(), [&](std::size_t i) {
      const Index v = border[i];
      const Real at[] = {soup.x[v] - low.x(), soup.y[v] - low.y(), soup.z[v] - low.z()};
      celled[i].item = static_cast<Index>(i);
      for (int k = 0; k < 3; ++k)
        celled[i].cell[k] = static_cast<std::int64_t>(std::floor(at[k] / (2 * distance) + ((grid >> k) & 1) * 0.5));
    });
    sort_total(work, celled.begin(), celled.end());
    for (std::size_t i = 1; i < celled.size(); ++i)
      if (celled[i].cell == celled[i - 1].cell) joined.unite(celled[i].item, celled[i - 1].item), any = true;
  }
  if (!any) return {};
  std::vector<Index> becomes(soup.vertex_count());
  for_each(work, Cost::light, becomes.size(), [&](std::size_t v) { becomes[v] = static_cast<Index>(v); });
  // `border` ascends, so the smallest of a set is the smallest vertex
  for (std::size_t i = 0; i < border.size(); ++i) becomes[border[i]] = border[joined.find(static_cast<Index>(i))];
  return becomes;
}

}  // namespace intarsia::kernels
