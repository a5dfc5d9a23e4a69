#include "tools/export/write_glb.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "tools/export/file_writer.h"
#include "tools/picture/lines.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUnsigned = 5125, kArrayBuffer = 34962, kElementBuffer = 34963, kLines = 1;
constexpr Real kSmooth = 0.9;  // cosine: up to here a patch shares the normals of its neighbours

struct Range {
  std::size_t begin = 0, count = 0;
};

// Corners of faces by patch: a vertex for each patch it belongs to.
struct Surface {
  std::vector<Index> vertex;  // refined vertices, by patch
  std::vector<Index> corner;  // numbers inside the patch's vertices, by patch
  std::vector<Range> patch_vertex, patch_corner;
  std::vector<Vec3> normal;  // per entry of vertex
};

Vec3 area_normal(const MeshView& mesh, Index f) {
  const auto [i, j, k] = mesh.face(f);
  return (mesh.point(j) - mesh.point(i)).cross(mesh.point(k) - mesh.point(i));
}

Surface split_by_patch(const Work& work, const LayoutView& layout) {
  const MeshView mesh = layout.refined->mesh;
  const Csr faces = faces_of_patches(*layout.labels);
  Surface s;
  std::vector<Index> number(mesh.vertex_count(), kNone);  // inside the present patch
  std::vector<Vec3> whole(mesh.vertex_count(), Vec3::Zero());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 n = area_normal(mesh, f);
    for (const Index v : mesh.face(f)) whole[v] += n;
  }
  for (Index p = 0; p < faces.rows(); ++p) {
    const std::size_t first = s.vertex.size(), first_corner = s.corner.size();
    for (const Index f : faces.row(p)) {
      const Vec3 n = area_normal(mesh, f);
      for (const Index v : mesh.face(f)) {
        if (number[v] == kNone) {
          number[v] = static_cast<Index>(s.vertex.size() - first);
          s.vertex.push_back(v), s.normal.push_back(Vec3::Zero());
        }
        s.normal[first + number[v]] += n;
        s.corner.push_back(number[v]);
      }
    }
    for (std::size_t i = first; i < s.vertex.size(); ++i) {
      number[s.vertex[i]] = kNone;
      const Vec3 own = s.normal[i].normalized(), all = whole[s.vertex[i]].normalized();
      s.normal[i] = own.dot(all) > kSmooth ? all : own;
      if (!(s.normal[i].squaredNorm() > 0.5)) s.normal[i] = Vec3::UnitZ();
    }
    s.patch_vertex.push_back({first, s.vertex.size() - first});
    s.patch_corner.push_back({first_corner, s.corner.size() - first_corner});
    work.check();
  }
  return s;
}

json colour_json(const std::string& name, int r, int g, int b, bool lit) {
  const auto linear = [](int c) {
    const double s = c / 255.;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  json material = {
      {"name", name},
      {"doubleSided", true},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {linear(r), linear(g), linear(b), 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.7}}}};
  if (!lit) material["extensions"]["KHR_materials_unlit"] = json::object();
  return material;
}

// The scene's description beside the data that it describes, which are appended in the order of add().
struct Document {
  json root = {{"asset", {{"version", "2.0"}, {"generator", "intarsia"}}}, {"scene", 0}};
  std::uint64_t bytes = 0;

  std::size_t view(std::uint64_t size, int target) {
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", size}, {"target", target}});
    bytes += size;
    return root["bufferViews"].size() - 1;
  }
  std::size_t accessor(std::size_t buffer_view, std::size_t offset, int type, std::size_t count, const char* shape) {
    root["accessors"].push_back({{"bufferView", buffer_view},
                                 {"byteOffset", offset},
                                 {"componentType", type},
                                 {"count", count},
                                 {"type", shape}});
    return root["accessors"].size() - 1;
  }
};

using Point = std::array<float, 3>;

Point local(const Vec3& p, const Vec3& centre) {
  return {static_cast<float>(p.x() - centre.x()), static_cast<float>(p.y() - centre.y()),
          static_cast<float>(p.z() - centre.z())};
}

