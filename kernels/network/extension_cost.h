// The next step of a growing curve: where the ideal curve would go, and what each candidate vertex costs.
// Cao, Yan, Wonka 2014, 3.4: curvature, continuity of the principal direction averaged over the last m = 5 points, and
// smoothness. Beyond the paper: the tracer, a point of the ideal curve that the chain of vertices steers back to,
// without which curves lock to the directions of the mesh edges (the idea of Bresenham's lines).
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/curve_network.h"
#include "engine/data/vertex_ring.h"
#include "kernels/network/direction_field.h"

namespace intarsia::kernels {

struct ExtensionOptions {
  Real cone = 75;   // degrees between the ideal direction and a candidate edge (paper mode: 60)
  Real walk = 4;    // walking direction: chord over this many mean edges
  int history = 5;  // points whose principal directions are averaged (paper: m = 5)
  Real weight_curvature = 0.3, weight_direction = 0.4, weight_smoothness = 0.3;
  Real feedback = 1;     // pull back to the tracer (kappa); 0 in paper mode
  Real walk_weight = 1;  // of the walking direction beside the confidence-weighted field
  Real meet = 2.2;       // mean edges: distance at which a curve ends on another (paper mode: its 1-ring)
  int meet_rings = 2;
  Real own_tail = 8;         // mean edges of its own tail that a curve may not meet
  Real meet_angle = 100;     // degrees between the walking direction and the point met
  Real max_length = 0.5;     // diagonals that one end may grow before it takes the shortest way to the network
  bool paper_queue = false;  // the paper's global queue instead of cost bands
  Real max_gap = 0.25;       // diagonals: longest shortest-way connection of an end without candidates
};

// What the growing curves read: geometry and guidance per vertex of the refined mesh.
class Terrain {
 public:
  // Requires: all arguments outlive this object; `normal` and `field` have one entry per original vertex.
  Terrain(const RefinedMesh& refined, Vec3View normal, const DirectionField& field, Index original_vertices,
          Real mean_edge);

  const MeshView& mesh() const { return mesh_; }
  Real mean_edge() const { return mean_edge_; }
  Vec3 point(Index v) const { return mesh_.point(v); }
  Vec3 normal(Index v) const { return normal_[guide(v)]; }
  Vec3 direction(Index v) const { return field_.direction[guide(v)]; }
  Real confidence(Index v) const { return field_.confidence[guide(v)]; }
  // Curvature of the channel as a share of its 95th percentile.
  Real relative_curvature(Index v, CurveKind channel) const;
  VertexRing ring(Index v) const { return VertexRing(mesh_, v); }

 private:
  Index guide(Index v) const { return v < originals_ ? v : guide_[v - originals_]; }

  const RefinedMesh& refined_;
  MeshView mesh_;
  Vec3View normal_;
  const DirectionField& field_;
  Index originals_;
  Real mean_edge_;
  std::vector<Index> guide_;  // refined vertex beyond the originals -> nearest original vertex of its edge or face
};

// The ideal direction at the tip of a path and the tangential pull towards the tracer.
struct Heading {
  Vec3 walk;   // d: chord of the last walked edges, in the tangent plane
  Vec3 ideal;  // s: field and walk together
  Vec3 aim;    // r*: ideal plus feedback
};

Heading heading(const Terrain& terrain, const ExtensionOptions& options, std::span<const Index> path,
                const Vec3& tracer);

// Cost of stepping from the tip of `path` to q, in [0, 1]; kNoStep (infinity) if q is outside the cone.
Real step_cost(const Terrain& terrain, const ExtensionOptions& options, std::span<const Index> path,
               const Heading& heading, CurveKind channel, Index q);

}  // namespace intarsia::kernels
