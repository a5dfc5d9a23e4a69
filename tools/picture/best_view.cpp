#include "tools/picture/best_view.h"

#include <array>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "tools/picture/raster.h"

namespace intarsia::tools {
namespace {

constexpr std::size_t kSampleFaces = 12'000;
constexpr int kPicture = 96;  // pixels
constexpr Real kPi = 3.14159265358979323846;

// Every n-th face, enlarged about its middle so that together they still cover the surface.
struct Sample {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;
  std::vector<Vec3> normal;  // zero if degenerate
  std::vector<Real> area;    // of the enlarged face
  Real total = 0;
  Shape shape() const {
    Shape s;
    s.x = x, s.y = y, s.z = z, s.corner = corner;
    return s;
  }
};

Sample sample_of(const Shape& shape) {
  Sample s;
  const std::size_t faces = shape.face_count(), step = (faces + kSampleFaces - 1) / kSampleFaces;
  const Real grow = std::sqrt(static_cast<Real>(step));
  for (std::size_t f = step / 2; f < faces; f += step) {
    const Index* v = shape.corner.data() + 3 * f;
    const Vec3 p[3] = {shape.point(v[0]), shape.point(v[1]), shape.point(v[2])};
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3, n = (p[1] - p[0]).cross(p[2] - p[0]);
    const Real length = n.norm();
    for (const Vec3& q : p) {
      const Vec3 r = middle + grow * (q - middle);
      s.corner.push_back(static_cast<Index>(s.x.size()));
      s.x.push_back(r.x()), s.y.push_back(r.y()), s.z.push_back(r.z());
    }
    s.normal.push_back(length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero()));
    s.area.push_back(0.5 * length * grow * grow);
    s.total += s.area.back();
  }
  return s;
}

// How well the object would stand with this direction upwards: a flat underside at the bottom, a low centre.
Real standing(const Sample& s, const Vec3& up) {
  Real low = std::numeric_limits<Real>::infinity(), high = -low, moment = 0;
  std::vector<Real> height(s.area.size());
  for (std::size_t f = 0; f < height.size(); ++f) {
    for (std::size_t i = 3 * f; i < 3 * f + 3; ++i) {
      const Real h = up.dot(Vec3(s.x[i], s.y[i], s.z[i]));
      low = std::min(low, h), high = std::max(high, h), height[f] += h / 3;
    }
    moment += s.area[f] * height[f];
  }
  const Real range = high - low;
  if (!(range > 0) || !(s.total > 0)) return 0;
  Real base = 0;
  for (std::size_t f = 0; f < height.size(); ++f)
    if (height[f] < low + 0.04 * range) base += s.area[f] * std::max(Real(0), -up.dot(s.normal[f]));
  // A surface cut open below: the missing cap is what keeps the area vectors from summing to zero.
  Vec3 opening = Vec3::Zero();
  for (std::size_t f = 0; f < height.size(); ++f) opening += s.area[f] * s.normal[f];
  base += std::max(Real(0), up.dot(opening));
  return 3 * base / s.total + 0.5 - (moment / s.total - low) / range;
}

Real score_of(const Sample& s, const Frame& frame) {
  constexpr int kBins = 54;  // of normals: a cube's sides, each 3 x 3
  std::array<Real, kBins> bin{};
  Real covered = 0, seen = 0, creases = 0;
  std::vector<std::uint8_t> visible(s.area.size(), 0);
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.columns; ++x) {
      const std::uint64_t key = frame.at(x, y);
      if (key == Frame::kEmpty) continue;
      covered += 1;
      const Index f = Frame::face_of(key);
      const Vec3& n = s.normal[f];
      visible[f] = 1;
      Eigen::Index axis = 0;
      const Real size = n.cwiseAbs().maxCoeff(&axis);
      if (!(size > 0)) continue;
      const auto third = [size](Real v) { return std::clamp(static_cast<int>((v / size + 1) * 1.5), 0, 2); };
      const int side = 2 * static_cast<int>(axis) + (n[axis] > 0 ? 1 : 0);
      bin[static_cast<std::size_t>(9 * side + 3 * third(n[(axis + 1) % 3]) + third(n[(axis + 2) % 3]))] += 1;
      for (int d = 0; d < 2; ++d) {
        const int qx = x + (d == 0), qy = y + (d == 1);
        if (qx >= frame.columns || qy >= frame.rows || frame.at(qx, qy) == Frame::kEmpty) continue;
        if (n.dot(s.normal[Frame::face_of(frame.at(qx, qy))]) < 0.8) creases += 0.5;
      }
    }
  for (std::size_t f = 0; f < visible.size(); ++f)
    if (visible[f]) seen += s.area[f];
  Real entropy = 0;
  for (Real b : bin)
    if (b > 0) entropy -= b / covered * std::log(b / covered);
  const Real pixels = static_cast<Real>(frame.columns) * frame.rows;
  return 1.0 * seen / std::max(s.total, Real(1e-300)) + 0.35 * entropy / std::log(Real(kBins)) +
         0.5 * covered / pixels + 1.8 * std::min(creases / pixels, Real(0.25));
}

}  // namespace

View best_view(const Work& work, const Shape& shape) {
  if (shape.corner.empty()) throw Error(ErrorCode::bad_argument, "a view needs at least one face");
  const Sample sample = sample_of(shape);
  const Shape coarse = sample.shape();
  const bool z_up = standing(sample, Vec3(0, 0, 1)) > standing(sample, Vec3(0, 1, 0)) + 0.05;
  const Vec3 up = z_up ? Vec3(0, 0, 1) : Vec3(0, 1, 0), front = z_up ? Vec3(0, -1, 0) : Vec3(0, 0, 1);
  const Vec3 side = up.cross(front);

  constexpr int kAround = 16;
  constexpr std::array<Real, 3> kElevation = {12, 22, 34};  // degrees above the horizon
  std::vector<View> candidate;
  for (Real degrees : kElevation)
    for (int i = 0; i < kAround; ++i) {
      const Real turn = 2 * kPi * (i + 0.35) / kAround, rise = degrees * kPi / 180;
      candidate.push_back(
          {std::cos(rise) * (std::cos(turn) * front + std::sin(turn) * side) + std::sin(rise) * up, up});
    }
  std::vector<Real> score(candidate.size());
  for_each(work, Cost::single, candidate.size(), [&](std::size_t i) {
    FitOptions fit;
    fit.width = fit.height = kPicture, fit.margin = 1;
    Camera camera = fit_camera(work, coarse, candidate[i], fit);
    Frame frame;
    rasterise(work, coarse, camera, 1, frame);
    // Makers tend to turn the front of a model this way; it decides between views that are nearly as good.
    score[i] = score_of(sample, frame) + 0.14 * candidate[i].toward.dot(front) - 0.14 * candidate[i].toward.dot(up);
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < score.size(); ++i)
    if (score[i] > score[best]) best = i;
  return candidate[best];
}

}  // namespace intarsia::tools
