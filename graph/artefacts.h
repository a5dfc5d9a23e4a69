// What flows between the stages. Each is plain data, immutable once published, and freed after its last reader.
// Every artefact has hash_of (its bits), bytes_of (memory it holds) and items_of (what it counts).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/data/curve_network.h"
#include "engine/data/feature_curves.h"
#include "engine/data/fields.h"
#include "engine/data/layout_graph.h"
#include "engine/data/mesh.h"
#include "engine/data/patch_labels.h"
#include "engine/run/record.h"
#include "kernels/layout/check_layout.h"
#include "kernels/layout/match_labels.h"
#include "kernels/layout/principal_lines.h"
#include "kernels/layout/smooth_boundaries.h"
#include "kernels/network/direction_field.h"
#include "kernels/ridges/sharp_edges.h"
#include "kernels/scale/compute_scale.h"
#include "kernels/surface/canonical_order.h"
#include "kernels/surface/clean_soup.h"
#include "kernels/surface/normals.h"

namespace intarsia {

class ArtefactReader;
class ArtefactWriter;

std::uint64_t hash_of(const Soup& a);
std::uint64_t exact_hash_of(const Soup& a);
std::size_t bytes_of(const Soup& a);
std::size_t items_of(const Soup& a);  // faces

}  // namespace intarsia

