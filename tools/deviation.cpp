#include "tools/deviation.h"

#include <fmt/format.h>

#include "engine/io/write_ply.h"
#include "engine/parallel/for_each.h"
#include "engine/parallel/single_precision.h"
#include "tools/picture/strip.h"

namespace intarsia::tools {

ColourScale deviation_scale(const Deviation& deviation) {
  std::vector<Real> percent(deviation.distance.face_rms);
  for (Real& p : percent) p *= 100;
  return scale_for(percent, deviation.distance.face_area, "distance, % of the diagonal");
}

void write_deviation_ply(const Work& work, const std::filesystem::path& path, const Deviation& deviation,
                         const ColourScale& scale) {
  const Soup& soup = deviation.soup;
  const std::vector<Real>& distance = deviation.distance.vertex_distance;
  const std::vector<Real>& face_rms = deviation.distance.face_rms;
  const Real unit = deviation.diagonal;
  std::vector<Real> percent(distance.size());
  for_each(work, Cost::light, distance.size(), [&](std::size_t v) { percent[v] = 100 * distance[v]; });
  const std::vector<Rgb> colour = colours_of(work, percent, scale);
  PlyFile ply;
  ply.comment("distance: to the other surface, in the units of this file");
  ply.comment(fmt::format("colours: 0 to {:.6g} {}", scale.top, scale.label));
  auto& vertex = ply.element("vertex", soup.vertex_count());
  if (is_single_precision(work, soup, soup.vertex_count(), [](std::size_t v) { return v; }))
    vertex.xyz<float>(soup.x, soup.y, soup.z);
  else
    vertex.xyz<double>(soup.x, soup.y, soup.z);
  vertex.column<std::uint8_t>("red", [&](std::size_t v) { return colour[v].r; });
  vertex.column<std::uint8_t>("green", [&](std::size_t v) { return colour[v].g; });
  vertex.column<std::uint8_t>("blue", [&](std::size_t v) { return colour[v].b; });
  vertex.column<float>("distance", [&](std::size_t v) { return unit * distance[v]; });
  auto& face = ply.element("face", soup.face_count());
  face.triangles(soup.corner);
  face.column<float>("distance_rms", [&](std::size_t f) { return unit * face_rms[f]; });
  if (!soup.source_face.empty()) face.column<std::int32_t>("source_face", soup.source_face);
  write_ply(work, path, ply);
}

Image draw_deviation(const Work& work, const Deviation& deviation, const ColourScale& scale, const View& view) {
  std::vector<Real> percent(deviation.distance.face_rms);
  for (Real& p : percent) p *= 100;
  const std::vector<Rgb> colour = colours_of(work, percent, scale);
  Shape shape;
  shape.x = deviation.soup.x, shape.y = deviation.soup.y, shape.z = deviation.soup.z;
  shape.corner = deviation.soup.corner, shape.face_colour = colour;
  const auto one = [&](const char* title, const View& from, const std::string& caption) {
    Strip strip;
    strip.add({title, caption, shape, {}});
    strip.options.view = from, strip.options.legend = false;
    return draw_strip(work, strip);
  };
  const kernels::OneSided& d = deviation.distance.forward;
  View behind = view;
  behind.toward = 2 * view.up.dot(view.toward) * view.up.normalized() - view.toward;  // turned about the vertical
  const Image front = one("front", view, fmt::format("RMS {:.3g} %, mean {:.3g} %", 100 * d.rms, 100 * d.mean));
  const Image back = one("back", behind, fmt::format("largest {:.3g} %", 100 * d.max));
  return with_scale_bar(beside(front, back), scale);
}

}  // namespace intarsia::tools
