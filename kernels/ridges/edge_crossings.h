// Where crest lines cross mesh edges (Ohtake, Belyaev, Seidel 2004).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/fields.h"
#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// The fields of one channel. Valleys are the ridges of the reversed surface, which has
// (k_max, k_min, t_max, t_min, e_max, e_min) -> (-k_min, -k_max, t_min, t_max, -e_min, -e_max).
struct CrestFields {
  // `smoothed`, where not empty, takes the place of e_max (valleys: e_min); see smooth_extremality().
  CrestFields(const CurvatureFields& fields, CurveKind channel, std::span<const Real> smoothed = {});

  Real k(Index v) const { return sign * k_[v]; }  // curvature across the crest, the larger one
  Real other_k(Index v) const { return sign * other_[v]; }
  Real e(Index v) const { return sign * e_[v]; }  // derivative of k along the stored t
  Vec3 t(Index v) const { return t_[v]; }
  // A crest may pass here: k exceeds the other curvature in size, and the fit and its directions can be trusted.
  bool may_carry(Index v) const;

  Real sign;
  const CurvatureFields& fields;

 private:
  std::span<const Real> k_, other_, e_;
  Vec3View t_;
};

// The channel's extremality after `rounds` of averaging with the neighbours' values, turned to agree in direction
// (after Hildebrandt, Polthier, Wardetzky 2005). It is odd across a crest, so the crest stays where it is.
// Ensures: with the sign of e_max (valleys: e_min) of the fields; vertices without direction keep their value.
std::vector<Real> smooth_extremality(const Work& work, const MeshView& mesh, const CurvatureFields& fields,
                                     CurveKind channel, int rounds);

struct CrossingOptions {
  bool symbolic_zeros = true;  // |e| rho^2 < zero counts as a positive sign at its own vertex; off: strict signs
  Real zero = 1e-9;
};

// Crest points on edges, ascending by edge. position is measured from edge_v0; exactly 0 or 1 if the crest runs through
// that vertex.
struct EdgeCrossings {
  std::vector<Index> edge;
  std::vector<Real> position;

  Index size() const { return static_cast<Index>(edge.size()); }
};

// Edges with e_1 e_2 < 0 (t_2 turned to agree with t_1), k > |other k| at both ends, and a maximum of k between them:
// at one end at least k grows towards the other end.
// Requires: suppressed is empty or one byte per vertex; an edge with both ends suppressed carries no crossing.
EdgeCrossings edge_crossings(const Work& work, const MeshView& mesh, const CrestFields& crest,
                             std::span<const std::uint8_t> suppressed, const CrossingOptions& options);

}  // namespace intarsia::kernels
