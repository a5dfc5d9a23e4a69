#include "kernels/patches/relax_borders.h"

#include <algorithm>
#include <array>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "kernels/patches/measure_patches.h"

namespace intarsia::kernels {
namespace {

struct Contact {
  int edges = 0, vertices = 0;
  bool is_arc() const { return edges > 0 && vertices - edges == 1; }
};

class Relaxation {
 public:
  Relaxation(const PatchSurface& s, Index source, Index first_label, Index also, const RelaxOptions& options,
             Regions& regions)
      : s_(s), source_(source), first_(first_label), also_(also), options_(options), regions_(regions) {}

  void fit(const Work& work, std::span<const Index> faces) {
    const Index most = reduce(
        work, Cost::light, faces.size(), Index{0},
        [&](std::size_t begin, std::size_t end) {
          Index m = 0;
          for (std::size_t i = begin; i < end; ++i) m = std::max(m, regions_.label[faces[i]]);
          return m;
        },
        [](Index a, Index b) { return std::max(a, b); });
    proxy_.assign(std::size_t{most} + 1, Vec3::Zero());
    constexpr Index kFew = 8;
    if (most < kFew && faces.size() > 4096) {  // each region's sum in the order of the faces, regions side by side
      for_each(work, Cost::single, proxy_.size(), [&](std::size_t l) {
        Vec3 sum = Vec3::Zero();
        for (const Index f : faces)
          if (regions_.label[f] == l) sum += s_.area[f] * s_.normal[f];
        proxy_[l] = sum;
      });
    } else {
      for (const Index f : faces) proxy_[regions_.label[f]] += s_.area[f] * s_.normal[f];
    }
    for (Vec3& p : proxy_)
      if (const Real length = p.norm(); length > 0) p /= length;
  }
  bool is_movable_label(Index l) const { return l >= first_ || l == also_; }
  Index label_of(Index g) const { return g != kNone && regions_.source[g] == source_ ? regions_.label[g] : kNone; }
  bool on_border(Index f) const {
    for (int i = 0; i < 3; ++i) {
      const Index l = label_of(s_.neighbour(f, i));
      if (l != kNone && l != regions_.label[f] && is_movable_label(l)) return true;
    }
    return false;
  }

  // What face f shares with the faces of one label, itself left out.
  Contact contact(Index f, Index label) const {
    Contact c;
    for (int i = 0; i < 3; ++i) {
      if (label_of(s_.neighbour(f, i)) == label) ++c.edges;
      for (const Index g : s_.mesh.vertex_faces.row(s_.mesh.corner[3 * f + i]))
        if (g != f && label_of(g) == label) {
          ++c.vertices;
          break;
        }
    }
    return c;
  }
  // May f leave its region? A leaf that touches the rest in one more vertex is a pinch: better without. A face that
  // joins two neighbours may leave only if these stay joined around the corner between them.
  bool may_leave(Index f, Index label, const Contact& c) const {
    if (is_pinch(c)) return true;
    return c.is_arc() && (c.edges == 1 || stays_joined(s_.mesh, f, [&](Index g) { return label_of(g) == label; }));
  }
  static bool is_pinch(const Contact& c) { return c.edges == 1 && c.vertices == 3; }

  // Moves f to the best neighbouring region; `any` accepts a move that costs.
  bool try_move(Index f, bool any) {
    if (s_.beside_hole[f]) return false;
    const Index from = regions_.label[f];
    std::array<Index, 3> label;
    std::array<Real, 3> length;
    for (int i = 0; i < 3; ++i) {
      label[i] = label_of(s_.neighbour(f, i));
      length[i] = s_.edge_length(s_.mesh.face_edge[3 * f + i]);
    }
    Index best = kNone;
    Real least = 0;
    for (int i = 0; i < 3; ++i) {
      const Index to = label[i];
      if (to == kNone || to == from || !is_movable_label(to)) continue;
      Real cost = 0;
      for (int j = 0; j < 3; ++j) cost += label[j] == from ? length[j] : label[j] == to ? -length[j] : 0;
      cost *= options_.length_weight * s_.mean_edge;
      if (options_.fit_normals) {
        const Vec3 n = s_.normal[f];
        cost += s_.area[f] * ((n - proxy_[to]).squaredNorm() - (n - proxy_[from]).squaredNorm());
      }
      if (best == kNone || cost < least || (cost == least && to < best)) best = to, least = cost;
    }
    if (best == kNone) return false;
    const Contact stays = contact(f, from);
    if (!may_leave(f, from, stays) || !contact(f, best).is_arc()) return false;
    const Real gain = 1e-9 * s_.mean_edge * s_.mean_edge;
    if (!any && !is_pinch(stays) && least > -gain) return false;
    regions_.label[f] = best;
    return true;
  }

