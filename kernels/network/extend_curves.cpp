#include "kernels/network/extend_curves.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/parallel/compact.h"
#include "engine/parallel/greedy.h"
#include "kernels/network/bridge_gaps.h"
#include "kernels/network/growing_end.h"

namespace intarsia::kernels {
namespace {

constexpr Real kDegree = M_PI / 180;

class Extension {
 public:
  Extension(const Work& work, const RefinedMesh& refined, std::span<const std::uint8_t> active, const Terrain& terrain,
            const ExtensionOptions& options)
      : terrain_(terrain), options_(options), mesh_(refined.mesh) {
    taken_.assign(mesh_.vertex_count(), 0);
    tip_end_.assign(mesh_.vertex_count(), kNone);
    for (Index e = 0; e < mesh_.edge_count(); ++e)
      if (active[e]) taken_[mesh_.edge_v0[e]] = taken_[mesh_.edge_v1[e]] = 1;
    ends_ = find_ends(work, refined, active, options.own_tail * terrain.mean_edge());
    for (Index i = 0; i < ends_.size(); ++i) tip_end_[ends_[i].path.back()] = i;
    plan_.resize(ends_.size());
  }

  Index end_count() const { return static_cast<Index>(ends_.size()); }
  std::vector<GrowingEnd>& ends() { return ends_; }
  std::vector<std::uint8_t>& taken() { return taken_; }

  Real propose(Index i) {
    GrowingEnd& end = ends_[i];
    Plan& plan = plan_[i];
    plan = {};
    if (is_closed(i) || end.grown > options_.max_length) return kNoStep;
    const Heading h = heading(terrain_, options_, end.path, end.tracer);
    plan.ideal = h.ideal;
    if (plan_meeting(end, h, plan)) return 0;
    const Index tip = end.path.back();
    Real best = kNoStep;
    for (Index q : terrain_.ring(tip)) {
      if (is_taken(q)) continue;
      const Real c = step_cost(terrain_, options_, end.path, h, end.channel, q);
      if (c < best) best = c, plan.step = q;
    }
    return best;
  }

  void list_claims(Index i, std::vector<Index>& out) const {
    const Plan& plan = plan_[i];
    if (plan.step != kNone) out.push_back(plan.step);
    if (plan.target != kNone && plan.step == kNone) out.push_back(ends_[i].path.back());
  }

  bool commit(Index i) {
    GrowingEnd& end = ends_[i];
    const Plan plan = plan_[i];
    if (plan.step != kNone && flag(taken_[plan.step]).exchange(1) != 0) return false;
    const Index tip = end.path.back();
    if (plan.step != kNone) {
      append(end, plan.step, plan.ideal);
      if (plan.target == kNone) set_end_at(tip, kNone), set_end_at(plan.step, i);
    }
    if (plan.target != kNone) {
      append(end, plan.target, plan.ideal);
      close(i);
      const Index other = end_at(plan.target);
      if (other != kNone && other != i) close(other);
    }
    return true;
  }

 private:
  struct Plan {
    Index step = kNone;    // free vertex to append
    Index target = kNone;  // network vertex to end on, after `step` if there is one
    Vec3 ideal = Vec3::Zero();
  };

  // Several ends look here at once, and in the relaxed order write here too.
  static std::atomic_ref<std::uint8_t> flag(std::uint8_t& f) { return std::atomic_ref<std::uint8_t>(f); }
  bool is_taken(Index v) { return flag(taken_[v]).load(std::memory_order_relaxed) != 0; }
  bool is_closed(Index i) { return flag(ends_[i].closed).load(std::memory_order_relaxed) != 0; }
  void close(Index i) { flag(ends_[i].closed).store(1, std::memory_order_relaxed); }

  Index end_at(Index v) { return std::atomic_ref<Index>(tip_end_[v]).load(std::memory_order_relaxed); }
  void set_end_at(Index v, Index i) { std::atomic_ref<Index>(tip_end_[v]).store(i, std::memory_order_relaxed); }

