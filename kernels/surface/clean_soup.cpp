#include "kernels/surface/clean_soup.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "engine/parallel/compact.h"
#include "engine/parallel/sort.h"
#include "kernels/surface/check_soup.h"
#include "kernels/surface/normalise_box.h"
#include "kernels/surface/orient_triangles.h"
#include "kernels/surface/soup_pieces.h"
#include "kernels/surface/split_vertices.h"
#include "kernels/surface/weld_borders.h"

namespace intarsia::kernels {
namespace {

struct Corners {
  std::array<Index, 3> v;  // ascending
  Index triangle;
  auto operator<=>(const Corners&) const = default;
};

bool repeats(const Index* c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

class Cleaner {
 public:
  Cleaner(const Work& work, const Soup& input, const CleanOptions& options)
      : work_(work), input_(input), options_(options), box_(normalise_box(work, input)) {}

  Cleaning run() {
    SoupState state = look_at_soup(work_, input_);
    std::vector<Index> joined;
    if (state.is_surface) {
      joined = weld(input_, state.on_border);
      if (joined.empty() && is_tidy(state.on_border)) return {};
    }
    begin();
    drop_repeated();
    if (joined.empty()) joined = weld(out_.soup, border_of(out_.soup));
    if (!joined.empty()) join(joined);
    drop_duplicates();
    make_manifold();
    settle_pieces();
    end();
    return std::move(out_);
  }

 private:
  // A surface whose pieces are all large and face outwards. Keeps what it has learnt.
  bool is_tidy(const std::vector<std::uint8_t>& on_border) {
    const SoupPieces pieces = soup_pieces(work_, input_, on_border, box_.centre);
    return specks(pieces, options_.speck_area, options_.most_specks).empty() &&
           (!options_.turn_outward || inward_pieces(pieces).empty());
  }

  void begin() {
    out_.changed = true;
    out_.soup = input_;
    out_.input_triangle.resize(input_.face_count());
    for_each(work_, Cost::light, input_.face_count(),
             [&](std::size_t t) { out_.input_triangle[t] = static_cast<Index>(t); });
    twin_.assign(input_.face_count(), kNone);
  }

  std::vector<Index> weld(const Soup& soup, const std::vector<std::uint8_t>& on_border) const {
    if (!(options_.weld_distance > 0)) return {};
    const std::vector<Index> border =
        compact(work_, on_border.size(), [&](std::size_t v) { return on_border[v] != 0; });
    const Vec3 low = box_.centre - Vec3::Constant(box_.diagonal);
    return weld_borders(work_, soup, border, low, options_.weld_distance * box_.diagonal);
  }

  // Vertices of edges with one triangle.
  std::vector<std::uint8_t> border_of(const Soup& soup) const {
    const std::vector<Side> side = sorted_sides(work_, soup.corner);
    std::vector<std::uint8_t> on_border(soup.vertex_count(), 0);
    for_each_edge(work_, side, [&](std::size_t begin, std::size_t end) {
      if (end - begin == 1) on_border[side[begin].a] = on_border[side[begin].b] = 1;
    });
    return on_border;
  }

  void note(CleanAction action, std::vector<Index> named, std::uint64_t count) {
    Fault& fault = out_.done[static_cast<std::size_t>(action)];
    named.insert(named.end(), fault.first.begin(), fault.first.end());
    fault = fault_of(std::move(named), fault.count + count);
  }
  // Triangles as they are now, ascending.
  void note_triangles(CleanAction action, const std::vector<Index>& triangles, std::uint64_t count) {
    std::vector<Index> named;
    for (std::size_t i = 0; i < std::min<std::size_t>(triangles.size(), 4 * Fault::kNamed); ++i)
      named.push_back(input_.source_of(out_.input_triangle[triangles[i]]));
    note(action, std::move(named), count);
  }

  // keep: triangles as they are now, ascending.
  void keep(const std::vector<Index>& kept) {
    std::vector<Index> corner(3 * kept.size()), from(kept.size());
    for_each(work_, Cost::light, kept.size(), [&](std::size_t i) {
      std::copy_n(&out_.soup.corner[3 * std::size_t{kept[i]}], 3, &corner[3 * i]);
      from[i] = out_.input_triangle[kept[i]];
    });
    out_.soup.corner = std::move(corner), out_.input_triangle = std::move(from);
  }

  void drop_repeated() {
    const auto bad = [&](std::size_t t) { return repeats(&out_.soup.corner[3 * t]); };
    const std::size_t triangles = out_.input_triangle.size();
    const std::vector<Index> dropped = compact(work_, triangles, bad);
    if (dropped.empty()) return;
    note_triangles(CleanAction::repeated_corners, dropped, dropped.size());
    keep(compact(work_, triangles, [&](std::size_t t) { return !bad(t); }));
  }

  void join(const std::vector<Index>& becomes) {
    const std::vector<Index> moved = compact(work_, becomes.size(), [&](std::size_t v) { return becomes[v] != v; });
    note(CleanAction::welded, {moved.begin(), moved.begin() + std::min<std::size_t>(moved.size(), Fault::kNamed)},
         moved.size());
    for_each(work_, Cost::light, out_.soup.corner.size(),
             [&](std::size_t c) { out_.soup.corner[c] = becomes[out_.soup.corner[c]]; });
    drop_repeated();
    out_.becomes = becomes;
  }

  void drop_duplicates() {
    const std::size_t triangles = out_.input_triangle.size();
    std::vector<Corners> all(triangles);
    for_each(work_, Cost::light, triangles, [&](std::size_t t) {
      std::copy_n(&out_.soup.corner[3 * t], 3, all[t].v.begin());
      all[t].triangle = static_cast<Index>(t);
      std::sort(all[t].v.begin(), all[t].v.end());
    });
    sort_total(work_, all.begin(), all.end());
    std::vector<Index> dropped;
    for (std::size_t i = 1, first = 0; i < triangles; ++i) {
      if (all[i].v != all[first].v) first = i;
      if (i == first) continue;
      dropped.push_back(all[i].triangle);
      twin_[out_.input_triangle[all[i].triangle]] = out_.input_triangle[all[first].triangle];
    }
    if (dropped.empty()) return;
    std::sort(dropped.begin(), dropped.end());
    note_triangles(CleanAction::duplicates, dropped, dropped.size());
    keep(compact(work_, triangles, [&](std::size_t t) {
      return !std::binary_search(dropped.begin(), dropped.end(), static_cast<Index>(t));
    }));
  }

  void make_manifold() {
    Soup& soup = out_.soup;
    std::vector<Real> area(out_.input_triangle.size());
    for_each(work_, Cost::light, area.size(), [&](std::size_t t) {
      const Vec3 a = point(soup.corner[3 * t]);
      area[t] = (point(soup.corner[3 * t + 1]) - a).cross(point(soup.corner[3 * t + 2]) - a).norm();
    });
    const Orientation o = orient_triangles(work_, sorted_sides(work_, soup.corner), area);
    note_triangles(CleanAction::cut_crowded, o.cut_crowded, o.cut_crowded.size());
    note_triangles(CleanAction::cut_unorientable, o.cut_unorientable, o.cut_unorientable.size());
    out_.copy_of = split_vertices(work_, soup.vertex_count(), o.partner, soup.corner);
    note(CleanAction::split_vertices, out_.copy_of, out_.copy_of.size());
    for (const Index v : out_.copy_of)
      soup.x.push_back(soup.x[v]), soup.y.push_back(soup.y[v]), soup.z.push_back(soup.z[v]);
    turn(CleanAction::turned, compact(work_, area.size(), [&](std::size_t t) { return o.turned[t] != 0; }));
  }

  void turn(CleanAction action, const std::vector<Index>& triangles) {
    if (triangles.empty()) return;
    note_triangles(action, triangles, triangles.size());
    for (const Index t : triangles)
      std::swap(out_.soup.corner[3 * std::size_t{t} + 1], out_.soup.corner[3 * std::size_t{t} + 2]);
  }

  void settle_pieces() {
    const SoupPieces pieces = soup_pieces(work_, out_.soup, border_of(out_.soup), box_.centre);
    const auto triangles_of = [&](const std::vector<Index>& chosen) {
      std::vector<std::uint8_t> is(pieces.count(), 0);
      for (const Index p : chosen) is[p] = 1;
      return compact(work_, out_.input_triangle.size(), [&](std::size_t t) { return is[pieces.piece_of(t)] != 0; });
    };
    if (options_.turn_outward) turn(CleanAction::turned_outward, triangles_of(inward_pieces(pieces)));
    const std::vector<Index> small = specks(pieces, options_.speck_area, options_.most_specks);
    if (small.empty()) return;
    out_.speck_pieces = static_cast<Index>(small.size());
    const std::vector<Index> dropped = triangles_of(small);
    note_triangles(CleanAction::specks, dropped, dropped.size());
    std::vector<Index> rest, kept;
    for (Index p = 0; p < pieces.count(); ++p)
      if (!std::binary_search(small.begin(), small.end(), p)) rest.push_back(p);
    keep(triangles_of(rest));
  }

  void end() {
    Soup& soup = out_.soup;
    soup.source_face.resize(out_.input_triangle.size());
    out_.triangle_of.assign(input_.face_count(), kNone);
    for (std::size_t t = 0; t < out_.input_triangle.size(); ++t) {
      soup.source_face[t] = input_.source_of(out_.input_triangle[t]);
      out_.triangle_of[out_.input_triangle[t]] = static_cast<Index>(t);
    }
    for (std::size_t t = 0; t < twin_.size(); ++t)
      if (twin_[t] != kNone) out_.triangle_of[t] = out_.triangle_of[twin_[t]];
    check_soup(work_, soup);
  }

  Vec3 point(Index v) const { return {out_.soup.x[v], out_.soup.y[v], out_.soup.z[v]}; }

  const Work& work_;
  const Soup& input_;
  const CleanOptions& options_;
  BoxTransform box_;
  std::vector<Index> twin_;  // input triangle -> the one it repeats
  Cleaning out_;
};

}  // namespace

const char* name_of(CleanAction action) {
  constexpr const char* kName[] = {"repeated-corners", "welded",         "duplicates",     "turned", "cut-crowded",
                                   "cut-unorientable", "split-vertices", "turned-outward", "specks"};
  return kName[static_cast<std::size_t>(action)];
}

const char* text_of(CleanAction action) {
  constexpr const char* kText[] = {"triangles with a corner twice were dropped",
                                   "vertices on borders were joined to others at the same place",
                                   "triangles that repeat others were dropped",
                                   "triangles were turned to face as their neighbours do",
                                   "edges of three triangles or more were cut open",
                                   "edges were cut open where a piece has only one side",
                                   "vertices were added where parts of the surface only touch",
                                   "triangles of closed pieces that faced inwards were turned",
                                   "triangles of tiny loose pieces were left out"};
  return kText[static_cast<std::size_t>(action)];
}

Cleaning clean_soup(const Work& work, const Soup& soup, const CleanOptions& options) {
  if (options.strict) {
    check_soup(work, soup);
    return {};
  }
  check_corners(work, soup);
  return Cleaner(work, soup, options).run();
}

}  // namespace intarsia::kernels
