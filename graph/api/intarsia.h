/// \file
/// Intarsia: patch layouts of triangle meshes along their ridges and valleys (after Cao, Yan, Wonka 2014).
///
/// Spans in, vectors out; only the standard library is needed. No function prints, ends the process, reads the
/// environment or throws. Calls may overlap in any number of threads. The same input and options give the same bits
/// with any number of threads.
///
/// Lengths are in the units of the positions unless said otherwise, angles in radians. Curvature is positive where the
/// surface is convex. "Diagonal" is that of the bounding box.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Version of the header.
#define INTARSIA_VERSION_MAJOR 0
/// Version of the header.
#define INTARSIA_VERSION_MINOR 1
/// Version of the header.
#define INTARSIA_VERSION_PATCH 0

#if defined(__GNUC__)
#define INTARSIA_API __attribute__((visibility("default")))
#else
#define INTARSIA_API
#endif

namespace intarsia {
/// What programs may use; the name is never written out.
inline namespace api {

/// Version of the library that runs, as "0.1.0"; the macros tell that of the header.
INTARSIA_API const char* version() noexcept;

/// How a call ended.
enum class StatusCode : std::uint8_t {
  ok,            ///< done
  degraded,      ///< there is a result, but a guarantee of the layout does not hold (see Layout::report, "checks")
  shortened,     ///< there is a layout; with more time, or on another machine, it would be another one
  bad_argument,  ///< an option or array that makes no sense
  rejected,      ///< well-formed, but no surface that the method can take
  too_large,     ///< more elements than 32-bit numbers can name
  no_memory,     ///< refused by forecast (Options::max_memory), or by the system
  out_of_time,   ///< the time limit came before there was a layout
  cancelled,     ///< the caller asked for it
  internal       ///< a broken promise of the library itself
};

/// Code, and what a person needs to mend the cause.
struct Status {
  StatusCode code = StatusCode::ok;  ///< how it ended
  std::string message;               ///< empty if ok
  std::string stage;                 ///< where it happened, if in a stage
  std::int64_t element = -1;         ///< triangle or vertex of the input that the message speaks of, or -1

  /// ok, degraded or shortened.
  bool has_result() const { return code <= StatusCode::shortened; }
  /// As the program's exit statuses: 0 ok, 1 internal, 2 bad argument, 4 rejected, 5 degraded, 6 limits, 130 cancelled.
  INTARSIA_API int exit_status() const noexcept;
};

/// A value that is complete if status.has_result(), and empty otherwise.
template <class T>
struct Result {
  Status status;  ///< how it ended
  T value;        ///< what came out

  /// Whether there is a result.
  explicit operator bool() const { return status.has_result(); }
  /// The value.
  const T& operator*() const { return value; }
  /// The value.
  const T* operator->() const { return &value; }
};

/// Told how far a call has come: name of the running stage (read surface scale curvature ridges curves network patches
/// layout ...) and the fraction of the whole, 0 to 1, never going back. False cancels the call within a fraction of a
/// second. Called about ten times a second from threads of the library, never twice at once. It must not throw and must
/// not wait for the thread that made the call.
using ProgressFn = std::function<bool(std::string_view stage, double fraction)>;

/// What all calls have in common.
struct RunControl {
  /// That compute, 1024 at most; 0 = every processor this process may use. Results do not depend on it.
  int threads = 0;
  ProgressFn progress;                        ///< may be empty; if not, one more thread calls it and sleeps in between
  const std::atomic<bool>* cancel = nullptr;  ///< if not null: the call ends soon after somebody has set it
};

/// A view of triangles; the arrays must outlive the call.
/// Positions: x, y, z of vertex 0, of vertex 1, ... Triangles: three vertex numbers each, counter-clockwise from
/// outside. Vertices that no triangle uses are allowed. What is no oriented 2-manifold is mended (see Layout::remarks).
struct TriangleMesh {
  std::span<const double> positions;          ///< three numbers a vertex
  std::span<const std::int32_t> triangles;    ///< one of the two
  std::span<const std::int64_t> triangles64;  ///< is empty

  /// Nothing.
  TriangleMesh() = default;
  /// Of arrays that may be vectors.
  TriangleMesh(std::span<const double> xyz, std::span<const std::int32_t> corners)
      : positions(xyz), triangles(corners) {}
  /// The same with wide numbers.
  TriangleMesh(std::span<const double> xyz, std::span<const std::int64_t> corners)
      : positions(xyz), triangles64(corners) {}
};

/// Which rules hold.
enum class Mode : std::uint8_t {
  robust,  ///< what works on real meshes
  paper    ///< the letter of Cao, Yan, Wonka 2014
};

/// How patches of the network become the wanted number.
enum class Subdivide : std::uint8_t {
  automatic,  ///< compact, or faithful in paper mode
  faithful,   ///< the paper's: variational shape approximation inside the patches of the network
  compact,    ///< new seeds and borders where they bring the rebuilt surface nearer
  quality     ///< nearer yet, and more winding
};

/// Options of layout() and features(). A default-made object does everything automatically.
struct INTARSIA_API Options : RunControl {
  int patches = 0;  ///< wanted number of patches; 0 = automatic
  /// Instead of a number: as few patches as rebuild the surface from their borders so well (RMS). "0.2%" (of the
  /// diagonal), "0.01" (units), "0.1e" (mean edges).
  std::string tolerance;
  /// Smaller details get no patches; a length of the same forms.
  std::string min_feature;
  Mode mode = Mode::robust;                    ///< whose rules
  Subdivide subdivide = Subdivide::automatic;  ///< to reach that number
  std::uint64_t seed = 0;                      ///< of the random seeds in paper mode
  std::uint64_t max_memory = 0;                ///< bytes; refuse at once what would need more by forecast; 0 = no limit
  double time_limit = 0;                       ///< seconds; 0 = none
  bool strict = false;                         ///< refuse what would have to be mended
  /// Curves that become borders as they are: x, y, z of at least two points each, on or near the surface.
  std::vector<std::vector<double>> curves;
  /// Regions that stay patches as they are: a number for every triangle, negative where it is free; empty: none. Every
  /// connected piece of a number becomes one patch.
  std::vector<std::int32_t> pins;
  std::map<std::string, double, std::less<>> method;  ///< what set() was given

  /// Sets an option of the method by its name, such as set("smooth.iterations", 20); flags take 0 or 1.
  /// Errors: bad_argument for a name that does not exist (the message has the nearest one), or a value out of range.
  Status set(std::string_view name, double value) noexcept;
};

/// An option of the method.
struct OptionInfo {
  std::string name;       ///< as set() takes it
  std::string help;       ///< one line
  double value = 0;       ///< without set(), in the mode asked for
  double least = 0;       ///< smallest value allowed
  double most = 0;        ///< largest value allowed
  bool is_whole = false;  ///< only whole numbers
};

/// All options of the method, in the order of the program's help.
INTARSIA_API std::vector<OptionInfo> method_options(Mode mode = Mode::robust);

/// Why an arc is there.
enum class ArcKind : std::uint8_t {
  ridge,        ///< a convex feature
  valley,       ///< a concave feature
  sharp,        ///< a crease of the mesh itself
  border,       ///< boundary of the surface
  extension,    ///< made to close the network
  subdivision,  ///< made to divide a patch
  given         ///< by the caller: Options::curves, or the border of a pinned region
};

/// Where arcs meet or end.
struct Node {
  std::array<double, 3> position{};  ///< x, y, z
  std::int32_t vertex = 0;           ///< of Layout::vertices
  std::int32_t degree = 0;           ///< arc ends here
  bool is_artificial = false;        ///< only marks the start of a loop that has no corner
};

/// A curve between two nodes, or closed.
struct Arc {
  ArcKind kind = ArcKind::ridge;  ///< of most of its length
  std::int32_t start = 0;         ///< node where it begins
  std::int32_t end = 0;           ///< node where it ends
  std::int32_t left = -1;         ///< patch on the left along the arc, -1 outside the surface
  std::int32_t right = -1;        ///< patch on the right
  double length = 0;              ///< along the surface
  double strength = 0;            ///< mean angle between its two sides, radians; 0 where unknown
};

/// The curves of a layout as a graph.
struct Network {
  std::vector<Node> nodes;                ///< ends and crossings
  std::vector<Arc> arcs;                  ///< curves between them
  std::vector<std::int64_t> arc_offset;   ///< arcs + 1 values: arc a has arc_vertex[arc_offset[a] .. arc_offset[a + 1])
  std::vector<std::int32_t> arc_vertex;   ///< of Layout::vertices, both ends included; a closed arc repeats its first
  std::vector<std::int32_t> loop_patch;   ///< per border loop its patch, ascending
  std::vector<std::int64_t> loop_offset;  ///< loops + 1 values, into the next two
  std::vector<std::int32_t> loop_arc;     ///< arcs in cyclic order, the patch on their left
  std::vector<std::uint8_t> loop_is_forward;  ///< 1: the arc is walked from start to end
};

/// A feature that separates nothing: no part of the network.
struct InteriorCurve {
  ArcKind kind = ArcKind::ridge;  ///< ridge, valley or sharp
  std::vector<double> points;     ///< x, y, z of each
};

/// What is known of a patch.
struct Patch {
  std::int64_t triangles = 0;     ///< of the layout mesh
  double area = 0;                ///< of its triangles
  double perimeter = 0;           ///< of all border loops
  double compactness = 0;         ///< perimeter^2 / (4 pi area): 1 for a flat disc
  double flatness = 0;            ///< |sum of area times normal| / area: 1 if flat
  std::int32_t loops = 0;         ///< border loops
  std::int32_t filled_holes = 0;  ///< short borders of the surface inside it, which are not counted as loops
  bool is_disc = false;           ///< one loop, no handle, touching itself nowhere
};

/// Something a user should know although there is a result.
struct Remark {
  std::string code;         ///< a stable word with hyphens
  std::string stage;        ///< that noticed it
  std::string message;      ///< for people
  std::uint64_t count = 0;  ///< elements concerned
};

/// A patch layout. Patches are numbered 0 .. patches.size() - 1.
struct Layout {
  std::vector<std::int32_t> labels;  ///< per input triangle: the patch with most of it; -1 if cleaning left it out
  /// x, y, z of the layout mesh: a refinement of the input whose edges carry all curves. The input's vertices come
  /// first, with their numbers and coordinates.
  std::vector<double> vertices;
  std::vector<std::int32_t> triangles;        ///< three vertices each
  std::vector<std::int32_t> triangle_patch;   ///< per triangle of the layout mesh
  std::vector<std::int32_t> triangle_parent;  ///< input triangle it lies in, ascending
  Network network;                            ///< the curves that bound patches
  std::vector<InteriorCurve> interior;        ///< those that do not
  std::vector<Patch> patches;                 ///< in the order of their numbers
  std::vector<Remark> remarks;                ///< what was mended, and what else is worth knowing
  double diagonal = 0;                        ///< of the input's bounding box
  std::string hash;                           ///< of the layout's bits, 16 hex digits
  std::string report;                         ///< JSON, schema intarsia-report (docs/formats.md)
};

/// A patch layout of a triangle mesh.
/// Errors: bad_argument, rejected, too_large, no_memory, out_of_time, cancelled.
/// Source: Cao, Yan, Wonka, "Patch layouts from feature graphs", 2014; what differs is in docs/paper_map.md.
INTARSIA_API Result<Layout> layout(const TriangleMesh& mesh, const Options& options = {}) noexcept;

/// Per-vertex fields, in the input's numbering: n values, or n times 3 or 6. Vertices that no triangle uses, or that
/// cleaning dropped, have zeros and status 3.
struct Features {
  std::vector<double> normals;         ///< n x 3, unit
  std::vector<double> variation;       ///< n x 6: surface variation omega of rings 1 to 6 (the paper's Eq. 4 to 6)
  std::vector<double> kmax;            ///< larger principal curvature, 1 / unit
  std::vector<double> kmin;            ///< smaller principal curvature
  std::vector<double> tmax;            ///< n x 3: direction of kmax, unit, up to sign
  std::vector<double> tmin;            ///< n x 3: direction of kmin
  std::vector<double> emax;            ///< extremality (Eq. 2, 3): derivative of kmax along tmax, 1 / unit^2
  std::vector<double> emin;            ///< derivative of kmin along tmin
  std::vector<std::int32_t> scale;     ///< ring chosen by the rule, 1 to 6
  std::vector<std::int32_t> fit_ring;  ///< ring that was fitted; above 6 a disc on coarse samples
  std::vector<std::int32_t> status;    ///< 0 full cubic, 1 ring grown, 2 quadratic only, 3 invalid
};

/// Scale, curvature and extremality of every vertex. Options::patches and the like are not looked at.
/// Errors: as layout(); out_of_time if there are no features within the time limit (nothing can be left out for it).
INTARSIA_API Result<Features> features(const TriangleMesh& mesh, const Options& options = {}) noexcept;

/// Options of distance().
struct DistanceOptions : RunControl {
  std::uint64_t samples = 1'000'000;  ///< on both surfaces together; every triangle gets at least one
  bool keep_samples = false;          ///< fill Distance::sample_*
};

/// From one surface to the other.
struct DistanceSide {
  double max = 0;                    ///< largest distance found
  double bound = 0;                  ///< no point of the surface is farther
  double mean = 0;                   ///< over the area
  double rms = 0;                    ///< root mean square over the area
  double area = 0;                   ///< of the surface it is measured from
  std::uint64_t samples = 0;         ///< on that surface
  std::array<double, 3> worst{};     ///< where max was found
  std::int32_t worst_triangle = -1;  ///< on which triangle
};

/// How far two surfaces are apart.
struct Distance {
  double hausdorff = 0;                       ///< the larger of the two directions, as the next two
  double mean = 0;                            ///< over the area
  double rms = 0;                             ///< root mean square over the area
  double diagonal = 0;                        ///< of A; divide by it for relative numbers
  DistanceSide forward;                       ///< from A to B
  DistanceSide backward;                      ///< from B to A
  std::vector<double> vertex_distance;        ///< per vertex of A; 0 if no triangle uses it
  std::vector<double> triangle_rms;           ///< per triangle of A
  std::vector<double> triangle_max;           ///< per triangle of A
  std::vector<double> sample_point;           ///< x, y, z of the samples on A, if they are kept
  std::vector<double> sample_distance;        ///< of each
  std::vector<std::int32_t> sample_triangle;  ///< of A, on which it lies
};

/// Distance between two triangle meshes, by samples whose order and number depend on the input alone.
/// Errors: bad_argument; rejected if a surface has no area; cancelled.
/// Source: Cignoni, Rocchini, Scopigno 1998 (Metro).
INTARSIA_API Result<Distance> distance(const TriangleMesh& a, const TriangleMesh& b,
                                       const DistanceOptions& options = {}) noexcept;

/// Options of evaluate().
struct EvaluateOptions : RunControl {
  std::uint64_t samples = 1'000'000;  ///< of the distance
  bool triangulated = true;           ///< optimal triangulations of the patches' borders
  bool transfinite = true;            ///< patches from the curves alone
  bool filled = true;                 ///< smooth fills that also use the input's normals along the curves
  bool smooth = false;                ///< evaluate() of labels: smooth their borders as layout() does
};

/// A surface rebuilt from the curves of a layout, and how far the input is from it.
struct Rebuilt {
  bool was_made = false;                     ///< false: not asked for, and empty
  std::vector<double> vertices;              ///< x, y, z
  std::vector<std::int32_t> triangles;       ///< three vertices each
  std::vector<std::int32_t> triangle_patch;  ///< per triangle, ascending
  double hausdorff = 0;                      ///< the larger of the two directions, as the next two
  double mean = 0;                           ///< over the area
  double rms = 0;                            ///< root mean square over the area
  DistanceSide forward;                      ///< from the input to it
  DistanceSide backward;                     ///< from it to the input
  std::vector<double> patch_rms;             ///< per patch, over the input's triangles in it
  std::vector<double> patch_max;             ///< per patch
  std::int32_t failed = 0;                   ///< patches left out, or fallen back to the triangulation
};

/// How well a layout's curves alone describe the surface: the paper's criterion.
struct Evaluation {
  Rebuilt triangulated;             ///< optimal triangulations of the borders
  Rebuilt transfinite;              ///< patches from the curves alone
  Rebuilt filled;                   ///< smooth fills that also use the input's normals along the curves
  std::vector<double> compactness;  ///< per patch, see Patch::compactness
  std::int32_t patches = 0;         ///< how many
  std::int32_t not_discs = 0;       ///< patches with other than one loop
  double diagonal = 0;              ///< of the input's bounding box
  std::string report;               ///< JSON, schema intarsia-eval (docs/formats.md)
};

/// Rebuilds the surface from the network of `layout`, which must be of this mesh.
/// Errors: bad_argument if they do not fit together; rejected if there are no curves; cancelled.
INTARSIA_API Result<Evaluation> evaluate(const TriangleMesh& mesh, const Layout& layout,
                                         const EvaluateOptions& options = {}) noexcept;

/// The same for any labels, one per triangle: connected pieces of equal labels are patches.
INTARSIA_API Result<Evaluation> evaluate(const TriangleMesh& mesh, std::span<const std::int32_t> labels,
                                         const EvaluateOptions& options = {}) noexcept;

}  // namespace api
}  // namespace intarsia
