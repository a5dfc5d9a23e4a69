#include "kernels/layout/patch_of_faces.h"

#include <algorithm>
#include <utility>

#include "engine/parallel/for_each.h"
#include "kernels/layout/parent_weights.h"

namespace intarsia::kernels {

std::vector<Index> patch_of_original_faces(const Work& work, MeshView original, const RefinedMesh& refined,
                                           std::span<const Index> label) {
  const Csr children = children_of_parents(work, original.face_count(), refined);
  std::vector<Index> patch(original.face_count(), kNone);
  for_each_block(work, Cost::light, original.face_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<std::pair<Index, Real>> area;  // (patch, share of the parent)
    for (std::size_t f = begin; f < end; ++f) {
      const auto row = children.row(static_cast<Index>(f));
      if (row.empty()) continue;
      patch[f] = label[row[0]];
      if (std::all_of(row.begin(), row.end(), [&](Index c) { return label[c] == patch[f]; })) continue;
      area.clear();
      for (Index c : row) area.emplace_back(label[c], share_of_parent(original, refined, c).value_or(0));
      std::sort(area.begin(), area.end());
      Real best = -1;
      for (std::size_t i = 0; i < area.size();) {
        const Index l = area[i].first;
        Real total = 0;
        for (; i < area.size() && area[i].first == l; ++i) total += area[i].second;
        if (total > best + 1e-12) best = total, patch[f] = l;
      }
    }
  });
  return patch;
}

}  // namespace intarsia::kernels
