// How far the curvature has fallen beside a crest.
#pragma once

#include "kernels/ridges/edge_crossings.h"

namespace intarsia::kernels {

// Share of the crest's curvature k that is gone at distance 1.5 / k to both sides (mean of the two): 0 on cylinders,
// tori and spheres, towards 1 on fillets between flat parts. Sides are reached by stepping from vertex `from` to ever
// nearer neighbours of p +- 1.5 / k across. Where the curvature was fitted in wide discs this tells crests from round
// bodies; the slope of the extremality does not, for the profile of a fillet is flat in its middle.
// Requires: across unit, k > 0.
Real curvature_falloff(const MeshView& mesh, const CrestFields& crest, Index from, const Vec3& p, const Vec3& across,
                       Real k);

}  // namespace intarsia::kernels