  // Groups of faces of one label around v, joined across edges at v; the smallest comes first.
  std::vector<std::vector<Index>> sectors(Index label, Index v) const {
    std::vector<std::vector<Index>> groups;
    for (const Index g : s_.mesh.vertex_faces.row(v)) {
      if (label_of(g) != label) continue;
      std::vector<Index> joined{g};
      for (std::size_t k = 0; k < groups.size();) {
        const bool touches = std::any_of(groups[k].begin(), groups[k].end(), [&](Index o) {
          for (int i = 0; i < 3; ++i)
            if (s_.neighbour(g, i) == o && s_.mesh.corner[3 * g + i] != v) return true;
          return false;
        });
        if (touches) {
          joined.insert(joined.end(), groups[k].begin(), groups[k].end());
          groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
          ++k;
        }
      }
      std::sort(joined.begin(), joined.end());
      groups.push_back(joined);
    }
    std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return groups;
  }

  // Where a region touches itself at a vertex, give one of its sectors to a neighbour.
  void resolve_pinch(Index label, Index v) {
    for (auto& sector : sectors(label, v)) {
      for (bool moved = true; moved && !sector.empty();) {
        moved = false;
        for (std::size_t i = 0; i < sector.size() && !moved; ++i)
          if (try_move(sector[i], true)) {
            sector.erase(sector.begin() + static_cast<std::ptrdiff_t>(i));
            moved = true;
          }
      }
      if (sectors(label, v).size() < 2) return;
    }
  }

 private:
  const PatchSurface& s_;
  Index source_, first_, also_;
  const RelaxOptions& options_;
  Regions& regions_;
  std::vector<Vec3> proxy_;
};

}  // namespace

void relax_borders(const Work& work, const PatchSurface& s, Index source, std::span<const Index> faces,
                   Index first_label, Index also, const RelaxOptions& options, Regions& regions) {
  Relaxation relax(s, source, first_label, also, options, regions);
  relax.fit(work, faces);
  std::vector<Index> active = compact(work, faces.size(), [&](std::size_t i) { return relax.on_border(faces[i]); });
  for (Index& f : active) f = faces[f];
  const auto unpinch = [&] {
    for (const Index f : active)
      for (int i = 0; i < 3; ++i) {
        const Index v = s.mesh.corner[3 * f + i];
        const auto star = s.mesh.vertex_faces.row(v);
        if (std::any_of(star.begin(), star.end(), [&](Index g) { return s.beside_hole[g] != 0; })) continue;
        const Index label = regions.label[f];
        if (relax.sectors(label, v).size() > 1) relax.resolve_pinch(label, v);
      }
  };
  unpinch();
  for (int pass = 0; pass < options.passes && !active.empty(); ++pass) {
    work.check();
    std::vector<Index> next;
    for (const Index f : active)
      if (relax.on_border(f) && relax.try_move(f, false))
        for (int i = 0; i < 3; ++i)
          for (const Index g : s.mesh.vertex_faces.row(s.mesh.corner[3 * f + i]))
            if (regions.source[g] == source && relax.is_movable_label(regions.label[g])) next.push_back(g);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    if (options.fit_normals && pass + 1 < options.passes) relax.fit(work, faces);
    active.swap(next);
  }
}

}  // namespace intarsia::kernels
