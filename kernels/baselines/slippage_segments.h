// Segmentation by slippage (after Gelfand, Guibas 2004): pieces that slip along themselves the same way, merged until K
// are left. The score of a merge is our own reading; the original's exact scoring is not known to us.
#pragma once

#include <vector>

#include "kernels/baselines/face_graph.h"

namespace intarsia::kernels {

struct SlippageOptions {
  Index patches = 40;
  Index pieces = 6000;  // the surface is looked at in about so many balls of faces
  Real limit = 0.05;    // of value / greatest value: below it a motion slips
  Real lost = 0.1;      // most that one motion costs in a merge, same share
  Real stable = 0.25;   // neighbourhoods grow until the condition number changes by less than this share
  Real growth = 0.01;   // first patches grow as long as their motions cost less than this share of the greatest value
};

// Ensures: every region 0 .. count - 1 connected; count = patches where the surface allows.
PatchLabels segment_by_slippage(const Work& work, const FaceGraph& graph, const SlippageOptions& options);

}  // namespace intarsia::kernels
