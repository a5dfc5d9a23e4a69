// Where the picture is taken from: a direction, a fit of the object into the picture, a projection.
#pragma once

#include "engine/parallel/work.h"
#include "tools/picture/shape.h"

namespace intarsia::tools {

// A direction of sight. toward points from the object to the viewer; up is the vertical of the picture. Unit vectors,
// not necessarily at right angles.
struct View {
  Vec3 toward = Vec3(0, 0, 1);
  Vec3 up = Vec3(0, 1, 0);
};

// A point in the picture: pixels from the left and the top, and a depth that grows away from the viewer. The depth is
// linear over a plane in picture space and lies in [0, 1] for points within the camera's radius.
struct Projected {
  Real x, y, depth;
};

struct Camera {
  Vec3 centre = Vec3::Zero();
  Vec3 right = Vec3(1, 0, 0), up = Vec3(0, 1, 0), toward = Vec3(0, 0, 1);  // orthonormal
  Real radius = 1;       // of a ball around centre that holds the object
  Real perspective = 0;  // radius / distance of the eye; 0 = orthographic; below 0.5
  Real scale = 1;        // pixels per unit of length in the plane through centre
  Real x = 0, y = 0;     // where centre falls in the picture, pixels
  int width = 1, height = 1;

  Projected project(const Vec3& p) const {
    const Vec3 d = p - centre;
    const Real z = toward.dot(d) / radius;
    const Real w = 1 / std::max(Real(1e-3), 1 - perspective * z);
    return {x + scale * w * right.dot(d), y - scale * w * up.dot(d), 0.5 - 0.5 * (1 - perspective) * w * z};
  }
  // How much the depth changes over a length that spans one pixel, near the centre.
  Real depth_per_pixel() const { return 0.5 * (1 - perspective) / (radius * scale); }
};

struct FitOptions {
  int width = 560, height = 560;  // pixels of the picture
  Real margin = 8;                // pixels left free on every side
  Real perspective = 0.16;        // mild: the eye is about six radii away
};

// A camera that shows all corners of the faces as large as the picture allows, centred.
// Requires: at least one face; view.toward and view.up not parallel.
// Errors: bad_argument if the picture is smaller than its margins or the view is degenerate.
Camera fit_camera(const Work& work, const Shape& shape, const View& view, const FitOptions& options = {});

// Like fit_camera, but the picture shrinks around the object: options give its largest width and height.
// Ensures: at least least_width wide and high, or as large as options where those are smaller.
Camera fit_camera_tightly(const Work& work, const Shape& shape, const View& view, const FitOptions& options,
                          int least_width);

}  // namespace intarsia::tools
