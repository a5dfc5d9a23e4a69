#include "engine/space/split_triangles.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/reduce.h"

namespace intarsia {
namespace {

constexpr std::size_t kBins = 16, kChildren = 8, kLeafSize = 8;
constexpr std::size_t kPlainHalves = 24;      // levels after which parts are halved by count: bounds the depth
constexpr std::size_t kManyItems = 1u << 15;  // a range worth several threads

struct Item {
  Box box;
  Index id;
  Real centre2(std::size_t k) const { return box.low[k] + box.high[k]; }  // twice the centre
};

// What lies in a range of items: their boxes and, twice, the box of their centres.
struct Contents {
  Box box, centre2;
  Index count = 0;
  void add(const Item& item) {
    box.add(item.box);
    for (std::size_t k = 0; k < 3; ++k) {
      const Real c = item.centre2(k);
      centre2.low[k] = std::min(centre2.low[k], c), centre2.high[k] = std::max(centre2.high[k], c);
    }
    ++count;
  }
  void add(const Contents& o) { box.add(o.box), centre2.add(o.centre2), count += o.count; }
};

struct Piece {
  Index begin = 0, end = 0;
  Contents contents;
  Index size() const { return end - begin; }
};

using Bins = std::array<Contents, kBins>;

class Splitter {
 public:
  Splitter(const Work& work, const TrianglesView& triangles) : work_(work), item_(triangles.count()) {
    for_each(work, Cost::light, item_.size(), [&](std::size_t t) {
      Item& item = item_[t];
      item.id = static_cast<Index>(t);
      const std::span<const Real> axis[3] = {triangles.point.x, triangles.point.y, triangles.point.z};
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
          const Real c = axis[k][triangles.corner[3 * t + i]];
          item.box.low[k] = std::min(item.box.low[k], c), item.box.high[k] = std::max(item.box.high[k], c);
        }
        // Room for the rounding of a point computed from the corners.
        const Real room = 4e-15 * std::max(std::abs(item.box.low[k]), std::abs(item.box.high[k]));
        item.box.low[k] -= room, item.box.high[k] += room;
      }
    });
  }

  SplitTriangles run() {
    SplitTriangles out;
    Piece all{0, static_cast<Index>(item_.size()), {}};
    all.contents = contents_of(all);
    std::vector<Piece> level{all}, below;
    std::vector<std::vector<Piece>> split;
    for (std::size_t depth = 0; !level.empty(); ++depth) {
      split.assign(level.size(), {});
      for_each(work_, Cost::single, level.size(),
               [&](std::size_t n) { split[n] = split_node(level[n], depth >= kPlainHalves); });
      const auto first_of_next = static_cast<Index>(out.node.size() + level.size());
      below.clear();
      for (const std::vector<Piece>& pieces : split) {
        out.node.push_back({static_cast<Index>(out.part.size()), static_cast<Index>(pieces.size())});
        for (const Piece& p : pieces) {
          SplitTriangles::Part part{p.contents.box, 0, p.size() <= kLeafSize};
          part.child = static_cast<Index>(part.is_leaf ? out.leaf.size() : first_of_next + below.size());
          if (part.is_leaf)
            out.leaf.push_back({p.begin, p.end});
          else
            below.push_back(p);
          out.part.push_back(part);
        }
      }
      level.swap(below);
      work_.check();
    }
    out.order.resize(item_.size());
    for_each(work_, Cost::light, item_.size(), [&](std::size_t i) { out.order[i] = item_[i].id; });
    return out;
  }

 private:
  Contents contents_of(const Piece& piece) const {
    return reduce(
        work_, Cost::light, piece.size(), Contents{},
        [&](std::size_t begin, std::size_t end) {
          Contents c;
          for (std::size_t i = begin; i < end; ++i) c.add(item_[piece.begin + i]);
          return c;
        },
        [](Contents a, const Contents& b) {
          a.add(b);
          return a;
        });
  }

