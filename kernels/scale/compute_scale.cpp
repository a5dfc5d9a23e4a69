#include "kernels/scale/compute_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/scratch_pool.h"
#include "kernels/scale/disc_voting.h"
#include "kernels/scale/group_voting.h"
#include "kernels/scale/sample_levels.h"
#include "kernels/scale/voting_tensor.h"

namespace intarsia::kernels {

namespace {

using Codes = std::vector<std::uint8_t>;

constexpr Real kSixRings = 5.0;  // radius of six rings in spacings, a little short: the first disc overlaps them

// Where neighbourhoods are too odd to be walked together, one vertex at a time.
struct Alone {
  explicit Alone(const MeshView& mesh) : walker(mesh) {}
  RingWalker walker;
  VotingScratch voting;
};

// Variation, rule and ring to fit, without looking at neighbours. flat[v] = 1 where the six rings see a plane and
// nothing beside it: a vertex near a crease may be flat by the rule although its outer rings reach over the crease.
void choose_rings(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces, const ScaleOptions& o,
                  ScaleFields& out, Codes& fit, Codes& flat) {
  constexpr std::size_t kGroup = GroupWalker::kGroup;
  static_assert(static_cast<std::size_t>(Cost::medium) % kGroup == 0, "blocks must not cut groups");
  // A vertex is flat if not even half of its rings reach omega_-: the inner ones need to be looked at closest. Its
  // values beyond that are asked for only if they are kept.
  FlatTeams flat_teams;
  std::vector<NormalCone> cones;
  if (!o.keep_variation) {
    cones = normal_cones(work, mesh, faces);
    flat_teams = {cones, safe_chord(o.select.flat), safe_chord(o.select.bent), kRings / 2 + 1, kRings};
  }
  auto pool = make_scratch_pool([&] {
    GroupVoting voting(mesh, faces, o.fold_guard);
    voting.skip(flat_teams);
    return voting;
  });
  auto single = make_scratch_pool([&] { return Alone(mesh); });
  SelectOptions closest = o.select;
  closest.flat = 0;  // every ring counts as reached: the bent case
  for_each_block(work, Cost::medium, mesh.vertex_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto voting = pool.borrow();
    std::array<Variation, kGroup> variations;
    for (std::size_t first = begin; first < end; first += kGroup) {
      const std::span<Variation> group(variations.data(), std::min(kGroup, end - first));
      if (!voting->run(static_cast<Index>(first), group)) {
        const auto alone = single.borrow();
        for (std::size_t b = 0; b < group.size(); ++b)
          group[b] = variation_of(mesh, static_cast<Index>(first + b), o.fold_guard, alone->walker, alone->voting);
      }
      for (std::size_t b = 0; b < group.size(); ++b) {
        const std::size_t v = first + b;
        const Variation& variation = group[b];
        const RingValues& read = o.fold_guard ? variation.folded : variation.omega;
        const Choice choice = choose_ring(read, o.select);
        const int ring =
            choice.bend == Bend::between && o.closest_between ? choose_ring(read, closest).ring : choice.ring;
        out.scale[v] = static_cast<std::uint8_t>(choice.ring);
        fit[v] = static_cast<std::uint8_t>(std::max(ring, o.select.least_fit));
        flat[v] = choice.bend == Bend::flat && read[kRings - 1] < o.select.bent;
        if (o.keep_variation)
          for (std::size_t k = 0; k < kRings; ++k) out.omega[k][v] = variation.omega[k];
      }
    }
  });
}

// Disc codes of the clusters of level 0 below one coarse cluster, smaller discs first; a cluster is done with the first
// that bends.
class DiscChoice {
 public:
  DiscChoice(const LevelBuild& build, const ScaleOptions& options) : build_(build), o_(options), voting_(build) {
    while (last_ < kLastDisc && disc_radius(last_ + 1) <= o_.largest_disc * 1.000001) ++last_;
  }
  // The level of the coarse clusters; theirs hold about 256 vertices.
  static std::size_t start_level(const SampleLevels& levels) {
    return std::min<std::size_t>(levels.level.size() - 1, 3);
  }

