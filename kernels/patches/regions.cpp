#include "kernels/patches/regions.h"

#include <algorithm>
#include <numeric>

#include "engine/parallel/scan.h"
#include "kernels/patches/flood_patches.h"

namespace intarsia::kernels {

PatchLabels collect_regions(const Work& work, const Regions& regions, std::span<const Index> regions_of) {
  std::vector<Index> offset(regions_of.begin(), regions_of.end());
  const Index total = exclusive_scan<Index>(work, offset);
  std::vector<Index> id(regions.label.size());
  for_each(work, Cost::light, id.size(), [&](std::size_t f) { id[f] = offset[regions.source[f]] + regions.label[f]; });
  return compact_labels(work, id, total);
}

std::vector<Index> largest_first(const Csr& faces) {
  std::vector<Index> order(faces.rows());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return faces.row(a).size() > faces.row(b).size(); });
  return order;
}

}  // namespace intarsia::kernels