  static bool is_worse(const Piece& a, const Piece& b, bool plain) {
    return plain ? a.size() > b.size() : a.contents.box.half_area() > b.contents.box.half_area();
  }

  std::vector<Piece> split_node(const Piece& node, bool plain) {
    std::vector<Piece> pieces{node};
    while (pieces.size() < kChildren) {
      std::size_t worst = kChildren;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (pieces[i].size() <= kLeafSize) continue;
        if (worst == kChildren || is_worse(pieces[i], pieces[worst], plain)) worst = i;
      }
      if (worst == kChildren) break;
      const auto [left, right] = plain ? halve(pieces[worst]) : split(pieces[worst]);
      pieces[worst] = left;
      pieces.push_back(right);
    }
    return pieces;
  }

  std::pair<Piece, Piece> halve(const Piece& piece) const {
    const Index middle = piece.begin + piece.size() / 2;
    Piece left{piece.begin, middle, {}}, right{middle, piece.end, {}};
    left.contents = contents_of(left), right.contents = contents_of(right);
    return {left, right};
  }

  std::pair<Piece, Piece> split(const Piece& piece) {
    const Box& centre2 = piece.contents.centre2;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (centre2.high[k] - centre2.low[k] > centre2.high[axis] - centre2.low[axis]) axis = k;
    const Real low = centre2.low[axis], extent = centre2.high[axis] - low;
    const Real scale = kBins / extent;
    if (!(extent > 0) || !std::isfinite(scale)) return halve(piece);
    const auto bin_of = [&](const Item& item) {
      return std::min(static_cast<std::size_t>((item.centre2(axis) - low) * scale), kBins - 1);
    };
    const Bins bins = fill_bins(piece, bin_of);

    // Right sums first, then the cost of every border between two bins; equal costs: the more even one.
    std::array<Contents, kBins> right;
    right[kBins - 1] = bins[kBins - 1];
    for (std::size_t b = kBins - 1; b-- > 0;) right[b] = bins[b], right[b].add(right[b + 1]);
    Contents left, best_left;
    std::size_t best = 0;
    Real best_cost = 0;
    Index best_excess = 0;
    for (std::size_t b = 1; b < kBins; ++b) {
      left.add(bins[b - 1]);
      if (left.count == 0 || right[b].count == 0) continue;
      const Real cost = left.count * left.box.half_area() + right[b].count * right[b].box.half_area();
      const Index excess = std::max(left.count, right[b].count);
      if (best == 0 || cost < best_cost || (cost == best_cost && excess < best_excess))
        best = b, best_cost = cost, best_excess = excess, best_left = left;
    }
    if (best == 0) return halve(piece);
    std::partition(item_.begin() + piece.begin, item_.begin() + piece.end,
                   [&](const Item& item) { return bin_of(item) < best; });
    const Index middle = piece.begin + best_left.count;
    return {{piece.begin, middle, best_left}, {middle, piece.end, right[best]}};
  }

  template <class BinOf>
  Bins fill_bins(const Piece& piece, const BinOf& bin_of) const {
    const auto fill = [&](std::size_t begin, std::size_t end) {
      Bins bins;
      for (std::size_t i = begin; i < end; ++i) {
        const Item& item = item_[piece.begin + i];
        bins[bin_of(item)].add(item);
      }
      return bins;
    };
    if (piece.size() < kManyItems) return fill(0, piece.size());
    return reduce(work_, Cost::light, piece.size(), Bins{}, fill, [](Bins a, const Bins& b) {
      for (std::size_t i = 0; i < kBins; ++i) a[i].add(b[i]);
      return a;
    });
  }

  const Work& work_;
  std::vector<Item> item_;
};

}  // namespace

SplitTriangles split_triangles(const Work& work, const TrianglesView& triangles) {
  return Splitter(work, triangles).run();
}

}  // namespace intarsia