  // take(vertex, code) for every flat vertex below cluster c of the start level; code 0 where no disc sees a bend.
  template <class Take>
  void run(Index c, const Codes& flat, const Take& take) {
    // What flat discs are is not asked for, unless the choice could depend on it.
    voting_.skip_below(o_.select.flat);
    measure(c, flat);
    if (!std::all_of(seeker_.begin(), seeker_.end(), [&](const Seeker& s) { return decided(s); })) {
      voting_.skip_below(0);
      measure(c, flat);
    }
    for (const Seeker& s : seeker_) {
      const int code = choose_disc(std::span(s.variation).first(s.size), s.first, o_.select);
      for (Index v : build_.levels.level[0].member.row(s.cluster))
        if (flat[v]) take(v, static_cast<std::uint8_t>(code));
    }
  }

 private:
  struct Seeker {
    Index cluster;
    int first;  // smallest disc to look at
    bool done = false;
    std::size_t size = 0;
    std::array<Real, kDiscs> variation{};
  };

  struct Open {
    Seeker* seeker;
    std::size_t disc;
  };

  // The variation of the discs, one code after the other.
  void measure(Index c, const Codes& flat) {
    seeker_.clear();
    collect(start_level(build_.levels), c, flat);
    for (int code = kFirstDisc; code <= last_; ++code) {
      place_discs(code);
      variation_.resize(cluster_.size());
      voting_.run(cluster_, centre_, code, variation_);
      for (const Open& o : open_) {
        o.seeker->variation[o.seeker->size++] = variation_[o.disc];
        o.seeker->done = variation_[o.disc] >= o_.select.bent;
      }
    }
  }

  // Whether choose_disc() comes to the same whatever the skipped discs are, between 0 and omega_-: all are flat, or one
  // that was measured is closer to omega_+ than they can be, by more than the slack.
  bool decided(const Seeker& s) const {
    bool skipped = false;
    Real most = 0, nearest = std::numeric_limits<Real>::infinity();
    for (const Real w : std::span(s.variation).first(s.size)) {
      if (w == 0)
        skipped = true;
      else
        most = std::max(most, w), nearest = std::min(nearest, std::abs(w - o_.select.bent));
    }
    return !skipped || most < o_.select.flat || nearest + o_.select.slack < o_.select.bent - o_.select.flat;
  }

  // One disc for all seekers below a cluster of the level finer than its samples: they are at most a twelfth of the
  // radius from its centre. At the level of the samples themselves half of the time is saved on dense scans, but crests
  // break into more pieces where the scale changes from cluster to cluster.
  void place_discs(int code) {
    open_.clear(), cluster_.clear(), centre_.clear();
    std::size_t last_level = 0;
    Index last = kNone;
    for (Seeker& s : seeker_) {
      if (s.first > code || s.done) continue;
      const SampleLevels& levels = build_.levels;
      const std::size_t samples =
          levels.level_for(radius_[static_cast<std::size_t>(code - kFirstDisc)], levels.level[0].spacing[s.cluster]);
      const std::size_t level = std::min(samples > 0 ? samples - 1 : 0, start_level(levels));
      Index around = s.cluster;
      for (std::size_t l = 1; l <= level; ++l) around = levels.level[l].parent[around];
      if (level != last_level || around != last) {
        cluster_.push_back(s.cluster);
        centre_.push_back(levels.level[level].centre[around]);
        last_level = level, last = around;
      }
      open_.push_back({&s, cluster_.size() - 1});
    }
  }

  void collect(std::size_t level, Index c, const Codes& flat) {
    const SampleLevel& l = build_.levels.level[level];
    const auto row = l.member.row(c);
    if (level > 0) {
      for (Index i : row) collect(level - 1, i, flat);
    } else if (std::any_of(row.begin(), row.end(), [&](Index v) { return flat[v]; })) {
      int first = kFirstDisc;
      while (first < kLastDisc && radius_[static_cast<std::size_t>(first - kFirstDisc)] < kSixRings * l.spacing[c])
        ++first;
      seeker_.push_back({c, first});
    }
  }