// The format wants the box of positions.
void add_box(json& accessor, const std::vector<Point>& point, Range range) {
  Point low = point[range.begin], high = low;
  for (std::size_t i = range.begin; i < range.begin + range.count; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      low[k] = std::min(low[k], point[i][k]), high[k] = std::max(high[k], point[i][k]);
  accessor["min"] = low, accessor["max"] = high;
}

void describe_patches(Document& doc, const Handover& handover, const Surface& s, const std::vector<Point>& point) {
  if (s.vertex.empty()) return;
  const std::size_t places = doc.view(12 * s.vertex.size(), kArrayBuffer),
                    normals = doc.view(12 * s.vertex.size(), kArrayBuffer),
                    corners = doc.view(4 * s.corner.size(), kElementBuffer);
  json primitives = json::array();
  for (Index p = 0; p < s.patch_vertex.size(); ++p) {
    const Range v = s.patch_vertex[p], c = s.patch_corner[p];
    if (c.count == 0) continue;
    const std::size_t place = doc.accessor(places, 12 * v.begin, kFloat, v.count, "VEC3");
    add_box(doc.root["accessors"][place], point, v);
    primitives.push_back(
        {{"attributes",
          {{"POSITION", place}, {"NORMAL", doc.accessor(normals, 12 * v.begin, kFloat, v.count, "VEC3")}}},
         {"indices", doc.accessor(corners, 4 * c.begin, kUnsigned, c.count, "SCALAR")},
         {"material", doc.root["materials"].size()}});
    const auto& rgb = handover.layout.patch_colour[p];
    doc.root["materials"].push_back(colour_json(fmt::format("patch_{}", p), rgb[0], rgb[1], rgb[2], true));
  }
  doc.root["meshes"].push_back({{"name", "patches"}, {"primitives", std::move(primitives)}});
}

void describe_curves(Document& doc, const std::vector<Point>& point, const std::vector<Index> (&segment)[kCurveKinds]) {
  if (point.empty()) return;
  const std::size_t places = doc.view(12 * point.size(), kArrayBuffer);
  const std::size_t place = doc.accessor(places, 0, kFloat, point.size(), "VEC3");
  add_box(doc.root["accessors"][place], point, {0, point.size()});
  json primitives = json::array();
  for (int k = 0; k < kCurveKinds; ++k) {
    if (segment[k].empty()) continue;
    const std::size_t view = doc.view(4 * segment[k].size(), kElementBuffer);
    primitives.push_back({{"attributes", {{"POSITION", place}}},
                          {"indices", doc.accessor(view, 0, kUnsigned, segment[k].size(), "SCALAR")},
                          {"mode", kLines},
                          {"material", doc.root["materials"].size()}});
    const Rgb c = style_of(static_cast<CurveKind>(k)).colour;
    doc.root["materials"].push_back(colour_json(name_of(static_cast<CurveKind>(k)), c.r, c.g, c.b, false));
  }
  doc.root["meshes"].push_back({{"name", "curves"}, {"primitives", std::move(primitives)}});
  doc.root["extensionsUsed"] = {"KHR_materials_unlit"};
}

void finish(Document& doc, const Vec3& centre) {
  json nodes = json::array(), shown = json::array();
  for (std::size_t m = 0; m < doc.root["meshes"].size(); ++m) {
    nodes.push_back(
        {{"name", doc.root["meshes"][m]["name"]}, {"mesh", m}, {"translation", {centre.x(), centre.y(), centre.z()}}});
    shown.push_back(m);
  }
  doc.root["nodes"] = std::move(nodes);
  doc.root["scenes"] = {{{"name", "layout"}, {"nodes", std::move(shown)}}};
  doc.root["buffers"] = {{{"byteLength", doc.bytes}}};
}

}  // namespace

void write_layout_glb(const Work& work, const std::filesystem::path& path, const Handover& handover) {
  const LayoutView& layout = handover.layout;
  const LayoutGraph& graph = *layout.graph;
  const Surface s = split_by_patch(work, layout);
  std::vector<Point> point, curve_point;
  point.reserve(s.vertex.size());
  for (const Index v : s.vertex) point.push_back(local(layout_point(layout, v), layout.centre));
  std::vector<Index> segment[kCurveKinds];
  for (Index a = 0; a < graph.arc_count(); ++a) {
    std::vector<Index>& to = segment[static_cast<int>(graph.kind[a])];
    const Index first = static_cast<Index>(curve_point.size());
    const auto row = graph.arc.row(a);
    for (const Index v : row) curve_point.push_back(local(layout_point(layout, v), layout.centre));
    for (Index i = 0; i + 1 < row.size(); ++i) to.insert(to.end(), {first + i, first + i + 1});
  }
  Document doc;
  describe_patches(doc, handover, s, point);
  describe_curves(doc, curve_point, segment);
  finish(doc, layout.centre);

  std::string text = doc.root.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  const std::uint64_t total = 12 + 8 + text.size() + 8 + doc.bytes;
  if (total > 0xffffffffu)
    throw Error(ErrorCode::too_large, path.string() +
                                          ": a .glb file ends at 4 GiB, and this layout needs more; leave "
                                          "glb out of --write");
  FileWriter out(path);
  const auto chunk = [&](std::uint64_t size, const char* type) {
    out.put(static_cast<std::uint32_t>(size));
    out.bytes({type, 4});
  };
  out.bytes("glTF");
  out.put<std::uint32_t>(2), out.put(static_cast<std::uint32_t>(total));
  chunk(text.size(), "JSON");
  out.bytes(text);
  chunk(doc.bytes, "BIN\0");
  const auto put_points = [&](const std::vector<Point>& points) {
    for (const Point& p : points)
      for (const float x : p) out.put(x);
  };
  put_points(point);
  for (const Vec3& n : s.normal)
    for (int i = 0; i < 3; ++i) out.put(static_cast<float>(n[i]));
  for (const Index c : s.corner) out.put(c);
  put_points(curve_point);
  for (const auto& of_kind : segment)
    for (const Index i : of_kind) out.put(i);
  out.commit();
}

}  // namespace intarsia::tools
