// The border of a patch as polylines, and how well the patch is rebuilt from it: the error that subdivision looks at.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/space/bent_triangles.h"
#include "engine/space/few_triangles.h"
#include "engine/space/triangulate_loops.h"

namespace intarsia {

// Loops of pieces of points. Pieces end at corners, which are kept when the loops are sampled; the last point of a
// piece is the first one of the next.
struct Outline {
  std::vector<Vec3> point;
  std::vector<Vec3> inward;     // per point: where the patch goes from there, of unit length or zero; or empty
  std::vector<Index> piece{0};  // piece -> first point; one more than pieces
  std::vector<Index> loop{0};   // loop -> first piece; one more than loops

  Index loops() const { return static_cast<Index>(loop.size() - 1); }
  void clear() {
    point.clear(), inward.clear();
    piece.assign(1, 0), loop.assign(1, 0);
  }
  // After the points of a piece (both ends included) have been appended to `point`.
  void end_piece() { piece.push_back(static_cast<Index>(point.size())); }
  void end_loop() { loop.push_back(static_cast<Index>(piece.size() - 1)); }
  Real length() const;
};

// Points of a patch that stand for its area.
struct WeightedPoints {
  std::vector<Vec3> point;
  std::vector<Real> weight;

  void clear() { point.clear(), weight.clear(); }
  void add(const Vec3& p, Real w) { point.push_back(p), weight.push_back(w); }
};

struct OutlineOptions {
  Index loop_points = 48;  // even steps of the longest loop; all loops together at most about twice as many
  // The same with a smaller number of points, 0 = not asked; the worse of both counts. Some borders have two very
  // different triangulations of nearly equal cost: which one wins must not depend on where the samples fall.
  Index second_points = 37;
  Real second_bend = 0.5;  // times the weight of bends in that one: lids across a half-pipe win too early there
  // Weight of the squared distance to the bent triangulation (see BentTriangles) of outlines that know their inward
  // directions, beside that to the flat one; 0 = not asked.
  Real bent = 0.1;
  LoopsOptions loops{.polygon = {.exact = false}, .bridges = 1, .combinations = 1};
};

struct OutlineScratch {
  std::vector<Vec3> point, inward;
  BentTriangles bent;
  std::vector<Index> offset;
  PolygonScratch polygon;
  FewTriangles triangles;
};

// Sum of weight times squared distance to the triangulation of the sampled loops; an estimate of the integral of the
// squared distance over the patch. Without a triangulation (or without loops) the distance to the mean of the points.
// coarse: what coarse_outline_error() says of the same, where it has been asked.
Real outline_error(const Outline& outline, const WeightedPoints& samples, const OutlineOptions& options,
                   OutlineScratch& scratch, std::optional<Real> coarse = {});

// By the sampling that costs less alone: no more than outline_error(), for callers that may then stop asking.
// Negative: no triangulation.
Real coarse_outline_error(const Outline& outline, const WeightedPoints& samples, const OutlineOptions& options,
                          OutlineScratch& scratch);

// Steps of averaging the inner points of a polyline with their neighbours, ends fixed: takes out the zigzag of mesh
// edges.
void smooth_polyline(std::span<Vec3> point, int steps);

}  // namespace intarsia
