#include "engine/space/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/lanes.h"
#include "engine/parallel/for_each.h"
#include "engine/space/point_triangle.h"
#include "engine/space/split_triangles.h"

namespace intarsia {
namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();
constexpr Index kLeafBit = Index{1} << 31;
constexpr std::size_t kStack = 512;  // seven entries a level, at most 40 levels

// Corners of up to eight triangles, x y z of a, then of b and c. Unused lanes repeat the first one.
struct alignas(64) Leaf {
  Real corner[9][kLanes];
  Index id[kLanes];
};

// Boxes of up to eight children. Unused lanes are empty boxes, infinitely far.
struct alignas(64) Node {
  Real low[3][kLanes], high[3][kLanes];
  Index child[kLanes];
  Index count;
};

struct Entry {
  Real bound;
  Index child;
};

// Squared distances from p to the triangles of a leaf: operation by operation those of closest_on_triangle(), so that
// the bits agree; sums run as in Eigen, (x + y) + z. Choices are nested, since compilers take conjunctions of lane
// masks apart lane by lane.
#define INTARSIA_DOT(a, b) ((a)[0] * (b)[0] + (a)[1] * (b)[1] + (a)[2] * (b)[2])
INTARSIA_WIDE void distances2(const Leaf& leaf, const Real* p, Real* out) {
  const Lanes zero{}, one = zero + 1.0;
  Lanes a[3], b[3], c[3], ab[3], ac[3], ap[3], bp[3], cp[3], bc[3], ca[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = lanes_at(leaf.corner[k]), b[k] = lanes_at(leaf.corner[3 + k]), c[k] = lanes_at(leaf.corner[6 + k]);
    ab[k] = b[k] - a[k], ac[k] = c[k] - a[k], bc[k] = c[k] - b[k], ca[k] = a[k] - c[k];
    ap[k] = p[k] - a[k], bp[k] = p[k] - b[k], cp[k] = p[k] - c[k];
  }
  const Lanes d1 = INTARSIA_DOT(ab, ap), d2 = INTARSIA_DOT(ac, ap), d3 = INTARSIA_DOT(ab, bp),
              d4 = INTARSIA_DOT(ac, bp), d5 = INTARSIA_DOT(ab, cp), d6 = INTARSIA_DOT(ac, cp);
  const Lanes vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4, sum = va + vb + vc;
  const Lanes s = vb / sum, t = vc / sum;

  const Lanes ab2 = INTARSIA_DOT(ab, ab), bc2 = INTARSIA_DOT(bc, bc), ca2 = INTARSIA_DOT(ca, ca);
  Lanes u = INTARSIA_DOT(ap, ab) / ab2, v = INTARSIA_DOT(bp, bc) / bc2, w = INTARSIA_DOT(cp, ca) / ca2;
  u = ab2 > zero ? u : zero, v = bc2 > zero ? v : zero, w = ca2 > zero ? w : zero;
  Lanes q[3], x[3], y[3], z[3];
  for (int k = 0; k < 3; ++k) {
    q[k] = p[k] - (a[k] + s * ab[k] + t * ac[k]);
    x[k] = p[k] - (a[k] + u * ab[k]), y[k] = p[k] - (b[k] + v * bc[k]), z[k] = p[k] - (c[k] + w * ca[k]);
  }
  const Lanes a2 = INTARSIA_DOT(ap, ap), b2 = INTARSIA_DOT(bp, bp), c2 = INTARSIA_DOT(cp, cp);
  Lanes x2 = INTARSIA_DOT(x, x), y2 = INTARSIA_DOT(y, y), z2 = INTARSIA_DOT(z, z);
  x2 = u >= one ? b2 : x2, y2 = v >= one ? c2 : y2, z2 = w >= one ? a2 : z2;
  x2 = u <= zero ? a2 : x2, y2 = v <= zero ? b2 : y2, z2 = w <= zero ? c2 : z2;
  const Lanes yz = y2 <= z2 ? y2 : z2, side = x2 <= yz ? x2 : yz, inside = INTARSIA_DOT(q, q);

  Lanes result = va > zero ? inside : side;
  result = vb > zero ? result : side;
  result = vc > zero ? result : side;
  const Lanes at_c = d5 <= d6 ? c2 : result;
  result = d6 >= zero ? at_c : result;
  const Lanes at_b = d4 <= d3 ? b2 : result;
  result = d3 >= zero ? at_b : result;
  const Lanes at_a = d2 <= zero ? a2 : result;
  result = d1 <= zero ? at_a : result;
  lanes_at(out) = result;
}

// Squared distances from p to the boxes of a node: no more than those to any point in them, rounding included, since
// every operation is monotone and in the order of distances2.
INTARSIA_WIDE void bounds2(const Node& node, const Real* p, Real* out) {
  const Lanes zero{};
  Lanes gap[3];
  for (int k = 0; k < 3; ++k) {
    const Lanes below = lanes_at(node.low[k]) - p[k], above = p[k] - lanes_at(node.high[k]);
    gap[k] = below > above ? below : above;
    gap[k] = gap[k] > zero ? gap[k] : zero;
  }
  lanes_at(out) = INTARSIA_DOT(gap, gap);
}

// Distances along the ray at which it enters the boxes, a little early; kFar where it misses them or `most` is nearer.
INTARSIA_WIDE void entries(const Node& node, const Real* origin, const Real* inverse, Real most, Real* out) {
  const Lanes zero{}, far = zero + kFar;
  Lanes enter = zero, leave = zero + most;
  for (int k = 0; k < 3; ++k) {
    const Lanes s = (lanes_at(node.low[k]) - origin[k]) * inverse[k],
                t = (lanes_at(node.high[k]) - origin[k]) * inverse[k];
    const Lanes first = s < t ? s : t, last = s < t ? t : s;
    enter = first > enter ? first : enter, leave = last < leave ? last : leave;
  }
  constexpr Real kSlack = 1e-12;
  enter = enter * (1 - kSlack), leave = leave * (1 + kSlack);
  lanes_at(out) = enter <= leave ? enter : far;
}

// Distances along the ray to the triangles of a leaf (Moeller, Trumbore 1997), kFar where it misses them.
INTARSIA_WIDE void hits(const Leaf& leaf, const Real* origin, const Real* direction, Real least, Real* out) {
  const Lanes zero{}, one = zero + 1.0, far = zero + kFar;
  Lanes ab[3], ac[3], from[3];
  for (int k = 0; k < 3; ++k) {
    const Lanes a = lanes_at(leaf.corner[k]);
    ab[k] = lanes_at(leaf.corner[3 + k]) - a, ac[k] = lanes_at(leaf.corner[6 + k]) - a, from[k] = origin[k] - a;
  }
  const Real dx = direction[0], dy = direction[1], dz = direction[2];
  const Lanes h[3] = {dy * ac[2] - dz * ac[1], dz * ac[0] - dx * ac[2], dx * ac[1] - dy * ac[0]};
  const Lanes det = INTARSIA_DOT(ab, h);
  const Lanes u = INTARSIA_DOT(from, h) / det;
  const Lanes q[3] = {from[1] * ab[2] - from[2] * ab[1], from[2] * ab[0] - from[0] * ab[2],
                      from[0] * ab[1] - from[1] * ab[0]};
  const Lanes v = (dx * q[0] + dy * q[1] + dz * q[2]) / det, t = INTARSIA_DOT(ac, q) / det;
  Lanes least_part = u < v ? u : v;  // where det is 0, u + v is infinite or NaN, and so the next one negative or NaN
  least_part = least_part < one - (u + v) ? least_part : one - (u + v);
  const Lanes hit = t > least ? t : far;
  lanes_at(out) = least_part >= zero ? hit : far;
}
#undef INTARSIA_DOT

// The children of a node with bound(lane) <= limit, the farthest first, onto the stack.
std::size_t push_children(const Node& node, const Real* bound, Real limit, Entry* stack, std::size_t top) {
  const std::size_t base = top;
  for (std::size_t l = 0; l < node.count; ++l) {
    if (!(bound[l] <= limit)) continue;
    std::size_t at = top++;
    for (; at > base && stack[at - 1].bound < bound[l]; --at) stack[at] = stack[at - 1];
    stack[at] = {bound[l], node.child[l]};
  }
  return top;
}

}  // namespace

