#include "kernels/surface/self_intersections.h"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/base/orientation.h"
#include "engine/parallel/for_each.h"
#include "kernels/surface/kd_order.h"

namespace intarsia::kernels {
namespace {

using Triangle = std::array<Vec3, 3>;

// Coordinates in whose plane the triangle has an area; u < 0 if there are none.
struct Plane {
  int u = -1, v = -1;
};

Plane plane_of(const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (orientation(t[0], t[1], t[2], u, v) != 0) return {u, v};
  }
  return {};
}

// In the plane, borders included.
bool is_inside(const Vec3& p, const Triangle& t, const Plane& in) {
  int left = 0, right = 0;
  for (int i = 0; i < 3; ++i) {
    const int side = orientation(t[i], t[(i + 1) % 3], p, in.u, in.v);
    left += side > 0 ? 1 : 0, right += side < 0 ? 1 : 0;
  }
  return left == 0 || right == 0;
}

bool do_cross(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Plane& in) {
  const int pa = orientation(p, q, a, in.u, in.v), pb = orientation(p, q, b, in.u, in.v);
  const int ap = orientation(a, b, p, in.u, in.v), aq = orientation(a, b, q, in.u, in.v);
  if (pa == 0 && pb == 0) return false;  // along one line: then an end lies inside, or they are apart
  return pa * pb <= 0 && ap * aq <= 0;
}

// Does the segment meet the triangle? Ends and borders included.
bool meets(const Vec3& p, const Vec3& q, const Triangle& t, const Plane& plane) {
  const int from = orientation(t[0], t[1], t[2], p), to = orientation(t[0], t[1], t[2], q);
  if (from * to > 0) return false;
  if (from == 0 && to == 0) {
    if (is_inside(p, t, plane) || is_inside(q, t, plane)) return true;
    for (int i = 0; i < 3; ++i)
      if (do_cross(p, q, t[i], t[(i + 1) % 3], plane)) return true;
    return false;
  }
  int left = 0, right = 0;
  for (int i = 0; i < 3; ++i) {
    const int side = orientation(p, q, t[i], t[(i + 1) % 3]);
    left += side > 0 ? 1 : 0, right += side < 0 ? 1 : 0;
  }
  return left == 0 || right == 0;
}

bool do_meet(const Triangle& s, const Triangle& t) {
  const Plane in_s = plane_of(s), in_t = plane_of(t);
  if (in_s.u < 0 || in_t.u < 0) return false;
  int shared = 0, s_first = 0, t_first = 0;  // a shared corner of each
  std::array<bool, 3> s_shared{}, t_shared{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) ++shared, s_shared[i] = t_shared[j] = true, s_first = i, t_first = j;
  if (shared == 3) return false;
  if (shared == 2) {
    int c = 0, d = 0;
    while (s_shared[c]) ++c;
    while (t_shared[d]) ++d;
    const Vec3 &a = s[(c + 1) % 3], &b = s[(c + 2) % 3];
    return orientation(a, b, s[c], t[d]) == 0 &&
           orientation(a, b, s[c], in_s.u, in_s.v) == orientation(a, b, t[d], in_s.u, in_s.v);
  }
  if (shared == 1)
    return meets(s[(s_first + 1) % 3], s[(s_first + 2) % 3], t, in_t) ||
           meets(t[(t_first + 1) % 3], t[(t_first + 2) % 3], s, in_s);
  for (int i = 0; i < 3; ++i)
    if (meets(s[i], s[(i + 1) % 3], t, in_t) || meets(t[i], t[(i + 1) % 3], s, in_s)) return true;
  return false;
}

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  void add(const Box& b) { low = low.cwiseMin(b.low), high = high.cwiseMax(b.high); }
  bool overlaps(const Box& b) const {
    return (low.array() <= b.high.array()).all() && (b.low.array() <= high.array()).all();
  }
};

// Triangles in a compact order, in leaves of eight, under a complete binary tree of boxes.
class BoxTree {
 public:
  static constexpr std::size_t kLeaf = 8;

