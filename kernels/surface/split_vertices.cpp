#include "kernels/surface/split_vertices.h"

#include "engine/parallel/for_each.h"
#include "engine/parallel/union_find.h"

namespace intarsia::kernels {

std::vector<Index> split_vertices(const Work& work, Index vertices, std::span<const Index> partner,
                                  std::vector<Index>& corner) {
  const auto next = [](Index s) { return s % 3 == 2 ? s - 2 : s + 1; };
  UnionFind fan(corner.size());
  for_each(work, Cost::light, corner.size(), [&](std::size_t i) {
    const Index s = static_cast<Index>(i), p = partner[s];
    if (p == kNone || p < s) return;
    const bool same_way = corner[s] == corner[p];
    fan.unite(s, same_way ? p : next(p));
    fan.unite(next(s), same_way ? next(p) : p);
  });
  std::vector<Index> keeper(vertices, kNone);  // vertex -> root of the fan that keeps it
  std::vector<Index> copy_of, copy(corner.size(), kNone);
  for (Index c = 0; c < corner.size(); ++c) {
    const Index v = corner[c], root = fan.find(c);
    if (keeper[v] == kNone) keeper[v] = root;
    if (keeper[v] != root) {
      if (copy[root] == kNone) {
        copy[root] = vertices + static_cast<Index>(copy_of.size());
        copy_of.push_back(v);
      }
      corner[c] = copy[root];
    }
    if ((c & 0xffff) == 0) work.check();
  }
  return copy_of;
}

}  // namespace intarsia::kernels