struct TriangleTree::Impl {
  std::vector<Node> node;
  std::vector<Leaf> leaf;
  std::vector<Index> leaf_of;  // triangle -> leaf
  std::vector<Index> order;

  Impl(const Work& work, const TrianglesView& triangles);

  void search_leaf(Index l, const Real* p, Real& best, Index& best_id, Index& best_leaf) const {
    alignas(64) Real distance[kLanes];
    distances2(leaf[l], p, distance);
    for (std::size_t i = 0; i < kLanes; ++i)
      if (distance[i] < best || (distance[i] == best && leaf[l].id[i] < best_id))
        best = distance[i], best_id = leaf[l].id[i], best_leaf = l;
  }
};

TriangleTree::Impl::Impl(const Work& work, const TrianglesView& triangles) {
  SplitTriangles split = split_triangles(work, triangles);
  node.resize(split.node.size());
  leaf.resize(split.leaf.size());
  leaf_of.resize(triangles.count());
  for_each(work, Cost::medium, node.size(), [&](std::size_t n) {
    node[n].count = split.node[n].count;
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool used = l < split.node[n].count;
      const SplitTriangles::Part part = used ? split.part[split.node[n].first + l] : SplitTriangles::Part{};
      for (std::size_t k = 0; k < 3; ++k) node[n].low[k][l] = part.box.low[k], node[n].high[k][l] = part.box.high[k];
      node[n].child[l] = part.is_leaf ? part.child | kLeafBit : part.child;
    }
  });
  for_each(work, Cost::medium, leaf.size(), [&](std::size_t n) {
    const auto& range = split.leaf[n];
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Index t = split.order[range.begin + (l < range.end - range.begin ? l : 0)];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = triangles.corner[3 * std::size_t{t} + i];
        leaf[n].corner[3 * i][l] = triangles.point.x[v];
        leaf[n].corner[3 * i + 1][l] = triangles.point.y[v];
        leaf[n].corner[3 * i + 2][l] = triangles.point.z[v];
      }
      leaf[n].id[l] = t;
      leaf_of[t] = static_cast<Index>(n);
    }
  });
  order = std::move(split.order);
}

