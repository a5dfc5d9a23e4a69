// How much of one set of lines runs beside another: precision and recall of networks.
#pragma once

#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct Segments {
  Vec3Array point;
  std::vector<Index> end;  // two per segment: point ids

  Index count() const { return static_cast<Index>(end.size() / 2); }
};

struct LineMatch {
  Real length = 0;  // of all lines
  Real near = 0;    // of what lies within the tolerance of the other lines
  Real share() const { return length > 0 ? near / length : 0; }
};

// Exact distances of points on `lines`, at steps of a sixteenth of the tolerance or less, to the segments of `other`.
LineMatch match_lines(const Work& work, const Segments& lines, const Segments& other, Real tolerance);

// How far lines are from others.
struct LineDistance {
  Real length = 0;                                   // of the lines
  Real mean = 0, median = 0, high = 0, largest = 0;  // by length; high: 90 % are nearer
};

// Distances of points on `lines`, not farther apart than `step`, to the segments of `other`.
// Requires: both have segments, step > 0.
LineDistance line_distance(const Work& work, const Segments& lines, const Segments& other, Real step);

}  // namespace intarsia::kernels
