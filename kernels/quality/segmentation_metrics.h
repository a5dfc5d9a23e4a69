// How far two segmentations of one mesh agree (Chen, Golovinskiy, Funkhouser 2009). Everything is 0 for
// equal segmentations.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Labels 0 .. count - 1, one per face; every label need not occur.
struct Segmentation {
  std::span<const Index> label;
  Index count = 0;
};

struct LabelMetrics {
  Real missing_rate = 0;  // share of the area outside the candidate's segment that matches the reference segment best
  Real false_alarm = 0;   // the same with the roles exchanged
  Real hamming = 0;       // mean of both
  Real rand_error = 0;    // share of the pairs of faces that one keeps together and the other separates
  Real gce = 0, lce = 0;  // global and local consistency error (Martin et al. 2001); 0 where one refines the other
};

// face_area: weights of the faces (not of the pairs of the Rand index, which counts faces).
// Requires: as many areas as labels in both, at least two faces, a positive total.
LabelMetrics compare_labels(const Work& work, std::span<const Real> face_area, const Segmentation& candidate,
                            const Segmentation& reference);

struct CutDiscrepancy {
  Real forward = 0, backward = 0;  // mean geodesic distance from the candidate's borders to the reference's, and back
  Real radius = 0;                 // mean Euclidean distance of the surface from its centroid
  Real unreached = 0;              // share of the border length on pieces of the surface where the other has no border
  Real value() const { return (forward + backward) / radius; }
};

// Nothing if one of the two has no border: then the measure is not defined.
// Distances by fast marching (Kimmel, Sethian 1998; along edges where the front would enter a triangle from outside):
// exact across plane strips, first order elsewhere. Borders weigh by the length of their edges.
std::optional<CutDiscrepancy> cut_discrepancy(const Work& work, const MeshView& mesh, const Segmentation& candidate,
                                              const Segmentation& reference);

// Edges between faces of different labels, ascending. The boundary of the mesh is none.
std::vector<Index> border_edges(const Work& work, const MeshView& mesh, std::span<const Index> label);

}  // namespace intarsia::kernels
