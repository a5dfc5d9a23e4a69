#include "tools/view/write_page.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tools/export/file_writer.h"
#include "tools/export/write_labels.h"
#include "tools/picture/best_view.h"
#include "tools/picture/colour_map.h"
#include "tools/picture/lines.h"
#include "tools/view/assets.h"
#include "tools/view/page_data.h"
#include "tools/view/page_surface.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

PageBytes surface_bytes(const PageSurface& surface, const PageGrid& grid) {
  PageBytes to;
  to.whole(static_cast<Index>(surface.point.size()));
  to.whole(static_cast<Index>(surface.corner.size() / 3));
  to.whole(static_cast<Index>(surface.patch_faces.size()));
  for (const Index n : surface.patch_faces) to.whole(n);
  Index known = 0;
  for (const Index c : surface.corner) {
    to.whole(c == known ? 0 : known - c);
    if (c == known) ++known;
  }
  PagePath path(grid, to);
  for (const Vec3& p : surface.point) path.point(p);
  return to;
}

// Lines by their numbers; point(line, i) normalised.
template <class Lines>
void put_lines(PageBytes& to, const PageGrid& grid, const Lines& lines) {
  std::size_t total = 0;
  for (std::size_t l = 0; l < lines.count; ++l) total += lines.points(l);
  to.whole(static_cast<Index>(lines.count)), to.whole(static_cast<Index>(total));
  PagePath path(grid, to);
  for (std::size_t l = 0; l < lines.count; ++l) {
    to.whole(static_cast<std::uint32_t>(lines.kind(l)));
    to.whole(static_cast<Index>(lines.points(l)));
    lines.measures(l, to);
    for (std::size_t i = 0; i < lines.points(l); ++i) path.point(lines.point(l, i));
  }
}

template <class Points, class Kind, class Measures, class Point>
struct LineRows {
  std::size_t count;
  Points points;
  Kind kind;
  Measures measures;
  Point point;
};

template <class Points, class Kind, class Measures, class Point>
LineRows(std::size_t, Points, Kind, Measures, Point) -> LineRows<Points, Kind, Measures, Point>;  // for clang 14

constexpr auto kNoMeasures = [](std::size_t, PageBytes&) {};

PageBytes feature_bytes(const FeatureLines& lines, const LayoutView& layout, const PageGrid& grid) {
  const auto unit = [&](const Vec3& p) -> Vec3 { return (p - layout.centre) / layout.diagonal; };
  PageBytes to;
  for (const std::uint8_t chosen : {0, 1}) {
    std::vector<std::size_t> of;
    for (std::size_t l = 0; l < lines.count(); ++l)
      if (lines.chosen[l] == chosen) of.push_back(l);
    put_lines(to, grid,
              LineRows{of.size(), [&](std::size_t l) { return lines.offset[of[l] + 1] - lines.offset[of[l]]; },
                       [&](std::size_t l) { return lines.kind[of[l]]; },
                       [&](std::size_t l, PageBytes& b) {
                         if (chosen) return;
                         b.real(lines.L[of[l]]), b.real(lines.R[of[l]]), b.real(lines.T[of[l]]);
                       },
                       [&](std::size_t l, std::size_t i) { return unit(lines.point[lines.offset[of[l]] + i]); }});
  }
  put_lines(to, grid,
            LineRows{lines.network_kind.size(), [](std::size_t) { return std::size_t{2}; },
                     [&](std::size_t l) { return lines.network_kind[l]; }, kNoMeasures,
                     [&](std::size_t l, std::size_t i) { return unit(lines.network[2 * l + i]); }});
  return to;
}

PageBytes arc_bytes(const LayoutView& layout, const PageGrid& grid) {
  const LayoutGraph& graph = *layout.graph;
  const MeshView mesh = layout.refined->mesh;
  PageBytes to;
  put_lines(
      to, grid,
      LineRows{graph.arc_count(), [&](std::size_t a) { return graph.arc.row(static_cast<Index>(a)).size(); },
               [&](std::size_t a) { return graph.kind[a]; }, kNoMeasures,
               [&](std::size_t a, std::size_t i) { return mesh.point(graph.arc.row(static_cast<Index>(a))[i]); }});
  return to;
}

// Distances at the refined vertices: those of the input, interpolated in its triangles.
std::vector<Real> refined_distance(const LayoutView& layout, std::span<const Real> vertex) {
  const MeshView mesh = layout.refined->mesh;
  const Soup& soup = *layout.soup;
  const Index originals = static_cast<Index>(layout.vertex_order.size());
  std::vector<Real> out(mesh.vertex_count(), 0);
  for (Index v = 0; v < originals; ++v) out[v] = vertex[layout.vertex_order[v]];
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index v : mesh.face(f)) {
      if (v < originals) continue;
      const std::size_t parent = 3 * std::size_t{layout.face_order[layout.refined->parent[f]]};
      Real sum = 0, weight = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index c = soup.corner[parent + i];
        const Real w = 1 / (1e-12 + (Vec3(soup.x[c], soup.y[c], soup.z[c]) - layout_point(layout, v)).norm());
        sum += w * vertex[c], weight += w;
      }
      out[v] = sum / weight;
    }
  return out;
}

PageBytes deviation_bytes(const PageSurface& surface, const LayoutView& layout, const PageDeviation& deviation) {
  const std::vector<Real> distance = refined_distance(layout, deviation.vertex);
  PageBytes to;
  for (const Index v : surface.source)
    to.byte(static_cast<std::uint8_t>(std::lround(255 * std::clamp(distance[v] / deviation.top, 0., 1.))));
  return to;
}