TriangleTree::TriangleTree(const Work& work, const TrianglesView& triangles) {
  if (triangles.count() == 0) throw Error(ErrorCode::bad_argument, "a tree of triangles needs at least one");
  impl_ = std::make_unique<Impl>(work, triangles);
}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

std::span<const Index> TriangleTree::order() const { return impl_->order; }

ClosestTriangle TriangleTree::closest(const Vec3& p, Index hint) const {
  const Impl& tree = *impl_;
  Real best = kFar;
  Index best_id = kNone, best_leaf = 0;
  const Index hinted = hint < tree.leaf_of.size() ? tree.leaf_of[hint] : kNone;
  if (hinted != kNone) tree.search_leaf(hinted, p.data(), best, best_id, best_leaf);
  std::array<Entry, kStack> stack;
  stack[0] = {0, 0};
  for (std::size_t top = 1; top > 0;) {
    const Entry entry = stack[--top];
    if (entry.bound > best) continue;
    if (entry.child & kLeafBit) {
      const Index l = entry.child & ~kLeafBit;
      if (l != hinted) tree.search_leaf(l, p.data(), best, best_id, best_leaf);
      continue;
    }
    alignas(64) Real bound[kLanes];
    bounds2(tree.node[entry.child], p.data(), bound);
    top = push_children(tree.node[entry.child], bound, best, stack.data(), top);
  }
  ClosestTriangle result;
  result.triangle = best_id, result.distance2 = best;
  const Leaf& leaf = tree.leaf[best_leaf];
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (leaf.id[l] != best_id) continue;
    const auto corner = [&](std::size_t i) {
      return Vec3(leaf.corner[3 * i][l], leaf.corner[3 * i + 1][l], leaf.corner[3 * i + 2][l]);
    };
    result.point = closest_on_triangle(p, corner(0), corner(1), corner(2));
    break;
  }
  return result;
}

Real TriangleTree::first_hit(const Vec3& origin, const Vec3& direction, Real least) const {
  const Impl& tree = *impl_;
  Real best = kFar, inverse[3];
  for (int k = 0; k < 3; ++k)  // a huge number for parallel axes: never 0 times infinity
    inverse[k] = std::abs(direction[k]) > 1e-200 ? 1 / direction[k] : 1e200;
  std::array<Entry, kStack> stack;
  stack[0] = {0, 0};
  for (std::size_t top = 1; top > 0;) {
    const Entry entry = stack[--top];
    if (entry.bound > best) continue;
    alignas(64) Real value[kLanes];
    if (entry.child & kLeafBit) {
      hits(tree.leaf[entry.child & ~kLeafBit], origin.data(), direction.data(), least, value);
      for (const Real t : value) best = std::min(best, t);
      continue;
    }
    entries(tree.node[entry.child], origin.data(), inverse, best, value);
    // Boxes that the ray misses are at infinity: farther than any limit, also before the first hit.
    top = push_children(tree.node[entry.child], value, std::min(best, std::numeric_limits<Real>::max()), stack.data(),
                        top);
  }
  return best;
}

}  // namespace intarsia