  const LevelBuild& build_;
  const ScaleOptions& o_;
  DiscVoting voting_;
  int last_ = kFirstDisc - 1;
  const std::array<Real, kDiscs> radius_ = [] {
    std::array<Real, kDiscs> r{};
    for (int d = 0; d < kDiscs; ++d) r[static_cast<std::size_t>(d)] = disc_radius(kFirstDisc + d);
    return r;
  }();
  std::vector<Seeker> seeker_;
  std::vector<Open> open_;      // those that are not done
  std::vector<Index> cluster_;  // of level 0, one for each disc
  std::vector<Vec3> centre_;    // of the discs
  std::vector<Real> variation_;
};

// What a vertex is fitted in where nothing bends up to the largest disc.
class FlatFit {
 public:
  explicit FlatFit(const ScaleOptions& o) : reach_(o.flat_reach), least_(o.select.least_fit), disc_(kFirstDisc) {
    while (disc_ < kLastDisc && disc_radius(disc_) < o.flat_reach) ++disc_;
  }
  std::uint8_t operator()(Real spacing) const {
    constexpr Real kRingWidth = 0.87;  // of a spacing
    constexpr long kMostRings = 4;
    const long rings = std::lround(std::min(reach_ / (kRingWidth * spacing), Real(1000)));
    return static_cast<std::uint8_t>(rings <= kMostRings ? std::max<long>(rings, least_) : disc_);
  }

 private:
  Real reach_;
  int least_, disc_;
};

// Discs for flat vertices; vertices that six rings call bent keep their rings.
void choose_discs(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces, const ScaleOptions& o,
                  const Codes& flat, ScaleFields& out) {
  LevelBuild build = build_sample_levels(work, mesh, faces, o.largest_disc);
  if (build.levels.level.empty()) return;
  const SampleLevel& base = build.levels.level[0];
  Codes code(mesh.vertex_count(), 0), smooth(mesh.vertex_count());
  auto pool = make_scratch_pool([&] { return DiscChoice(build, o); });
  const Index starts = build.levels.level[DiscChoice::start_level(build.levels)].size();
  for_each_block(work, Cost::heavy, starts, [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto choice = pool.borrow();
    for (std::size_t c = begin; c < end; ++c)
      choice->run(static_cast<Index>(c), flat, [&](Index v, std::uint8_t disc) { code[v] = disc; });
  });
  median_over_neighbours(work, mesh.vertex_vertices, code, smooth);
  const FlatFit flat_fit(o);
  for_each(work, Cost::light, smooth.size(), [&](std::size_t v) {
    if (!flat[v]) return;
    out.fit_ring[v] = smooth[v] ? smooth[v] : std::max(out.fit_ring[v], flat_fit(base.spacing[base.parent[v]]));
  });
  out.levels = std::move(build.levels);
}

}  // namespace

ScaleFields compute_scale(const Work& work, const MeshView& mesh, const ScaleOptions& options) {
  const std::size_t n = mesh.vertex_count();
  ScaleFields out;
  out.scale.resize(n);
  out.fit_ring.resize(n);
  if (options.keep_variation)
    for (auto& o : out.omega) o.resize(n);
  const std::vector<VotingFace> faces = voting_faces(work, mesh);
  Codes fit(n), flat(n);
  choose_rings(work, mesh, faces, options, out, fit, flat);
  if (options.select.regularise)
    median_over_neighbours(work, mesh.vertex_vertices, fit, out.fit_ring);
  else
    out.fit_ring = std::move(fit);
  if (options.discs && std::find(flat.begin(), flat.end(), 1) != flat.end())
    choose_discs(work, mesh, faces, options, flat, out);
  return out;
}

}  // namespace intarsia::kernels
