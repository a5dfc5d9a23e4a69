// The one list of named options: command-line flags, help, the report and option hashes are all made from it. Defaults
// and units are in the kernels' structs.
#pragma once

#include "graph/options.h"

namespace intarsia::graph {

// v(name, variable, help, least, most); variable is Real, int, Index, std::uint8_t or bool.
template <class Options, class V>
void visit_options(Options& o, V&& v) {
  v("clean.weld", o.clean.weld_distance, "border vertices nearer than this are joined, diagonals; 0 = none", 0.0, 0.01);
  v("clean.specks", o.clean.speck_area, "pieces below this share of the area are left out; 0 = none", 0.0, 0.5);
  v("clean.outward", o.clean.turn_outward, "turn closed pieces that face inwards", 0, 1);
  v("network.detail", o.finest_detail, "lengths in mean edges take no shorter edges than this, diagonals", 0.0, 0.1);
  v("uneven.split", o.split_uneven, "divide long edges inside where triangles are very uneven (CAD exports)", 0, 1);
  v("uneven.variation", o.split_edges.uneven, "standard deviation / mean of edge lengths of uneven triangles", 0.0,
    100.0);
  v("uneven.length", o.split_edges.length, "longest edge after dividing, diagonals", 1e-4, 1.0);
  v("noise.filter", o.filter_noise, "look for features on a filtered copy of a noisy mesh", 0, 1);
  v("noise.least", o.denoise.least, "roughness of a noisy mesh: angle between neighbouring triangles, radians", 0.0,
    3.2);
  v("noise.sigma", o.denoise.filter.sigma, "differences of normals that the filter keeps", 0.01, 2.0);
  v("noise.iterations", o.denoise.filter.iterations, "steps of the normal filter", 0, 200);
  v("noise.rounds", o.denoise.rounds, "rounds of filtering normals and fitting positions", 1, 20);
  v("sharp.strong", o.sharp.strong, "dihedral turn that makes a mesh edge sharp, radians", 0.1, 3.1);
  v("sharp.weak", o.sharp.weak, "turn of an edge that continues a sharp chain, radians", 0.05, 3.1);
  v("sharp.min-length", o.sharp.min_length, "shortest connected set of sharp edges, diagonals", 0.0, 1.0);
  v("sharp.barrier", o.barrier, "fits do not cross sharp edges", 0, 1);
  v("scale.flat", o.scale.select.flat, "surface variation below which a ring is flat (omega_-)", 0.0, 2.0);
  v("scale.bent", o.scale.select.bent, "surface variation of a well chosen ring (omega_+)", 0.0, 2.0);
  v("scale.slack", o.scale.select.slack, "a smaller ring wins within this distance of omega_+", 0.0, 1.0);
  v("scale.discs", o.scale.discs, "look beyond six rings where they are flat", 0, 1);
  v("scale.largest-disc", o.scale.largest_disc, "largest disc looked at, diagonals", 0.001, 0.15);
  v("scale.fixed", o.fixed_ring, "the same ring for every vertex; 0 = chosen for each", 0, 6);
  v("fit.normal-gate", o.curvature.fit.normal_gate, "least cosine between normals of a fit point", 0.0, 1.0);
  v("fit.refine-normals", o.curvature.fit.refine_normals, "second pass of normals before the fit", 0, 1);
  v("fit.anisotropy", o.curvature.anisotropy, "least relative difference of principal curvatures", 0.0, 1.0);
  v("curves.turn-radius", o.curves.turn.radius, "radius of the turn angle, diagonals (rho)", 0.001, 0.2);
  v("curves.join-radius", o.curves.join.radius, "largest gap joined, mean edges", 0.0, 20.0);
  v("curves.min-turn", o.curves.filter.min_turn, "mean turn angle of a feature, radians", 0.0, 3.0);
  v("curves.min-length", o.curves.filter.min_length, "shortest feature, diagonals", 0.0, 2.0);
  v("curves.min-sharpness", o.curves.filter.min_sharpness, "least -k''/k^3 of a feature", -10.0, 100.0);
  v("curves.min-saliency", o.choice.min_saliency, "integral of the turn angle along a feature", 0.0, 100.0);
  v("length", o.curves.paper_filter.min_length, "paper mode: shortest curve, diagonals (L)", 0.0, 10.0);
  v("curvature", o.curves.paper_filter.min_curvature, "paper mode: least RMS curvature, 1 / diagonal (R)", 0.0, 1e9);
  v("strength", o.curves.paper_filter.min_strength, "paper mode: least curve strength (T)", 0.0, 1e12);
  v("network.most-patches", o.choice.most_patches, "automatic: raise the threshold beyond so many patches", 1, 1e9);
  v("network.budget", o.choice.budget, "share of --patches that the network itself may enclose", 0.0, 4.0);
  v("network.quality-budget", o.choice.quality_budget, "the same for --subdivide quality", 0.0, 4.0);
  v("network.snap", o.snap.snap, "edge points nearer to a vertex than this share of the edge move there", 0.0, 0.5);
  v("extend.cone", o.extension.cone, "degrees between the ideal direction and a step", 10.0, 90.0);
  v("extend.history", o.extension.history, "points whose principal directions are averaged (m)", 1, 50);
  v("extend.feedback", o.extension.feedback, "pull towards the ideal curve (kappa)", 0.0, 4.0);
  v("extend.max-length", o.extension.max_length, "longest extension of an end, diagonals", 0.0, 10.0);
  v("extend.meet", o.extension.meet, "mean edges at which a curve ends on another", 1.0, 10.0);
  v("patches.max-spread", o.subdivide.split.max_spread, "normal spread that divides a patch, radians", 0.1, 3.1);
  v("patches.trim", o.subdivide.split.trim, "share of the area left out at each end of the spread", 0.0, 0.45);
  v("patches.tiny-area", o.subdivide.merge.tiny_area, "smaller shares of the surface are merged", 0.0, 0.5);
  v("patches.discs", o.subdivide.discs, "cut patches until each is a disc", 0, 1);
  v("refine.compact-perimeter", o.refine.compact_perimeter, "compact: weight of P^2 / 4 pi against error", 0.0, 100.0);
  v("refine.quality-perimeter", o.refine.quality_perimeter, "quality: weight of P^2 / 4 pi against error", 0.0, 100.0);
  v("refine.bent", o.refine.group.outline.bent, "weight of the error of patches bent to the normals at their borders",
    0.0, 100.0);
  v("refine.loop-points", o.refine.group.outline.loop_points, "points around a patch", Index{12}, Index{1000});
  v("refine.salience", o.refine.group.salience, "price of features inside patches", 0.0, 100.0);
  v("refine.over-segment", o.refine.over_segment, "patches before merging, times --patches", 1.0, 10.0);
  v("refine.rounds", o.refine.rounds, "more seeds, merged back and refined, so many times while it helps", 0, 100);
  v("refine.reconsider", o.refine.reconsider, "times --patches in such a round", 1.0, 10.0);
  v("refine.judge-points", o.refine.judge_points, "points around a patch when such a round is judged", Index{12},
    Index{400});
  v("refine.cells", o.refine.even.per_patch, "cells of an average patch that may change sides", 2, 200);
  v("refine.sweeps", o.refine.swap.sweeps, "moves per cell at most; 0 = borders are not refined", 0, 100);
  v("smooth.guard", o.guard_smoothing, "smooth borders less where it spoils the reconstruction", 0, 1);
  v("smooth.iterations", o.smooth.iterations, "steps of boundary smoothing", 0, 1000);
  v("smooth.length-weight", o.smooth.length_weight, "length against alignment in Eq. 8 (lambda)", 0.001, 1000.0);
  v("smooth.reach", o.smooth.free_reach, "how far a free border may move, mean edges", 0.0, 10.0);
  v("smooth.feature-reach", o.smooth.feature_reach, "how far a feature may move, mean edges", 0.0, 10.0);
}

}  // namespace intarsia::graph
