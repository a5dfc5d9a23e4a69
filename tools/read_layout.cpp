#include "tools/read_layout.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

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
  Soup input = read_mesh(work, folder / "patches.ply");
  const std::filesystem::path refined = folder / "layout.ply";
  std::vector<Index> parent = whole_numbers(work, refined, "parent", input.face_count());
  LayoutFromFile layout = graph::given_refinement(work, std::move(input), read_mesh(work, refined), std::move(parent));
  const std::filesystem::path network = folder / "network.json";
  layout.graph = NetworkReader(network, layout.refined.mesh).read();
  layout.label = whole_numbers(work, refined, "patch", layout.graph.patch_count());
  return layout;
}

LayoutFromFile read_labelled_mesh(const Work& work, const LabelledMesh& input) {
  Soup soup = read_mesh(work, input.mesh);
  const std::filesystem::path labels = input.labels.empty() ? input.mesh : input.labels;
  std::vector<Index> label;
  number_labels(
      labels_of_triangles(labels, read_face_labels(work, labels, input.property), soup.source_face, soup.face_count()),
      label);
  return graph::layout_of_labels(work, std::move(soup), std::move(label), input.smooth);
}

}  // namespace intarsia::tools
