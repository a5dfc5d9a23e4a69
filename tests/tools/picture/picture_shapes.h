// Small surfaces and a camera whose pixels are the units of the first two coordinates.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "tools/picture/camera.h"

namespace intarsia::tools {

struct Triangles {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
      corner.push_back(static_cast<Index>(x.size()));
      x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
    }
  }
  Shape shape() const {
    Shape s;
    s.x = x, s.y = y, s.z = z, s.corner = corner;
    return s;
  }
};

// Orthographic, looking along -z, y downwards: the point (x, y, z) falls on the position (x, y) of the picture.
inline Camera pixel_camera(int width, int height) {
  Camera camera;
  camera.up = Vec3(0, -1, 0);
  camera.radius = 10;
  camera.width = width, camera.height = height;
  return camera;
}

// A sphere of latitude and longitude with shared vertices, counter-clockwise seen from outside.
inline Triangles sphere(int rings, int sectors) {
  Triangles s;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const Real a = 3.14159265358979 * i / rings, b = 2 * 3.14159265358979 * j / sectors;
      s.x.push_back(std::sin(a) * std::cos(b)), s.y.push_back(std::cos(a)), s.z.push_back(-std::sin(a) * std::sin(b));
    }
  const auto id = [sectors](int i, int j) { return static_cast<Index>(i * sectors + j % sectors); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) s.corner.insert(s.corner.end(), {id(i, j), id(i + 1, j), id(i, j + 1)});
      if (i + 1 < rings) s.corner.insert(s.corner.end(), {id(i, j + 1), id(i + 1, j), id(i + 1, j + 1)});
    }
  return s;
}

// A box from the origin to size, counter-clockwise seen from outside.
inline Triangles box(const Vec3& size) {
  Triangles b;
  for (int i = 0; i < 8; ++i)
    b.x.push_back(i & 1 ? size.x() : 0), b.y.push_back(i & 2 ? size.y() : 0), b.z.push_back(i & 4 ? size.z() : 0);
  b.corner = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
              2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return b;
}

}  // namespace intarsia::tools
