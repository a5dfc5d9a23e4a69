#include "tools/read_layout.h"

#include <fstream>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "engine/parallel/connect_mesh.h"
#include "engine/parallel/for_each.h"
#include "graph/empty_network.h"
#include "graph/stages.h"
#include "kernels/layout/trace_boundaries.h"
#include "kernels/patches/flood_patches.h"
#include "kernels/surface/check_soup.h"
#include "kernels/surface/clean_soup.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

Mesh normalised(const Work& work, const Soup& soup, const kernels::BoxTransform& box) {
  kernels::check_soup(work, soup);
  Mesh mesh;
  mesh.x.resize(soup.vertex_count()), mesh.y.resize(soup.vertex_count()), mesh.z.resize(soup.vertex_count());
  for_each(work, Cost::light, soup.vertex_count(), [&](std::size_t v) {
    const Vec3 p = box.to_unit({soup.x[v], soup.y[v], soup.z[v]});
    mesh.x[v] = p.x(), mesh.y[v] = p.y(), mesh.z[v] = p.z();
  });
  mesh.corner = soup.corner;
  connect_mesh(work, mesh);
  return mesh;
}

std::vector<Index> whole_numbers(const Work& work, const std::filesystem::path& path, const char* property,
                                 Index below) {
  const std::vector<int> value = read_face_labels(work, path, property);
  std::vector<Index> out(value.size());
  for (std::size_t f = 0; f < value.size(); ++f) {
    if (value[f] < 0 || static_cast<Index>(value[f]) >= below)
      throw Error(ErrorCode::bad_file, fmt::format("{}: face {}: {} is {}, which must be below {}", path.string(), f,
                                                   property, value[f], below));
    out[f] = static_cast<Index>(value[f]);
  }
  return out;
}

// Takes numbers out of network.json; whatever is wrong with it becomes one error.
class NetworkReader {
 public:
  NetworkReader(const std::filesystem::path& path, const MeshView& mesh) : path_(path), mesh_(mesh) {}

  LayoutGraph read() {
    try {
      const json file = json::parse(std::ifstream(path_, std::ios::binary));
      if (file.at("schema") != "intarsia-network" || file.at("version") != 1) fail("it has another schema");
      read_graph(file);
    } catch (const json::exception& e) {
      fail(e.what());
    }
    return std::move(graph_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::bad_file, path_.string() + ": " + what + "; let intarsia run write it again");
  }
  Index number(const json& value, std::size_t below, const char* what) const {
    const auto n = value.get<std::int64_t>();
    if (n < 0 || n >= static_cast<std::int64_t>(below)) fail(fmt::format("{} {} does not exist", what, n));
    return static_cast<Index>(n);
  }

  void read_graph(const json& file) {
    for (const json& node : file.at("nodes")) {
      graph_.node.push_back(number(node.at("vertex"), mesh_.vertex_count(), "vertex"));
      graph_.artificial.push_back(node.at("artificial").get<bool>() ? 1 : 0);
    }
    const json &arcs = file.at("arcs"), &patches = file.at("patches");
    graph_.arc.offset = graph_.arc_edges.offset = graph_.loop.offset = graph_.patch_loops.offset = {0};
    for (const json& arc : arcs) read_arc(arc, patches.size());
    for (Index p = 0; p < patches.size(); ++p) {
      for (const json& loop : patches[p].at("loops")) {
        for (const json& step : loop) {
          const Index a = number(step.at("arc"), arcs.size(), "arc");
          const Index half = 2 * a + (step.at("forward").get<bool>() ? 0 : 1);
          if (graph_.patch_of_half_arc(half) != p) fail(fmt::format("arc {} is no border of patch {}", a, p));
          graph_.loop.item.push_back(half);
        }
        graph_.loop.offset.push_back(static_cast<Index>(graph_.loop.item.size()));
        graph_.patch_loops.item.push_back(graph_.loop_count());
        graph_.loop_patch.push_back(p);
      }
      graph_.patch_loops.offset.push_back(graph_.loop_count());
    }
  }

  void read_arc(const json& arc, std::size_t patches) {
    const auto patch = [&](const char* side) {
      return arc.at(side).is_null() ? kNone : number(arc.at(side), patches, "patch");
    };
    graph_.kind.push_back(static_cast<CurveKind>(number(arc.at("kind"), kCurveKinds, "kind")));
    graph_.start.push_back(number(arc.at("start"), graph_.node.size(), "node"));
    graph_.end.push_back(number(arc.at("end"), graph_.node.size(), "node"));
    graph_.left.push_back(patch("left")), graph_.right.push_back(patch("right"));
    graph_.strength.push_back(arc.at("turn").get<Real>());
    const Index first = static_cast<Index>(graph_.arc.item.size());
    Real length = 0;
    for (const json& vertex : arc.at("vertices")) {
      const Index v = number(vertex, mesh_.vertex_count(), "vertex");
      if (graph_.arc.item.size() > first) {
        const Index last = graph_.arc.item.back(), edge = mesh_.edge_between(last, v);
        if (edge == kNone) fail(fmt::format("vertices {} and {} are not joined in layout.ply", last, v));
        graph_.arc_edges.item.push_back(edge);
        length += (mesh_.point(v) - mesh_.point(last)).norm();
      }
      graph_.arc.item.push_back(v);
    }
    if (graph_.arc.item.size() < first + 2) fail("an arc has less than two vertices");
    graph_.arc.offset.push_back(static_cast<Index>(graph_.arc.item.size()));
    graph_.arc_edges.offset.push_back(static_cast<Index>(graph_.arc_edges.item.size()));
    graph_.length.push_back(length);
  }

