#include "tools/preview.h"

#include <fmt/format.h>

#include "tools/counted.h"

namespace intarsia::tools {
namespace {

void append(Lines& lines, const Lines& more) {
  for (std::size_t i = 0; i < more.count(); ++i)
    lines.add(std::span(more.point).subspan(more.offset[i], more.offset[i + 1] - more.offset[i]), more.style[i]);
}

Panel panel(std::string title, std::string caption, const Shape& shape, Lines lines = {}) {
  Panel p;
  p.title = std::move(title), p.caption = std::move(caption), p.shape = shape, p.lines = std::move(lines);
  return p;
}

// As it was given, also where features were looked for on a filtered copy.
Panel input_panel(const graph::Surface& surface) {
  MeshView mesh = surface.mesh;
  const Vec3View given = surface.given;
  if (given.size() > 0) mesh.x = given.x, mesh.y = given.y, mesh.z = given.z;
  return panel("input", counted(surface.input_triangles, "triangle", "triangles"), shape_of(mesh));
}

Panel layout_panel(const graph::Layout& layout, std::span<const Rgb> colour) {
  const RefinedMesh& refined = layout.refined;
  Shape patched = shape_of(refined.mesh.view());
  patched.face_label = layout.labels.patch_of_face;
  patched.label_colour = colour;
  return panel("layout", counted(layout.labels.count, "patch", "patches"), patched,
               restyled(lines_of(refined.mesh, refined.on_network, refined.edge_kind), kBorderLine));
}

}  // namespace

Strip preview_strip(const PreviewInput& in) {
  const MeshView mesh = in.surface.mesh;
  Strip strip;
  strip.add(input_panel(in.surface));

  Lines raw = lines_of(mesh, in.ridges.curves.net);
  append(raw, lines_of(mesh, in.valleys.curves.net));
  append(raw, lines_of(mesh, in.sharp.edges.curves.net));
  const std::size_t lines =
      in.ridges.curves.curve_count() + in.valleys.curves.curve_count() + in.sharp.edges.curves.curve_count();
  strip.add(panel("ridges and valleys", counted(lines, "line", "lines"), shape_of(mesh), std::move(raw)));
  strip.add(panel("filtered", counted(in.network.features.curve_count(), "curve", "curves"), shape_of(mesh),
                  lines_of(mesh, in.network.features)));
  const RefinedMesh& network = in.network.refined;
  strip.add(panel("closed network", counted(in.network.patches, "region", "regions"), shape_of(mesh),
                  lines_of(network.mesh, network.on_network, network.edge_kind)));
  strip.add(layout_panel(in.layout, in.patch_colour));
  return strip;
}

Strip baseline_strip(const BaselinePreviewInput& in) {
  const MeshView mesh = in.surface.mesh;
  Strip strip;
  strip.add(input_panel(in.surface));
  Shape labelled = shape_of(mesh);
  labelled.face_label = in.patches.labels.patch_of_face;
  labelled.label_colour = in.patch_colour;
  strip.add(panel(in.method, counted(in.patches.labels.count, "region", "regions"), labelled));
  strip.add(layout_panel(in.layout, in.patch_colour));
  return strip;
}

}  // namespace intarsia::tools
