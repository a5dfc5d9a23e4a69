#include "kernels/patches/seed_by_error.h"

#include <algorithm>
#include <memory>

#include "engine/parallel/for_each.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/patches/region_fit.h"

namespace intarsia::kernels {
namespace {

// From so many regions on, the fit changes only the one that is divided (RegionFit::add_seed), while writing it goes
// over the whole patch: then the regions become patches of their own.
constexpr Index kOwnPatches = 64;

constexpr Real kLeastShare = 0.03;  // of a region's area; what is less repairs nothing

// One patch under division.
struct Source {
  std::vector<Index> faces;  // ascending
  std::unique_ptr<RegionGraph> graph;
  std::unique_ptr<RegionFit> fit;
  std::vector<Real> error{0};          // per region
  std::vector<std::uint8_t> stale{0};  // per region: its faces, or what lies around them, changed since it was measured
  std::vector<std::uint8_t> whole{0};  // per region: cannot be divided, as things are
};

class Seeding {
 public:
  Seeding(const Work& work, const PatchSurface& s, const PatchLabels& labels, const ErrorSeedOptions& options)
      : work_(work),
        s_(s),
        options_(options),
        fit_(options.split.fit),
        regions_(labels),
        normal_(smooth_normals(work, s, labels.patch_of_face, options.split.smoothing)),
        source_(labels.count),
        count_(labels.count) {
    fit_.least_share = kLeastShare;
    const Csr faces = faces_of_patches(labels);
    for (Index p = 0; p < labels.count; ++p) source_[p].faces.assign(faces.row(p).begin(), faces.row(p).end());
    auto pool = make_scratch_pool([] { return RegionErrorScratch(); });
    for_each_block(work, Cost::single, labels.count, [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t p = begin; p < end; ++p) {
        const Index id = static_cast<Index>(p);
        if (s_.is_locked(source_[p].faces[0])) {
          source_[p].whole[0] = 1;
          continue;
        }
        source_[p].error[0] = region_error(s_, {id, 0, source_[p].faces}, regions_, options_.error, *scratch);
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
        if (!source_[p].whole[r] && source_[p].error[r] > most) most = source_[p].error[r], worst = p, region = r;
    if (worst == kNone) return false;
    if (source_[worst].error.size() >= kOwnPatches) worst = part(worst, region), region = 0;
    if (!divide(worst, region)) source_[worst].whole[region] = 1;
    return true;
  }

  PatchLabels labels() const {
    std::vector<Index> counts;
    for (const Source& p : source_) counts.push_back(static_cast<Index>(p.error.size()));
    return collect_regions(work_, regions_, counts);
  }

 private:
  // Makes every region of a patch a patch; the first keeps its number. Returns that of region r.
  Index part(Index p, Index r) {
    const Source old = std::move(source_[p]);
    const Index count = static_cast<Index>(old.error.size()), first = static_cast<Index>(source_.size());
    const auto patch_of = [&](Index region) { return region == 0 ? p : first + region - 1; };
    source_[p] = Source();
    source_.resize(source_.size() + count - 1);
    for (const Index f : old.faces) {
      const Index q = patch_of(regions_.label[f]);
      source_[q].faces.push_back(f);
      regions_.source[f] = q, regions_.label[f] = 0;
    }
    for (Index i = 0; i < count; ++i) {
      Source& own = source_[patch_of(i)];
      own.error[0] = old.error[i], own.stale[0] = old.stale[i], own.whole[0] = old.whole[i];
    }
    return patch_of(r);
  }

  bool divide(Index p, Index region) {
    Source& source = source_[p];
    const Region whole{p, 0, source.faces};
    if (whole.faces.size() < 2) return false;
    if (!source.fit) {
      source.graph = std::make_unique<RegionGraph>(
          make_region_graph(work_, s_, whole, node_size_for(whole.faces.size()), normal_, regions_));
      if (source.graph->nodes() < 2) return false;
      source.fit =
          std::make_unique<RegionFit>(work_, *source.graph, farthest_normals(*source.graph, 2), options_.split.fit);
    } else if (source.fit->add_seed(work_, region, fit_).empty()) {
      return false;
    }
    before_.clear();
    for (const Index f : whole.faces) before_.push_back(regions_.label[f]);
    source.fit->write(work_, s_, normal_, whole, options_.split.fit.grow, options_.split.relax, regions_);
    const Index count = source.fit->regions();
    count_ += count - static_cast<Index>(source.error.size());
    source.error.resize(count), source.stale.resize(count, 1), source.whole.assign(count, 0);
    mark_changed(whole);
    measure(p, source);
    return true;
  }

  // Regions that lost or gained a face, and those beside such a face: the corners of their borders are where the region
  // across changes.
  void mark_changed(const Region& whole) {
    for (std::size_t i = 0; i < whole.faces.size(); ++i) {
      const Index f = whole.faces[i];
      if (regions_.label[f] == before_[i]) continue;
      std::vector<std::uint8_t>& stale = source_[whole.source].stale;
      stale[before_[i]] = stale[regions_.label[f]] = 1;
      for (int k = 0; k < 3; ++k)
        if (const Index g = s_.neighbour(f, k); g != kNone) source_[regions_.source[g]].stale[regions_.label[g]] = 1;
    }
  }

  // Only what is stale: all of them each time would make the whole quadratic.
  void measure(Index p, Source& source) {
    std::vector<std::vector<Index>> faces(source.fit->regions());
    for (const Index f : source.faces)
      if (source.stale[regions_.label[f]]) faces[regions_.label[f]].push_back(f);
    auto pool = make_scratch_pool([] { return RegionErrorScratch(); });
    for_each_block(work_, Cost::single, faces.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      auto scratch = pool.borrow();
      for (std::size_t r = begin; r < end; ++r)
        if (source.stale[r])
          source.error[r] = region_error(s_, {p, static_cast<Index>(r), faces[r]}, regions_, options_.error, *scratch);
    });
    source.stale.assign(faces.size(), 0);
  }

  const Work& work_;
  const PatchSurface& s_;
  const ErrorSeedOptions& options_;
  ProxyOptions fit_;  // of regions that are divided
  Regions regions_;
  SmoothNormals normal_;
  std::vector<Source> source_;
  std::vector<Index> before_;  // scratch: labels of a source's faces before it was divided
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
