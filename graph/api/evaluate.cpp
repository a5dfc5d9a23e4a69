#include "graph/evaluate.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "graph/api/run.h"
#include "graph/api/sides.h"
#include "graph/evaluation_report.h"
#include "graph/given_layout.h"

namespace intarsia {
namespace {

[[noreturn]] void misfit(const std::string& what) {
  throw Error(ErrorCode::bad_argument, "mesh and layout do not fit together: " + what);
}

// The network of a layout on its mesh again. Whatever the caller changed in the arrays is found here.
class GraphBuilder {
 public:
  GraphBuilder(const Layout& from, const MeshView& mesh) : from_(from), network_(from.network), mesh_(mesh) {}

  LayoutGraph build() {
    for (const Node& node : network_.nodes) {
      graph_.node.push_back(number(node.vertex, mesh_.vertex_count(), "vertex"));
      graph_.artificial.push_back(node.is_artificial ? 1 : 0);
    }
    graph_.arc.offset = graph_.arc_edges.offset = graph_.loop.offset = graph_.patch_loops.offset = {0};
    check_rows(network_.arc_offset, network_.arcs.size(), network_.arc_vertex.size(), "arc_offset");
    for (std::size_t a = 0; a < network_.arcs.size(); ++a) add_arc(a);
    check_rows(network_.loop_offset, network_.loop_patch.size(), network_.loop_arc.size(), "loop_offset");
    if (network_.loop_is_forward.size() != network_.loop_arc.size()) misfit("loop_is_forward has another length");
    for (std::size_t l = 0; l < network_.loop_patch.size(); ++l) add_loop(l);
    while (graph_.patch_loops.rows() < from_.patches.size()) graph_.patch_loops.offset.push_back(graph_.loop_count());
    return std::move(graph_);
  }

 private:
  static Index number(std::int64_t n, std::size_t below, const char* what) {
    if (n < 0 || n >= static_cast<std::int64_t>(below)) misfit(std::string(what) + " " + std::to_string(n));
    return static_cast<Index>(n);
  }

  static void check_rows(const std::vector<std::int64_t>& offset, std::size_t rows, std::size_t items,
                         const char* name) {
    const bool fits = offset.size() == rows + 1 && offset.front() == 0 &&
                      offset.back() == static_cast<std::int64_t>(items) && std::is_sorted(offset.begin(), offset.end());
    if (!fits) misfit(name);
  }

  void add_arc(std::size_t a) {
    const Arc& arc = network_.arcs[a];
    const auto patch = [&](std::int32_t p) { return p < 0 ? kNone : number(p, from_.patches.size(), "patch"); };
    graph_.kind.push_back(static_cast<CurveKind>(number(static_cast<std::int64_t>(arc.kind), kCurveKinds, "kind")));
    graph_.start.push_back(number(arc.start, network_.nodes.size(), "node"));
    graph_.end.push_back(number(arc.end, network_.nodes.size(), "node"));
    graph_.left.push_back(patch(arc.left)), graph_.right.push_back(patch(arc.right));
    graph_.strength.push_back(arc.strength);
    Real length = 0;
    Index last = kNone;
    for (std::int64_t i = network_.arc_offset[a]; i < network_.arc_offset[a + 1]; ++i) {
      const Index v = number(network_.arc_vertex[static_cast<std::size_t>(i)], mesh_.vertex_count(), "vertex");
      if (last != kNone) {
        const Index edge = mesh_.edge_between(last, v);
        if (edge == kNone) misfit("no edge joins vertices " + std::to_string(last) + " and " + std::to_string(v));
        graph_.arc_edges.item.push_back(edge);
        length += (mesh_.point(v) - mesh_.point(last)).norm();
      }
      graph_.arc.item.push_back(v), last = v;
    }
    if (graph_.arc.item.size() < graph_.arc.offset.back() + std::size_t{2}) misfit("an arc has less than two vertices");
    graph_.arc.offset.push_back(static_cast<Index>(graph_.arc.item.size()));
    graph_.arc_edges.offset.push_back(static_cast<Index>(graph_.arc_edges.item.size()));
    graph_.length.push_back(length);
  }

  void add_loop(std::size_t l) {
    const Index p = number(network_.loop_patch[l], from_.patches.size(), "patch");
    if (p + std::size_t{1} < graph_.patch_loops.offset.size()) misfit("loop_patch is not ascending");
    while (graph_.patch_loops.rows() < p) graph_.patch_loops.offset.push_back(graph_.loop_count());
    for (std::int64_t i = network_.loop_offset[l]; i < network_.loop_offset[l + 1]; ++i) {
      const std::size_t at = static_cast<std::size_t>(i);
      const Index a = number(network_.loop_arc[at], network_.arcs.size(), "arc");
      const Index half = 2 * a + (network_.loop_is_forward[at] ? 0 : 1);
      if (graph_.patch_of_half_arc(half) != p) misfit("an arc is no border of its loop's patch");
      graph_.loop.item.push_back(half);
    }
    graph_.loop.offset.push_back(static_cast<Index>(graph_.loop.item.size()));
    graph_.patch_loops.item.push_back(graph_.loop_count());
    graph_.loop_patch.push_back(p);
    if (l + 1 == network_.loop_patch.size() || network_.loop_patch[l + 1] != network_.loop_patch[l])
      graph_.patch_loops.offset.push_back(graph_.loop_count());
  }

