#include "tools/picture/light.h"

#include <cmath>

namespace intarsia::tools {
namespace {

// x right, y up, z towards the viewer; unit vectors.
const Vec3 kKey = Vec3(-0.42, 0.66, 0.62).normalized();
const Vec3 kFill = Vec3(0.85, 0.15, 0.50).normalized();
const Vec3 kHalf = (kKey + Vec3(0, 0, 1)).normalized();  // between key and eye

Brightness lit(const Vec3& n, Real openness, bool back) {
  const Real key = std::max(0.0, (n.dot(kKey) + 0.10) / 1.10), fill = std::max(0.0, (n.dot(kFill) + 0.25) / 1.25);
  const Real sky = 0.5 + 0.5 * n.y(), graze = 1 - n.z(), shine = std::max(0.0, n.dot(kHalf));
  const Real s4 = shine * shine * shine * shine, s16 = s4 * s4 * s4 * s4;
  Brightness b;
  b.diffuse = 0.82 * key * (0.35 + 0.65 * openness) + openness * (0.25 * fill + 0.18 * sky + 0.10);
  b.gloss = openness * (0.15 * graze * graze * graze * sky + (back ? 0 : 0.08 * s16 * s16 * s4));
  b.back = back;
  return b;
}

// Weights of the corners at a place of the picture; perspective within a face is ignored.
Vec3 weights(const Camera& camera, const Vec3 p[3], Real px, Real py) {
  Real x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    const Projected q = camera.project(p[i]);
    x[i] = q.x - px, y[i] = q.y - py;
  }
  Vec3 w(x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]);
  const Real area = w.sum();
  if (!(std::abs(area) > 1e-12)) return Vec3::Constant(1.0 / 3);
  w = (w / area).cwiseMax(0.0);  // the middle of some samples can fall just outside a sliver
  return w / w.sum();
}

}  // namespace

Vec3 Lamp::smooth_normal(const Index* v, const Vec3 p[3], const Vec3& face_normal, Real x, Real y) const {
  const bool given = shape_.vertex_normal.size() > 0;
  if (!shape_.smooth || (!given && normals_.empty())) return face_normal;
  const Vec3 w = weights(camera_, p, x, y);
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 m = given ? shape_.vertex_normal[v[i]] : normals_[v[i]];
    const Real size = m.norm();
    // Across a crease the normal of the vertex belongs to neither side.
    sum += w[i] * (m.dot(face_normal) > 0.87 * size ? Vec3(m / size) : face_normal);
  }
  const Real size = sum.norm();
  return size > 0 ? Vec3(sum / size) : face_normal;
}

Brightness Lamp::at(Index f, Real x, Real y, Real openness) const {
  const Index* v = shape_.corner.data() + 3 * std::size_t{f};
  const Vec3 p[3] = {shape_.point(v[0]), shape_.point(v[1]), shape_.point(v[2])};
  const Vec3 cross = (p[1] - p[0]).cross(p[2] - p[0]);
  const Real length = cross.norm();
  const Vec3 face_normal = length > 0 ? Vec3(cross / length) : camera_.toward;
  const Vec3 to_eye = camera_.toward - (camera_.perspective / camera_.radius) * (p[0] - camera_.centre);
  const bool back = face_normal.dot(to_eye) < 0;
  const Vec3 n = (back ? -1 : 1) * smooth_normal(v, p, face_normal, x, y);
  Vec3 local(camera_.right.dot(n), camera_.up.dot(n), camera_.toward.dot(n));
  if (local.z() < 0.02) local.z() = 0.02, local.normalize();  // interpolated normals may turn away at a silhouette
  return lit(local, openness, back);
}

}  // namespace intarsia::tools