namespace intarsia::graph {

// What was mended to make a surface of the input, as far as it is still wanted. Vertices are in the surface's numbers,
// triangles in the input's.
struct Mended {
  std::array<kernels::Fault, kernels::kCleanActions> done;  // by CleanAction
  Index speck_pieces = 0;
  std::vector<Index> copy;                 // vertices that are further copies of an input vertex, or new: ascending
  Real split_length = 0;                   // longest edge that uneven triangles were divided to, diagonals; 0: none
  std::vector<Index> twin, twin_of;        // triangles that were dropped because they repeat others
  std::vector<Index> welded, welded_into;  // vertices of the input that became others
};

// mesh -> surface: the input, mended, in canonical numbers and diagonal 1, with connectivity and normals.
struct Surface {
  Mesh mesh;
  kernels::SurfaceOrder order;  // canonical -> input numbers; several vertices of one number where fans were parted,
                                // several faces where triangles were divided, kNone for vertices between
  Mended mended;
  Index input_triangles = 0;
  kernels::BoxTransform box;
  Vec3Array face_normal;  // unit, 0 for faces without area
  Real area = 0;
  Real mean_edge = 0;             // h
  Real detail = 0;                // what is small: h, but not less than 0.004 however fine the sampling
  Real rough = 0;                 // angle between neighbouring triangles, see kernels/denoise/roughness.h
  bool noisy = false;             // and therefore filtered
  Vec3Array given;                // input positions of the vertices, if the mesh's are filtered; else empty
  bool single_precision = false;  // every input coordinate is a float: flat parts carry its rounding
};

// surface -> scale
struct Scale {
  kernels::ScaleFields fields;
};

// surface -> sharp: creases of the mesh itself.
struct Sharp {
  kernels::SharpEdges edges;
};

// scale -> curvature
struct Curvature {
  CurvatureFields fields;
};

// curvature -> directions: what the network is extended by. With the lines all that is wanted of the curvature once
// there are curves; the rest is freed then.
struct Directions {
  kernels::DirectionField field;
  Vec3Array normal;  // unit, refined
};

// curvature -> lines: what borders are smoothed by.
struct Lines {
  kernels::PrincipalLines lines;
};

// curvature -> ridges: one channel's raw lines. Twice in a run: ridges and valleys.
struct Ridges {
  FeatureCurves curves;
};

// ridges -> curves: tidied, joined and ranked; everything that may still pass a threshold.
struct Curves {
  FeatureCurves curves;
};

// surface -> guides: what the user wants kept, on the surface. Empty in most runs.
struct Guides {
  CurveNetwork curves;     // kind given: polylines, and the borders of pinned regions
  std::vector<Index> pin;  // per face: pinned region, kNone where it is in none; empty: none is pinned
  Index regions = 0;       // pinned, connected or not
  Real farthest = 0;       // of the polylines' points from the surface, diagonals
  Index gaps = 0;          // places where a polyline could not go on, at holes; it begins anew behind them
};

// curves -> goal: how many patches are wanted.
struct Goal {
  Index patches = 0;  // 0: automatic
  Real rms = 0;       // deviation of the rebuilt surface at that number, diagonals; 0 where nobody asked
  Index tries = 0;    // layouts made to find it
  std::vector<std::string> warnings;
};

// curves -> network: the features that stand out, embedded, and extended until they close.
struct Network {
  RefinedMesh refined;    // carries the closed network
  CurveNetwork features;  // the chosen curves before extension, on the surface's mesh
  std::vector<std::uint8_t> feature_concave;
  std::vector<Index> feature_edge;  // refined edges of the chosen curves, ascending
  Real min_saliency = 0;            // threshold that was used
  Index patches = 0;                // after the tiny merge
  Index ends = 0, met = 0, bridged = 0, dead = 0;
  std::vector<std::uint8_t> locked;  // per refined face: 1 inside pinned regions; empty: there are none
  std::vector<std::string> warnings;
};

// network -> patches: final labels of the network's refined faces.
struct Patches {
  PatchLabels labels;
  std::vector<std::uint8_t> on_network;
  std::vector<CurveKind> edge_kind;
  Index network_patches = 0, merged_patches = 0;
  std::vector<std::string> warnings;
};

// patches -> smoothing: where the borders of the patches are to go, and all that is still wanted of the network: its
// refined mesh may be freed before the next one is made.
struct Smoothing {
  LayoutGraph graph;             // of the patches as they came, on the network's refined mesh
  kernels::SmoothedArcs arcs;    // their smoothed places
  kernels::SmoothedArcs gentle;  // places nearer to where they were, for patches that the others spoil
  kernels::LabelShares shares;   // the patches on the faces of the surface
  std::vector<Real> error;       // reconstruction error per patch; empty, as `gentle`, if smoothing is not guarded
  CurveNetwork interior;         // chosen features that separate nothing, on the surface's mesh
  RefinedMesh refined;           // the network's, without its mesh
  Network network;               // the network again; of its refined mesh only the edges that carry it, for pictures
};

// smoothing -> layout: smoothed borders, embedded in the surface again, as a graph; checked.
struct Layout {
  RefinedMesh refined;
  PatchLabels labels;  // per refined face
  PatchTable table;
  LayoutGraph graph;
  kernels::LayoutChecks checks;
  std::vector<Index> face_patch;  // per face of the surface: the patch with most of it
  CurveNetwork interior;          // chosen features that separate nothing, on the surface's mesh
  Index kept_chains = 0;          // arcs that were not smoothed because that would have broken the layout
  std::vector<std::string> warnings;
};

std::vector<Warning> warnings_of(const Surface& a);  // one for each kind of mending
std::vector<Warning> warnings_of(const Guides& a);   // holes in the way, points far from the surface
std::vector<Warning> warnings_of(const Goal& a);
std::vector<Warning> warnings_of(const Network& a);
std::vector<Warning> warnings_of(const Patches& a);
std::vector<Warning> warnings_of(const Layout& a);

std::uint64_t hash_of(const Surface& a);
std::uint64_t hash_of(const Scale& a);
std::uint64_t hash_of(const Sharp& a);
std::uint64_t hash_of(const Curvature& a);
std::uint64_t hash_of(const Directions& a);
std::uint64_t hash_of(const Lines& a);
std::uint64_t hash_of(const Ridges& a);
std::uint64_t hash_of(const Curves& a);
std::uint64_t hash_of(const Guides& a);
std::uint64_t hash_of(const Goal& a);
std::uint64_t hash_of(const Network& a);
std::uint64_t hash_of(const Patches& a);
std::uint64_t hash_of(const Smoothing& a);
std::uint64_t hash_of(const Layout& a);

std::size_t bytes_of(const Surface& a);
std::size_t bytes_of(const Scale& a);
std::size_t bytes_of(const Sharp& a);
std::size_t bytes_of(const Curvature& a);
std::size_t bytes_of(const Directions& a);
std::size_t bytes_of(const Lines& a);
std::size_t bytes_of(const Ridges& a);
std::size_t bytes_of(const Curves& a);
std::size_t bytes_of(const Guides& a);
std::size_t bytes_of(const Goal& a);
std::size_t bytes_of(const Network& a);
std::size_t bytes_of(const Patches& a);
std::size_t bytes_of(const Smoothing& a);
std::size_t bytes_of(const Layout& a);

std::size_t items_of(const Surface& a);     // faces
std::size_t items_of(const Scale& a);       // vertices
std::size_t items_of(const Sharp& a);       // curves
std::size_t items_of(const Curvature& a);   // vertices
std::size_t items_of(const Directions& a);  // vertices
std::size_t items_of(const Lines& a);       // vertices
std::size_t items_of(const Ridges& a);      // curves
std::size_t items_of(const Curves& a);      // curves
std::size_t items_of(const Guides& a);      // curves
std::size_t items_of(const Goal& a);        // patches
std::size_t items_of(const Network& a);     // patches
std::size_t items_of(const Patches& a);     // patches
std::size_t items_of(const Smoothing& a);   // arcs
std::size_t items_of(const Layout& a);      // patches

// All fields, into checkpoints and back.
void write_to(ArtefactWriter& to, const Surface& a);
void write_to(ArtefactWriter& to, const Scale& a);
void write_to(ArtefactWriter& to, const Sharp& a);
void write_to(ArtefactWriter& to, const Curvature& a);
void write_to(ArtefactWriter& to, const Directions& a);
void write_to(ArtefactWriter& to, const Lines& a);
void write_to(ArtefactWriter& to, const Ridges& a);
void write_to(ArtefactWriter& to, const Curves& a);
void write_to(ArtefactWriter& to, const Guides& a);
void write_to(ArtefactWriter& to, const Goal& a);
void write_to(ArtefactWriter& to, const Network& a);
void write_to(ArtefactWriter& to, const Patches& a);
void write_to(ArtefactWriter& to, const Smoothing& a);
void write_to(ArtefactWriter& to, const Layout& a);

void read_from(ArtefactReader& from, Surface& a);
void read_from(ArtefactReader& from, Scale& a);
void read_from(ArtefactReader& from, Sharp& a);
void read_from(ArtefactReader& from, Curvature& a);
void read_from(ArtefactReader& from, Directions& a);
void read_from(ArtefactReader& from, Lines& a);
void read_from(ArtefactReader& from, Ridges& a);
void read_from(ArtefactReader& from, Curves& a);
void read_from(ArtefactReader& from, Guides& a);
void read_from(ArtefactReader& from, Goal& a);
void read_from(ArtefactReader& from, Network& a);
void read_from(ArtefactReader& from, Patches& a);
void read_from(ArtefactReader& from, Smoothing& a);
void read_from(ArtefactReader& from, Layout& a);

}  // namespace intarsia::graph