  void append(GrowingEnd& end, Index q, const Vec3& ideal) {
    const Vec3 p = terrain_.point(end.path.back()), to = terrain_.point(q), n = terrain_.normal(q);
    end.grown += (to - p).norm();
    Vec3 y = end.tracer + ideal * (to - p).dot(ideal) - to;
    y -= y.dot(n) * n;
    const Real limit = 1.5 * terrain_.mean_edge();
    if (y.norm() > limit) y *= limit / y.norm();
    end.tracer = to + y;
    end.path.push_back(q);
  }

  bool is_own_tail(const GrowingEnd& end, Index z) const {
    Real walked = 0;
    for (std::size_t i = end.path.size(); i-- > 0 && walked < options_.own_tail * terrain_.mean_edge();) {
      if (end.path[i] == z) return true;
      if (i > 0) walked += (terrain_.point(end.path[i]) - terrain_.point(end.path[i - 1])).norm();
    }
    return false;
  }

  // How good it is to end on z: the smaller the better, infinity if z will not do.
  Real meeting_cost(const GrowingEnd& end, const Heading& h, Index z) {
    const Index tip = end.path.back();
    const Vec3 to = terrain_.point(z) - terrain_.point(tip);
    const Real distance = to.norm(), reach = options_.meet * terrain_.mean_edge();
    if (options_.meet_rings > 1 && distance > reach) return kNoStep;
    if (terrain_.normal(z).dot(terrain_.normal(tip)) < 0) return kNoStep;
    const Real along = distance > 0 ? h.walk.dot(to) / distance : 1;
    if (along < std::cos(options_.meet_angle * kDegree) || is_own_tail(end, z)) return kNoStep;
    return distance * (2 - along);
  }

  bool plan_meeting(const GrowingEnd& end, const Heading& h, Plan& plan) {
    const Index tip = end.path.back();
    Real best = kNoStep;
    const auto offer = [&](Index z, Index via) {
      const Real c = meeting_cost(end, h, z);
      if (c < best) best = c, plan.target = z, plan.step = via;
    };
    for (Index q : terrain_.ring(tip))
      if (is_taken(q)) offer(q, kNone);
    if (best < kNoStep || options_.meet_rings < 2) return best < kNoStep;
    const auto turning = [&](Index q, Index z) {
      const Vec3 a = (terrain_.point(q) - terrain_.point(tip)).normalized();
      return a.dot((terrain_.point(z) - terrain_.point(q)).normalized()) + a.dot(h.walk);
    };
    for (Index q : terrain_.ring(tip)) {
      if (is_taken(q)) continue;
      for (Index z : terrain_.ring(q)) {
        if (!is_taken(z) || z == tip) continue;
        if (plan.target == z && turning(plan.step, z) < turning(q, z)) plan.step = q;
        offer(z, q);
      }
    }
    return best < kNoStep;
  }

  const Terrain& terrain_;
  const ExtensionOptions& options_;
  MeshView mesh_;
  std::vector<GrowingEnd> ends_;
  std::vector<Plan> plan_;
  std::vector<std::uint8_t> taken_;
  std::vector<Index> tip_end_;  // vertex -> the end whose tip it is
};

}  // namespace

ExtensionResult extend_curves(const Work& work, const RefinedMesh& refined, std::span<const std::uint8_t> active,
                              const Terrain& terrain, const ExtensionOptions& options) {
  Extension game(work, refined, active, terrain, options);
  GreedyOptions greedy;
  greedy.order = options.paper_queue ? GreedyOrder::queue : GreedyOrder::rounds;
  Greedy(work, game.end_count(), refined.mesh.vertex_count(), game, greedy).run();
  ExtensionResult result;
  result.ends = game.end_count();
  for (const GrowingEnd& end : game.ends()) result.met += end.closed;
  result.bridged = bridge_gaps(work, terrain, options, game.taken(), game.ends());
  result.dead = result.ends - result.met - result.bridged;
  const MeshView mesh = refined.mesh;
  for (const GrowingEnd& end : game.ends())
    for (std::size_t i = end.start; i + 1 < end.path.size(); ++i)
      result.edge.push_back(mesh.edge_between(end.path[i], end.path[i + 1]));
  return result;
}

}  // namespace intarsia::kernels