  const Layout& from_;
  const Network& network_;
  MeshView mesh_;
  LayoutGraph graph_;
};

graph::GivenLayout given_layout(const Work& work, const TriangleMesh& mesh, const Layout& from) {
  Soup soup = call::soup_of(work, mesh);
  const std::size_t faces = from.triangle_patch.size();
  if (from.triangle_parent.size() != faces || from.triangles.size() != 3 * faces)
    misfit("triangles, triangle_patch and triangle_parent have different lengths");
  std::vector<Index> parent(faces), label(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const std::int32_t p = from.triangle_parent[f], l = from.triangle_patch[f];
    if (p < 0 || static_cast<Index>(p) >= soup.face_count()) misfit("triangle_parent " + std::to_string(p));
    if (l < 0 || static_cast<std::size_t>(l) >= from.patches.size()) misfit("triangle_patch " + std::to_string(l));
    parent[f] = static_cast<Index>(p), label[f] = static_cast<Index>(l);
  }
  const Soup refined = call::soup_of(work, TriangleMesh(from.vertices, from.triangles));
  graph::GivenLayout given = graph::given_refinement(work, std::move(soup), refined, std::move(parent));
  given.label = std::move(label);
  given.graph = GraphBuilder(from, given.refined.mesh).build();
  return given;
}

Rebuilt rebuilt_of(const graph::Rebuilt& from, const kernels::BoxTransform& box) {
  Rebuilt out;
  out.was_made = from.made;
  if (!from.made) return out;
  for (std::size_t v = 0; v < from.surface.point.size(); ++v) {
    const Vec3 p = box.to_input(from.surface.point[v]);
    out.vertices.insert(out.vertices.end(), {p.x(), p.y(), p.z()});
  }
  out.triangles = call::signed_numbers(from.surface.corner);
  out.triangle_patch = call::signed_numbers(from.surface.patch);
  const kernels::SurfaceDistance& d = from.distance;
  out.hausdorff = box.diagonal * d.hausdorff();
  out.mean = box.diagonal * d.mean(), out.rms = box.diagonal * d.rms();
  out.forward = call::side_of(d.forward, box), out.backward = call::side_of(d.backward, box);
  for (const kernels::PartDistance& p : from.patch)
    out.patch_rms.push_back(box.diagonal * p.rms), out.patch_max.push_back(box.diagonal * p.max);
  out.failed = static_cast<std::int32_t>(from.failed);
  return out;
}

template <class MakeLayout>
Result<Evaluation> evaluation_of(const EvaluateOptions& options, const MakeLayout& make_layout) noexcept {
  return call::guarded<Evaluation>([&](Result<Evaluation>& result) {
    graph::EvaluateOptions how;
    how.distance.samples = call::checked_samples(options.samples);
    how.make_triangulated = options.triangulated, how.make_transfinite = options.transfinite;
    how.make_filled = options.filled;
    Evaluation& out = result.value;
    call::Run run(options);
    run.add_single("evaluate", [&](const Work& work) {
      const graph::GivenLayout given = make_layout(work);
      const graph::Evaluation e = graph::evaluate(work, given.mesh, given.refined, given.label, given.graph, how);
      out.triangulated = rebuilt_of(e.triangulated, given.box), out.transfinite = rebuilt_of(e.transfinite, given.box);
      out.filled = rebuilt_of(e.filled, given.box);
      out.compactness = e.compactness.patch;
      out.patches = static_cast<std::int32_t>(e.patches), out.not_discs = static_cast<std::int32_t>(e.not_discs);
      out.diagonal = given.box.diagonal;
      nlohmann::json report = {{"schema", "intarsia-eval"}, {"schema_version", 1}, {"program", "intarsia"}};
      report["version"] = version();
      report.update(graph::evaluation_json(e, how, given.box.diagonal));
      report["settings"]["smoothed"] = options.smooth;
      out.report = report.dump();
    });
    run.run();
  });
}

}  // namespace

inline namespace api {

Result<Evaluation> evaluate(const TriangleMesh& mesh, const Layout& layout, const EvaluateOptions& options) noexcept {
  return evaluation_of(options, [&](const Work& work) { return given_layout(work, mesh, layout); });
}

Result<Evaluation> evaluate(const TriangleMesh& mesh, std::span<const std::int32_t> labels,
                            const EvaluateOptions& options) noexcept {
  return evaluation_of(options, [&](const Work& work) {
    Soup soup = call::soup_of(work, mesh);
    if (labels.size() != soup.face_count())
      throw Error(ErrorCode::bad_argument, std::to_string(labels.size()) + " labels for " +
                                               std::to_string(soup.face_count()) +
                                               " triangles: there must be one each");
    std::vector<Index> label;
    number_labels(std::vector<int>(labels.begin(), labels.end()), label);
    return graph::layout_of_labels(work, std::move(soup), std::move(label), options.smooth);
  });
}

}  // namespace api
}  // namespace intarsia
