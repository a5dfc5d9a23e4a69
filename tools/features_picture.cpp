#include "tools/features_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/parallel/for_each.h"
#include "tools/picture/best_view.h"
#include "tools/picture/colour_map.h"
#include "tools/picture/font.h"
#include "tools/picture/shade.h"

namespace intarsia::tools {
namespace {

constexpr Rgb kMark = {200, 30, 36};

// A circle around a vertex in its tangent plane, a little above the surface.
std::vector<Vec3> circle(const Vec3& centre, const Vec3& normal, Real radius) {
  constexpr int kSteps = 40;
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  std::vector<Vec3> points;
  for (int i = 0; i <= kSteps; ++i) {
    const Real a = 2 * std::numbers::pi * i / kSteps;
    points.push_back(centre + 0.4 * radius * normal + radius * (std::cos(a) * u + std::sin(a) * w));
  }
  return points;
}

}  // namespace

Image draw_scales(const Work& work, const graph::Surface& surface, const graph::Scale& scale,
                  std::span<const Index> marked, const std::optional<View>& view) {
  const MeshView mesh = surface.mesh;
  std::vector<Real> ring(mesh.face_count());
  for_each(work, Cost::light, ring.size(), [&](std::size_t f) {
    Real sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += scale.fields.scale[mesh.corner[3 * f + i]];
    ring[f] = sum / 3;
  });
  ColourScale colours;
  colours.top = 6, colours.label = "chosen ring k";
  const std::vector<Rgb> colour = colours_of(work, ring, colours);
  Shape shape = shape_of(mesh);
  shape.face_colour = colour;

  constexpr Real kRadius = 0.012;  // diagonals
  Lines lines;
  std::vector<Vec3> place;
  for (const Index input : marked) {
    const auto at = std::find(surface.order.vertex.begin(), surface.order.vertex.end(), input);
    if (at == surface.order.vertex.end())
      throw Error(ErrorCode::bad_argument, "vertex " + std::to_string(input) + " does not exist or no face uses it");
    const auto v = static_cast<Index>(at - surface.order.vertex.begin());
    place.push_back(mesh.point(v));
    lines.add(circle(place.back(), surface.face_normal[mesh.vertex_faces.row(v)[0]], kRadius), {kMark, 3});
  }
  FitOptions fit;
  fit.width = 620, fit.height = 560;
  const Camera camera = fit_camera_tightly(work, shape, view ? *view : best_view(work, shape), fit, 200);
  Image image = render(work, shape, lines, camera);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Projected p = camera.project(place[i]);
    const std::string letter(1, static_cast<char>('A' + i % 26));
    const float x = static_cast<float>(p.x + camera.scale * kRadius) + 4, y = static_cast<float>(p.y) - 4;
    draw_text(image, x, y, letter, {18.0f, 0.36f, {255, 255, 255}});
    draw_text(image, x, y, letter, {18.0f, 0.17f, kMark});
  }
  return with_scale_bar(image, colours);
}

}  // namespace intarsia::tools
