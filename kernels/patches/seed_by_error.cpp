#include "kernels/patches/seed_by_error.h"

#include <algorithm>
#include <memory>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/patches/region_fit.h"

namespace intarsia::kernels {
namespace {

// One patch under division.
struct Source {
  std::unique_ptr<RegionGraph> graph;
  std::unique_ptr<RegionFit> fit;
  std::vector<Real> error{0};  // per region; negative: cannot be divided
};

class Seeding {
 public:
  Seeding(const Work& work, const PatchSurface& s, const PatchLabels& labels, const ErrorSeedOptions& options)
      : work_(work),
        s_(s),
        options_(options),
        regions_(labels),
        normal_(smooth_normals(work, s, labels.patch_of_face, options.split.smoothing)),
        faces_(faces_of_patches(labels)),
        source_(labels.count),
        count_(labels.count) {
    auto pool = make_scratch_pool([] { return RegionErrorScratch(); });
    for_each_block(work, Cost::single, labels.count, [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t p = begin; p < end; ++p) {
        const Index id = static_cast<Index>(p);
        if (s_.is_locked(faces_.row(id)[0])) {
          source_[p].error[0] = -1;
          continue;
        }
        source_[p].error[0] = region_error(s_, {id, 0, faces_.row(id)}, regions_, options_.error, *scratch);
      }
    });
  }

  Index count() const { return count_; }

  // False if nothing can be divided any more.
  bool add_seed() {
    Index worst = kNone, region = 0;
    Real most = -1;
    for (Index p = 0; p < source_.size(); ++p)
      for (Index r = 0; r < source_[p].error.size(); ++r)
        if (source_[p].error[r] > most) most = source_[p].error[r], worst = p, region = r;
    if (worst == kNone) return false;
    if (!divide(worst, region)) source_[worst].error[region] = -1;
    return true;
  }

  PatchLabels labels() const {
    std::vector<Index> counts;
    for (const Source& p : source_) counts.push_back(static_cast<Index>(p.error.size()));
    return collect_regions(work_, regions_, counts);
  }

 private:
  bool divide(Index p, Index region) {
    Source& source = source_[p];
    const Region whole{p, 0, faces_.row(p)};
    if (whole.faces.size() < 2) return false;
    if (!source.fit) {
      source.graph = std::make_unique<RegionGraph>(
          make_region_graph(work_, s_, whole, node_size_for(whole.faces.size()), normal_, regions_));
      if (source.graph->nodes() < 2) return false;
      source.fit =
          std::make_unique<RegionFit>(work_, *source.graph, farthest_normals(*source.graph, 2), options_.split.fit);
    } else if (source.fit->add_seed(work_, region, options_.split.fit).empty()) {
      return false;
    }
    source.fit->write(work_, s_, normal_, whole, options_.split.fit.grow, options_.split.relax, regions_);
    count_ += source.fit->regions() - static_cast<Index>(source.error.size());
    measure(p, source);
    return true;
  }

  void measure(Index p, Source& source) {
    std::vector<std::vector<Index>> faces(source.fit->regions());
    for (const Index f : faces_.row(p)) faces[regions_.label[f]].push_back(f);
    source.error.assign(faces.size(), 0);
    auto pool = make_scratch_pool([] { return RegionErrorScratch(); });
    for_each_block(work_, Cost::single, faces.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t r = begin; r < end; ++r)
        source.error[r] = region_error(s_, {p, static_cast<Index>(r), faces[r]}, regions_, options_.error, *scratch);
    });
  }

  const Work& work_;
  const PatchSurface& s_;
  const ErrorSeedOptions& options_;
  Regions regions_;
  SmoothNormals normal_;
  Csr faces_;
  std::vector<Source> source_;
  Index count_;
};

}  // namespace

PatchLabels seed_by_error(const Work& work, const PatchSurface& s, const PatchLabels& labels, Index target,
                          const ErrorSeedOptions& options) {
  if (labels.count >= target) return labels;
  Seeding seeding(work, s, labels, options);
  while (seeding.count() < target) {
    work.check();
    if (!seeding.add_seed()) break;
  }
  return seeding.labels();
}

}  // namespace intarsia::kernels