  const std::filesystem::path& path_;
  MeshView mesh_;
  LayoutGraph graph_;
};

// The labels as borders of the mesh itself. All count as features, so that corners of borders become nodes.
void trace_labels(const Work& work, const std::vector<Index>& label, LayoutFromFile& layout) {
  RefinedMesh& refined = layout.refined;
  refined.mesh = layout.mesh;
  const MeshView mesh = refined.mesh;
  refined.parent.resize(mesh.face_count());
  std::iota(refined.parent.begin(), refined.parent.end(), Index{0});
  const PatchLabels labels = kernels::flood_equal(work, mesh, label);
  layout.label = labels.patch_of_face;
  refined.on_network.resize(mesh.edge_count());
  refined.edge_kind.resize(mesh.edge_count());
  refined.edge_strength.resize(mesh.edge_count());
  for_each(work, Cost::light, mesh.edge_count(), [&](std::size_t i) {
    const Index e = static_cast<Index>(i);
    const bool boundary = mesh.is_boundary_edge(e);
    refined.edge_kind[e] = boundary ? CurveKind::border : CurveKind::sharp;
    refined.on_network[e] = boundary || layout.label[mesh.edge_f0[e]] != layout.label[mesh.edge_f1[e]] ? 1 : 0;
  });
  layout.graph = kernels::trace_boundaries(work, refined, layout.label, labels.count);
}

// The labels through the last stage of a run.
void smooth_labels(const Work& work, const std::vector<Index>& label, LayoutFromFile& layout) {
  graph::LayoutOptions options;
  const graph::Surface surface = graph::mesh_to_surface(work, layout.soup);
  const graph::Sharp sharp = graph::surface_to_sharp(work, surface, options);
  const graph::Scale scale = graph::surface_to_scale(work, surface, sharp, options);
  const graph::Curvature curvature = graph::scale_to_curvature(work, surface, scale, sharp, options);
  const graph::Network network = graph::empty_network(work, surface);
  std::vector<Index> reordered(label.size());
  for (std::size_t f = 0; f < label.size(); ++f) reordered[f] = label[surface.order.face[f]];
  const graph::Patches patches = graph::patches_of_labels(work, network, surface, reordered);
  graph::Layout smoothed = graph::patches_to_layout(work, surface, curvature, network, patches, options);
  layout.refined = std::move(smoothed.refined);
  layout.label = std::move(smoothed.labels.patch_of_face);
  layout.graph = std::move(smoothed.graph);
  for (Index& parent : layout.refined.parent) parent = surface.order.face[parent];
}

}  // namespace

bool is_result_folder(const std::filesystem::path& folder) {
  for (const char* name : {"patches.ply", "layout.ply", "network.json"})
    if (!std::filesystem::is_regular_file(folder / name)) return false;
  return true;
}

LayoutFromFile read_result_folder(const Work& work, const std::filesystem::path& folder) {
  if (!is_result_folder(folder))
    throw Error(ErrorCode::bad_file, folder.string() +
                                         ": no result of intarsia run: it must hold patches.ply, "
                                         "layout.ply and network.json");
  LayoutFromFile layout;
  layout.soup = read_mesh(work, folder / "patches.ply");
  const Index given = layout.soup.face_count();
  kernels::Cleaning cleaning = kernels::clean_soup(work, layout.soup, {});
  if (cleaning.changed) layout.soup = std::move(cleaning.soup);
  layout.box = kernels::normalise_box(work, layout.soup);
  layout.mesh = normalised(work, layout.soup, layout.box);
  const std::filesystem::path refined = folder / "layout.ply";
  layout.refined.mesh = normalised(work, read_mesh(work, refined), layout.box);
  layout.refined.parent = whole_numbers(work, refined, "parent", given);
  if (cleaning.changed)
    for (Index& parent : layout.refined.parent) {
      parent = cleaning.triangle_of[parent];
      if (parent == kNone)
        throw Error(ErrorCode::bad_file, refined.string() +
                                             ": a face comes from a triangle that cleaning drops; let "
                                             "intarsia run write it again without --clean options");
    }
  const std::filesystem::path network = folder / "network.json";
  layout.graph = NetworkReader(network, layout.refined.mesh).read();
  layout.label = whole_numbers(work, refined, "patch", layout.graph.patch_count());
  return layout;
}

LayoutFromFile read_labelled_mesh(const Work& work, const LabelledMesh& input) {
  LayoutFromFile layout;
  layout.soup = read_mesh(work, input.mesh);
  const std::filesystem::path labels = input.labels.empty() ? input.mesh : input.labels;
  std::vector<Index> label;
  number_labels(labels_of_triangles(labels, read_face_labels(work, labels, input.property), layout.soup.source_face,
                                    layout.soup.face_count()),
                label);
  kernels::Cleaning cleaning = kernels::clean_soup(work, layout.soup, {});
  if (cleaning.changed) {
    layout.soup = std::move(cleaning.soup);
    std::vector<Index> kept;
    for (const Index t : cleaning.input_triangle) kept.push_back(label[t]);
    label = std::move(kept);
  }
  layout.box = kernels::normalise_box(work, layout.soup);
  layout.mesh = normalised(work, layout.soup, layout.box);
  if (input.smooth)
    smooth_labels(work, label, layout);
  else
    trace_labels(work, label, layout);
  return layout;
}

}  // namespace intarsia::tools
