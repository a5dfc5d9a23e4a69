// How bright a face is at a place of the picture, whatever its colour.
#pragma once

#include "tools/picture/normals.h"
#include "tools/picture/raster.h"

namespace intarsia::tools {

struct Brightness {
  Real diffuse;  // factor of the colour
  Real gloss;    // white added to it, linear
  bool back;     // the back of the face is seen
};

// Light of a key, a fill, a sky and a rim that are fixed to the viewer.
class Lamp {
 public:
  // Views of shape and normals must outlive the lamp.
  Lamp(const Shape& shape, const ShadingNormals& normals, const Camera& camera)
      : shape_(shape), normals_(normals), camera_(camera) {}

  // Face f at pixel position (x, y), which it covers. openness: 1 in the open, 0 in the deepest hollow.
  Brightness at(Index f, Real x, Real y, Real openness) const;

 private:
  Vec3 smooth_normal(const Index* v, const Vec3 p[3], const Vec3& face_normal, Real x, Real y) const;

  const Shape& shape_;
  const ShadingNormals& normals_;
  const Camera& camera_;
};

}  // namespace intarsia::tools
