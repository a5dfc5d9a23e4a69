#include "kernels/scale/compute_scale.h"

#include <algorithm>
#include <cmath>

#include "engine/data/disc_walk.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/scratch_pool.h"
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
  auto pool = make_scratch_pool([&] { return GroupVoting(mesh, faces, o.fold_guard); });
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

// Disc code of one cluster, or 0 where no disc sees a bend.
std::uint8_t choose_disc_of(const LevelBuild& build, Index c, const ScaleOptions& o, DiscWalker& walker) {
  const Real six_rings = kSixRings * build.levels.level[0].spacing[c];
  int first = kFirstDisc;
  while (first < kLastDisc && disc_radius(first) < six_rings) ++first;
  std::array<Real, kDiscs> variation;
  std::size_t n = 0;
  for (int code = first; code <= kLastDisc; ++code) {
    if (disc_radius(code) > o.largest_disc * 1.000001) break;
    variation[n++] = disc_variation(build, c, code, walker);
    if (variation[n - 1] >= o.select.bent) break;
  }
  return static_cast<std::uint8_t>(choose_disc(std::span(variation).first(n), first, o.select));
}

// What a vertex is fitted in where nothing bends up to the largest disc.
std::uint8_t flat_fit(Real spacing, const ScaleOptions& o) {
  constexpr Real kRingWidth = 0.87;  // of a spacing
  constexpr long kMostRings = 4;
  const long rings = std::lround(std::min(o.flat_reach / (kRingWidth * spacing), Real(1000)));
  if (rings <= kMostRings) return static_cast<std::uint8_t>(std::max<long>(rings, o.select.least_fit));
  int code = kFirstDisc;
  while (code < kLastDisc && disc_radius(code) < o.flat_reach) ++code;
  return static_cast<std::uint8_t>(code);
}

// Discs for flat vertices; vertices that six rings call bent keep their rings.
void choose_discs(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces, const ScaleOptions& o,
                  const Codes& flat, ScaleFields& out) {
  LevelBuild build = build_sample_levels(work, mesh, faces, o.largest_disc);
  if (build.levels.level.empty()) return;
  const SampleLevel& base = build.levels.level[0];
  Codes code(mesh.vertex_count(), 0), smooth(mesh.vertex_count());
  auto pool = make_scratch_pool([&] { return DiscWalker(build.levels); });
  for_each_block(work, Cost::medium, base.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto walker = pool.borrow();
    for (std::size_t i = begin; i < end; ++i) {
      const Index c = static_cast<Index>(i);
      const auto members = base.member.row(c);
      if (std::none_of(members.begin(), members.end(), [&](Index v) { return flat[v]; })) continue;
      const std::uint8_t chosen = choose_disc_of(build, c, o, *walker);
      for (Index v : members)
        if (flat[v]) code[v] = chosen;
    }
  });
  median_over_neighbours(work, mesh.vertex_vertices, code, smooth);
  for_each(work, Cost::light, smooth.size(), [&](std::size_t v) {
    if (!flat[v]) return;
    out.fit_ring[v] = smooth[v] ? smooth[v] : std::max(out.fit_ring[v], flat_fit(base.spacing[base.parent[v]], o));
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
