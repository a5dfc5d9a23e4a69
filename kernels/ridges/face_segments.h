// Crest points of a triangle joined to segments (Cao, Yan, Wonka 2014, section 3.2; Ohtake et al. 2004).
#pragma once

#include <span>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Nodes 0 .. crossings-1 are the crossings in edge order; after them come centre nodes, one for each face with three.
struct SegmentGraph {
  Index crossing_count = 0;
  std::vector<Index> centre_face;  // face of each centre node, ascending
  std::vector<Index> a, b;         // the two nodes of each segment, in face order
  std::vector<Index> face;         // the face that holds the segment

  Index node_count() const { return crossing_count + static_cast<Index>(centre_face.size()); }
  Index segment_count() const { return static_cast<Index>(a.size()); }
};

// Two crossings in a face: one segment. Three: each is joined to the centre. Otherwise nothing.
// Requires: crossing_edge ascending, without repetition.
// Ensures: a crossing has at most two segments, one for each face of its edge; a centre has three.
SegmentGraph face_segments(const Work& work, const MeshView& mesh, std::span<const Index> crossing_edge);

}  // namespace intarsia::kernels