  BoxTree(const Work& work, const Soup& soup) : soup_(soup), scale_(scale_of(soup)), order_(soup.face_count()) {
    Vec3Array middle(soup.face_count());
    for_each(work, Cost::light, middle.size(), [&](std::size_t f) {
      const Triangle t = triangle(static_cast<Index>(f));
      middle.set(f, ((t[0] + t[1] + t[2]) / 3).array() + 0.0);
    });
    kd_order(work, middle, {}, order_);
    leaves_ = (order_.size() + kLeaf - 1) / kLeaf;
    first_ = std::bit_ceil(leaves_);
    box_.resize(2 * first_);
    for_each(work, Cost::light, leaves_, [&](std::size_t l) {
      for (std::size_t i = l * kLeaf; i < std::min((l + 1) * kLeaf, order_.size()); ++i)
        for (const Vec3& p : triangle(order_[i])) box_[first_ + l].add(p);
    });
    for (std::size_t node = first_ - 1; node > 0; --node)
      box_[node].add(box_[2 * node]), box_[node].add(box_[2 * node + 1]);
  }

  std::size_t leaves() const { return leaves_; }

  // found(f, g) for each pair that meets with f in the leaf and g in it, or in one behind it.
  template <class Found>
  void pairs_of(std::size_t leaf, std::vector<std::size_t>& stack, const Found& found) const {
    stack.assign(1, 1);
    while (!stack.empty()) {
      const std::size_t node = stack.back();
      stack.pop_back();
      const int below = std::bit_width(first_) - std::bit_width(node);  // levels to the leaves
      if (((node + 1) << below) - 1 < first_ + leaf || !box_[node].overlaps(box_[first_ + leaf])) continue;
      if (node < first_)
        stack.push_back(2 * node), stack.push_back(2 * node + 1);
      else
        test(leaf, node - first_, found);
    }
  }

 private:
  // To a size of about 1 by a power of two, which changes no digit.
  static Real scale_of(const Soup& soup) {
    Real most = 0;
    for (const auto* c : {&soup.x, &soup.y, &soup.z})
      for (const Real v : *c) most = std::max(most, std::abs(v));
    return most > 0 ? std::ldexp(1.0, -std::ilogb(most)) : 1;
  }
  Triangle triangle(Index f) const {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = soup_.corner[3 * std::size_t{f} + i];
      t[i] = scale_ * Vec3(soup_.x[v], soup_.y[v], soup_.z[v]);
    }
    return t;
  }
  template <class Found>
  void test(std::size_t a, std::size_t b, const Found& found) const {
    const auto end = [&](std::size_t l) { return std::min((l + 1) * kLeaf, order_.size()); };
    for (std::size_t i = a * kLeaf; i < end(a); ++i) {
      const Triangle s = triangle(order_[i]);
      Box box;
      for (const Vec3& p : s) box.add(p);
      for (std::size_t j = a == b ? i + 1 : b * kLeaf; j < end(b); ++j) {
        const Triangle t = triangle(order_[j]);
        Box other;
        for (const Vec3& p : t) other.add(p);
        if (box.overlaps(other) && do_meet(s, t)) found(order_[i], order_[j]);
      }
    }
  }

  const Soup& soup_;
  Real scale_;
  std::vector<Index> order_;
  std::size_t leaves_ = 0, first_ = 0;
  std::vector<Box> box_;
};

}  // namespace

SelfIntersections self_intersections(const Work& work, const Soup& soup) {
  SelfIntersections result;
  if (soup.face_count() < 2) return result;
  const BoxTree tree(work, soup);
  std::vector<std::vector<Index>> met(tree.leaves());  // triangles two by two
  for_each_block(work, Cost::heavy, tree.leaves(), [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<std::size_t> stack;
    for (std::size_t l = begin; l < end; ++l)
      tree.pairs_of(l, stack, [&](Index f, Index g) { met[l].push_back(f), met[l].push_back(g); });
  });
  std::vector<Index> triangles;
  for (const auto& m : met) {
    result.pairs += m.size() / 2;
    triangles.insert(triangles.end(), m.begin(), m.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  const std::uint64_t count = triangles.size();
  for (Index& f : triangles) f = soup.source_of(f);
  result.triangles = fault_of(std::move(triangles), count);
  return result;
}

}  // namespace intarsia::kernels
