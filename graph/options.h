// Every option of the method in one place: the kernels' own structs, gathered. Defaults live in the kernels.
#pragma once

#include <cstdint>

#include "engine/base/length.h"
#include "kernels/cells/cell_complex.h"
#include "kernels/cells/group.h"
#include "kernels/cells/swap_cells.h"
#include "kernels/curvature/compute_curvature.h"
#include "kernels/curves/connect_features.h"
#include "kernels/denoise/denoise.h"
#include "kernels/denoise/remove_details.h"
#include "kernels/layout/check_layout.h"
#include "kernels/layout/cross_edges.h"
#include "kernels/layout/smooth_boundaries.h"
#include "kernels/network/direction_field.h"
#include "kernels/network/extension_cost.h"
#include "kernels/network/snap_curves.h"
#include "kernels/patches/even_cells.h"
#include "kernels/patches/subdivide.h"
#include "kernels/ridges/sharp_edges.h"
#include "kernels/ridges/trace_ridges.h"
#include "kernels/scale/compute_scale.h"
#include "kernels/surface/clean_soup.h"
#include "kernels/surface/split_long_edges.h"

namespace intarsia::graph {

enum class Mode : std::uint8_t { robust, paper };

// How the network's patches become the wanted number.
enum class SubdivideForm : std::uint8_t {
  faithful,  // the paper's: variational shape approximation inside each patch of the network
  compact,   // over-segmented by new seeds where the reconstruction is worst, merged by reconstruction error, borders
             // refined by cells; winding borders cost as much as errors
  quality,   // the same from a richer network, with little regard for winding borders
};

struct RefineOptions {
  Real compact_perimeter = 1.15;  // share of sum of P^2 / (4 pi) in the cost, against the errors at the start
  Real quality_perimeter = 0.24;
  Real over_segment = 3;        // times the wanted number, then merged
  int rounds = 8;               // of more seeds, merged back and refined again, while that helps
  Real reconsider = 1.5;        // times the wanted number in such a round
  Index judge_points = 100;     // points around a patch when such a round is judged
  kernels::GroupOptions group;  // its perimeter and discs are set from the above
  kernels::CellOptions cell;
  kernels::EvenCellOptions even;
  kernels::SwapOptions swap;
};

// How strong a feature must be to enter the network.
struct ChoiceOptions {
  Real min_saliency = 0.04;   // integral of the turn angle along a connected component, radians x diagonals
  Real weakest = 0.01;        // lowest threshold a budget may go down to
  Index most_patches = 60;    // automatic: a higher threshold where the network would enclose more than this
  Real budget = 0.8;          // with a wanted number N: the network encloses at most this share of N
  Real quality_budget = 1.5;  // the same for quality: what the network has too many is merged
  int steps = 7;              // bisection steps on the logarithm of the threshold
};

struct LayoutOptions {
  Mode mode = Mode::robust;
  SubdivideForm form = SubdivideForm::compact;
  std::uint64_t seed = 0;  // paper mode: random seeds of the subdivision
  Index patches = 0;       // wanted number of patches; 0 = automatic
  Length tolerance;  // instead of a number: as few patches as rebuild the surface so well (RMS); 0 = not asked for
  kernels::CleanOptions clean;
  // Diagonals. Lengths of the method that are given in mean edges (how far ends look back, which strips are thin) end
  // here on fine meshes, so that a layout does not depend on how finely the surface was sampled.
  Real finest_detail = 0.004;
  bool split_uneven = true;
  kernels::SplitEdgesOptions split_edges;
  bool filter_noise = true;
  kernels::DenoiseOptions denoise;
  Length min_feature;  // smaller details are removed before features are looked for; 0 = none
  kernels::DetailOptions details;
  bool barrier = true;  // fits do not cross sharp edges
  kernels::SharpOptions sharp;
  kernels::ScaleOptions scale;
  int fixed_ring = 0;  // 1 .. 6: every vertex is fitted in this ring, to show what the choice is for; 0 = chosen
  kernels::CurvatureOptions curvature;
  kernels::RidgeOptions ridges;
  kernels::CurveOptions curves;
  ChoiceOptions choice;
  kernels::SnapOptions snap;
  kernels::DirectionFieldOptions direction;
  kernels::ExtensionOptions extension;
  kernels::SubdivideOptions subdivide;
  RefineOptions refine;
  kernels::SmoothOptions smooth;
  bool guard_smoothing = true;  // borders move half an edge at most where more would spoil the reconstruction
  kernels::CrossOptions cross;
  kernels::CheckOptions check;
};

// The stages up to one of these, in order.
enum class StageGroup : std::uint8_t { features, curves, network, patches, layout };

// What these stages may see of the options: what belongs to later ones is put back to its default, so that neither a
// stage's output nor its checkpoint can depend on it. New options are seen by all until they are listed there.
LayoutOptions options_up_to(StageGroup group, LayoutOptions options);

LayoutOptions robust_options();
// The paper's letter where a value of ours differs.
LayoutOptions paper_options(std::uint64_t seed);

}  // namespace intarsia::graph
