#include "tools/picture/camera.h"

#include <cmath>

#include "engine/parallel/reduce.h"

namespace intarsia::tools {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<Real>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<Real>::infinity());
  void add(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Box operator+(const Box& o) const { return {low.cwiseMin(o.low), high.cwiseMax(o.high)}; }
};

// Over corners, not vertices: files carry vertices that no face uses, sometimes far away.
template <class Map>
Box box_of_corners(const Work& work, const Shape& shape, const Map& map) {
  return reduce(
      work, Cost::light, shape.corner.size(), Box{},
      [&](std::size_t begin, std::size_t end) {
        Box box;
        for (std::size_t c = begin; c < end; ++c) box.add(map(shape.point(shape.corner[c])));
        return box;
      },
      [](const Box& a, const Box& b) { return a + b; });
}

// Everything but scale and position, in units where scale is 1; the box is that of the unplaced picture.
Camera unplaced(const Work& work, const Shape& shape, const View& view, Real perspective, Box& picture) {
  if (shape.corner.empty()) throw Error(ErrorCode::bad_argument, "a picture needs at least one face");
  Camera camera;
  camera.toward = view.toward.normalized();
  const Vec3 side = view.up.cross(camera.toward);
  if (!(side.norm() > 1e-9)) throw Error(ErrorCode::bad_argument, "the view direction and its up vector are parallel");
  camera.right = side.normalized();
  camera.up = camera.toward.cross(camera.right);
  camera.perspective = std::clamp(perspective, Real(0), Real(0.5));
  const Box box = box_of_corners(work, shape, [](const Vec3& p) { return p; });
  camera.centre = 0.5 * (box.low + box.high);
  camera.radius = 0.505 * (box.high - box.low).norm();
  if (!(camera.radius > 0)) camera.radius = 1;
  picture = box_of_corners(work, shape, [&](const Vec3& p) {
    const Projected q = camera.project(p);
    return Vec3(q.x, q.y, q.depth);
  });
  return camera;
}

void place(Camera& camera, const Box& picture, const FitOptions& o) {
  const Real w = o.width - 2 * o.margin, h = o.height - 2 * o.margin;
  if (!(w >= 1 && h >= 1)) throw Error(ErrorCode::bad_argument, "the picture is smaller than its margins");
  const Vec3 size = picture.high - picture.low;
  const Real tiny = 1e-9 * camera.radius;
  camera.scale = std::min(w / std::max(size.x(), tiny), h / std::max(size.y(), tiny));
  camera.scale = std::min(camera.scale, std::max(w, h) / (1e-3 * camera.radius));  // a segment-like object seen end on
  camera.x = 0.5 * o.width - camera.scale * 0.5 * (picture.low.x() + picture.high.x());
  camera.y = 0.5 * o.height - camera.scale * 0.5 * (picture.low.y() + picture.high.y());
  camera.width = o.width, camera.height = o.height;
}

}  // namespace

Camera fit_camera(const Work& work, const Shape& shape, const View& view, const FitOptions& options) {
  Box picture;
  Camera camera = unplaced(work, shape, view, options.perspective, picture);
  place(camera, picture, options);
  return camera;
}

Camera fit_camera_tightly(const Work& work, const Shape& shape, const View& view, const FitOptions& options,
                          int least_width) {
  Box picture;
  Camera camera = unplaced(work, shape, view, options.perspective, picture);
  place(camera, picture, options);
  const auto shrunk = [&](Real size, int largest) {
    const Real wanted = std::ceil(camera.scale * size + 2 * options.margin);
    return static_cast<int>(std::clamp(wanted, Real(std::min(least_width, largest)), Real(largest)));
  };
  FitOptions tight = options;
  tight.width = shrunk(picture.high.x() - picture.low.x(), options.width);
  tight.height = shrunk(picture.high.y() - picture.low.y(), options.height);
  place(camera, picture, tight);
  return camera;
}

}  // namespace intarsia::tools
