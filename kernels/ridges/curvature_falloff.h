// How far the curvature has fallen beside a crest.
#pragma once

#include <array>

#include "kernels/ridges/edge_crossings.h"

namespace intarsia::kernels {

// Asked for points that follow each other along crests: where the last question ended, the next one starts.
class CurvatureFalloff {
 public:
  // Both must outlive this.
  CurvatureFalloff(const MeshView& mesh, const CrestFields& crest) : mesh_(mesh), crest_(crest) {}

  // Share of the crest's curvature k that is gone at distance 1.5 / k to both sides (mean of the two): 0 on cylinders,
  // tori and spheres, towards 1 on fillets between flat parts. Sides are reached by stepping from vertex `from`, or
  // from where a close point's side was reached, to ever nearer neighbours of p +- 1.5 / k across. Where the curvature
  // was fitted in wide discs this tells crests from round bodies; the slope of the extremality does not, for the
  // profile of a fillet is flat in its middle. Requires: across unit, k > 0.
  Real at(Index from, const Vec3& p, const Vec3& across, Real k);

 private:
  Index start_for(Index from, const Vec3& p, const Vec3& target, Real distance) const;

  const MeshView& mesh_;
  const CrestFields& crest_;
  // The point asked for last, the normal there, and the vertices that were reached.
  Vec3 last_ = Vec3::Zero(), last_normal_ = Vec3::Zero();
  std::array<Index, 2> reached_{kNone, kNone};
};

}  // namespace intarsia::kernels
