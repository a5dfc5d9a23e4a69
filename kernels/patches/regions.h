// Labels in the making. Every source (a patch that is being divided) counts its regions from 0, so that sources can be
// worked on side by side: `source` is constant meanwhile, and `label` of a face is read only by work on its source.
#pragma once

#include <span>
#include <vector>

#include "engine/data/patch_labels.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct Regions {
  std::vector<Index> source;    // per face
  std::vector<Index> label;     // per face, within its source
  std::vector<Index> position;  // per face: scratch, rank in the face list of the region at hand

  explicit Regions(const PatchLabels& labels)
      : source(labels.patch_of_face), label(source.size(), 0), position(source.size(), kNone) {}
  bool is_in(Index f, Index s, Index l) const { return source[f] == s && label[f] == l; }
};

// One connected set of faces under work.
struct Region {
  Index source = 0, label = 0;
  std::span<const Index> faces;  // ascending
};

// Every (source, label) becomes a patch. regions_of[s] = number of labels used in source s.
PatchLabels collect_regions(const Work& work, const Regions& regions, std::span<const Index> regions_of);

// Sources by falling number of faces (ties: smaller id): the order in which to start parallel work.
std::vector<Index> largest_first(const Csr& faces);

}  // namespace intarsia::kernels