json rgb(const Rgb& c) { return {c.r, c.g, c.b}; }

json deviation_json(const PageDeviation& deviation) {
  json ramp = json::array(), rms = json::array();
  for (int i = 0; i <= 32; ++i) ramp.push_back(rgb(map_colour(i / 32.)));
  for (const Real r : deviation.patch_rms) rms.push_back(100 * r);
  return {{"top", 100 * deviation.top},
          {"label", "distance, % of the diagonal"},
          {"caption", deviation.caption},
          {"ramp", std::move(ramp)},
          {"patch_rms", std::move(rms)}};
}

json patches_json(const Handover& handover) {
  json out = {{"triangles", json::array()},  {"area", json::array()},       {"perimeter", json::array()},
              {"sides", json::array()},      {"loops", json::array()},      {"flatness", json::array()},
              {"neighbours", json::array()}, {"compactness", json::array()}};
  for (const PatchRow& r : patch_rows(handover)) {
    out["triangles"].push_back(r.triangles), out["sides"].push_back(r.sides), out["loops"].push_back(r.loops);
    out["area"].push_back(static_cast<float>(r.area)), out["perimeter"].push_back(static_cast<float>(r.perimeter));
    out["flatness"].push_back(static_cast<float>(r.normal.norm()));
    out["compactness"].push_back(static_cast<float>(r.compactness()));
    out["neighbours"].push_back(r.neighbours);
  }
  return out;
}

json meta_of(const Work& work, const Handover& handover, const PageGrid& grid, const PageSurface& surface) {
  const LayoutView& layout = handover.layout;
  const View view = best_view(work, shape_of(layout.mesh));
  json kinds = json::array(), colours = json::array(), size = json::array();
  for (int k = 0; k < kCurveKinds; ++k) {
    const LineStyle style = style_of(static_cast<CurveKind>(k));
    kinds.push_back(
        {{"name", name_of(static_cast<CurveKind>(k))}, {"colour", rgb(style.colour)}, {"width", style.width}});
  }
  for (const auto& c : layout.patch_colour) colours.push_back({c[0], c[1], c[2]});
  for (int i = 0; i < 3; ++i) size.push_back(grid.steps(grid.high, i));
  return {{"name", handover.name},
          {"triangles", layout.soup->face_count()},
          {"vertices", layout.soup->vertex_count()},
          {"diagonal", layout.diagonal},
          {"coarse", surface.is_coarse},
          {"frame", {{"size", std::move(size)}}},
          {"view",
           {{"toward", {view.toward.x(), view.toward.y(), view.toward.z()}},
            {"up", {view.up.x(), view.up.y(), view.up.z()}}}},
          {"kinds", std::move(kinds)},
          {"colours", std::move(colours)},
          {"patches", patches_json(handover)}};
}

// "<" must not be seen by the browser inside data.
std::string script_safe(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

std::string html_safe(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

// The template's text, with {{NAME}} replaced by what part(NAME) writes.
template <class Part>
void fill_template(FileWriter& out, std::string_view text, const Part& part) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find("{{", at);
    out.bytes(text.substr(at, open - at));
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find("}}", open);
    out.bytes(part(text.substr(open + 2, close - open - 2)));
    at = close + 2;
  }
}

std::string part_of(const std::string& page, const std::string& id) {
  const std::string tag = "id=\"" + id + "\">";
  const std::size_t begin = page.find(tag);
  if (begin == std::string::npos) return "";
  return page.substr(begin + tag.size(), page.find("</script>", begin) - begin - tag.size());
}

}  // namespace

PageParts read_page_parts(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  const std::string page = text.str();
  PageParts parts{part_of(page, "features-data"), part_of(page, "deviation-data"), ""};
  const json meta = json::parse(part_of(page, "meta"), nullptr, false);
  if (meta.is_object() && meta.contains("deviation")) parts.deviation_meta = meta["deviation"].dump();
  if (parts.deviation_meta.empty()) parts.deviation.clear();
  return parts;
}

void write_page(const Work& work, const std::filesystem::path& path, const Handover& handover,
                const PageOptions& options) {
  const LayoutView& layout = handover.layout;
  const PageGrid grid = grid_of(layout.refined->mesh);
  const PageSurface surface = page_surface(work, layout, options.most_faces);
  json meta = meta_of(work, handover, grid, surface);
  std::string deviation = options.earlier.deviation;
  if (options.deviation) {
    meta["deviation"] = deviation_json(*options.deviation);
    deviation = base64(deviation_bytes(surface, layout, *options.deviation).bytes());
  } else if (!deviation.empty()) {
    meta["deviation"] = json::parse(options.earlier.deviation_meta);
  }
  std::string features =
      handover.features ? base64(feature_bytes(*handover.features, layout, grid).bytes()) : options.earlier.features;
  FileWriter out(path);
  fill_template(out, kPageTemplate, [&](std::string_view name) -> std::string {
    work.check();
    if (name == "title") return html_safe(handover.name) + " - Intarsia";
    if (name == "style") return kPageStyle;
    if (name == "script") return kPageScript;
    if (name == "meta") return script_safe(meta.dump());
    if (name == "surface") return base64(surface_bytes(surface, grid).bytes());
    if (name == "features") return features;
    if (name == "arcs") return base64(arc_bytes(layout, grid).bytes());
    if (name == "deviation") return deviation;
    throw Error(ErrorCode::internal, "the page's template names an unknown part");
  });
  out.commit();
}

}  // namespace intarsia::tools
