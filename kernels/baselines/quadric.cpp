#include "kernels/baselines/quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace intarsia::kernels {
namespace {

using Matrix3 = Eigen::Matrix3d;

// The samples seen from their middle, at a mean radius of 1.
struct Frame {
  std::span<const QuadricSample> samples;
  Vec3 origin = Vec3::Zero(), mean_normal = Vec3::Zero();
  Real scale = 1, weight = 0;

  explicit Frame(std::span<const QuadricSample> all) : samples(all) {
    for (const auto& s : all) origin += s.weight * s.middle(), mean_normal += s.weight * s.normal, weight += s.weight;
    if (!(weight > 0)) {
      origin = all[0].middle();
      return;
    }
    origin /= weight, mean_normal /= weight;
    Real square = 0;
    for (const auto& s : all)
      for (const Vec3& p : s.corner) square += s.weight / 3 * (p - origin).squaredNorm();
    if (square > 0) scale = std::sqrt(square / weight);
  }
  Vec3 local(const Vec3& p) const { return (p - origin) / scale; }

  // body(point, weight) for every corner.
  template <class Body>
  void for_corners(const Body& body) const {
    for (const auto& s : samples)
      for (const Vec3& p : s.corner) body(local(p), s.weight / (3 * weight));
  }
  // Eigenvectors of sum w (n - shift)(n - shift)^T, ascending eigenvalues.
  Matrix3 normal_axes(const Vec3& shift) const {
    Matrix3 m = Matrix3::Zero();
    for (const auto& s : samples) m += s.weight / weight * (s.normal - shift) * (s.normal - shift).transpose();
    return Eigen::SelfAdjointEigenSolver<Matrix3>(m).eigenvectors();
  }
};

// Taubin's fit over basis functions without the constant, which is deflated: minimises the variance of f over the mean
// square of its gradient. basis(q, phi, dphi): values and gradients (columns). Returns the coefficients, then c.
template <int N, class Basis>
Eigen::Matrix<Real, N + 1, 1> taubin(const Frame& frame, const Basis& basis) {
  using Vector = Eigen::Matrix<Real, N, 1>;
  using Square = Eigen::Matrix<Real, N, N>;
  Vector mean = Vector::Zero(), phi;
  Eigen::Matrix<Real, 3, N> slope;
  frame.for_corners([&](const Vec3& q, Real w) {
    basis(q, phi, slope);
    mean += w * phi;
  });
  Square spread = Square::Zero(), slopes = Square::Zero();
  frame.for_corners([&](const Vec3& q, Real w) {
    basis(q, phi, slope);
    spread += w * (phi - mean) * (phi - mean).transpose();
    slopes += w * slope.transpose() * slope;
  });
  slopes += 1e-9 * slopes.trace() / N * Square::Identity();  // singular on planes and where a variable is missing
  const Eigen::GeneralizedSelfAdjointEigenSolver<Square> solver(spread, slopes);
  Eigen::Matrix<Real, N + 1, 1> u;
  u.template head<N>() = solver.eigenvectors().col(0);
  u[N] = -mean.dot(solver.eigenvectors().col(0));
  return u;
}

void fit_plane(const Frame& frame, Real normal_weight, Quadric& q) {
  const Real turn = normal_weight / (frame.scale * frame.scale);
  Matrix3 m = Matrix3::Zero();
  frame.for_corners([&](const Vec3& p, Real w) { m += w * p * p.transpose(); });
  // The normals decide where the points do not, on strips and single triangles.
  const Real share = std::max(turn, 1e-6) / frame.weight;
  for (const auto& s : frame.samples) m -= share * s.weight * s.normal * s.normal.transpose();
  q.b = Eigen::SelfAdjointEigenSolver<Matrix3>(m).eigenvectors().col(0);
  q.c = 0;
}

void fit_sphere(const Frame& frame, Quadric& q) {
  const auto u = taubin<4>(frame, [](const Vec3& p, auto& phi, auto& slope) {
    phi << p.squaredNorm(), p.x(), p.y(), p.z();
    slope.col(0) = 2 * p;
    slope.template rightCols<3>().setIdentity();
  });
  q.a = u[0] * Matrix3::Identity(), q.b = u.segment<3>(1), q.c = u[4];
}

void fit_cylinder(const Frame& frame, Quadric& q) {
  const Matrix3 axes = frame.normal_axes(Vec3::Zero());  // normals are square to the axis
  const Vec3 e = axes.col(1), g = axes.col(2);
  const auto u = taubin<3>(frame, [&](const Vec3& p, auto& phi, auto& slope) {
    const Real x = p.dot(e), y = p.dot(g);
    phi << x * x + y * y, x, y;
    slope.col(0) = 2 * (x * e + y * g);
    slope.col(1) = e, slope.col(2) = g;
  });
  q.a = u[0] * (e * e.transpose() + g * g.transpose());
  q.b = u[1] * e + u[2] * g, q.c = u[3];
}

// Normals make one angle with the axis; all tangent planes meet in the apex.
bool fit_cone(const Frame& frame, Quadric& q) {
  const Vec3 axis = frame.normal_axes(frame.mean_normal).col(0);
  Matrix3 m = Matrix3::Zero();
  Vec3 right = Vec3::Zero();
  for (const auto& s : frame.samples) {
    const Real w = s.weight / frame.weight;
    m += w * s.normal * s.normal.transpose();
    right += w * s.normal * s.normal.dot(frame.local(s.middle()));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(m);
  if (!(solver.eigenvalues()[0] > 1e-6 * solver.eigenvalues()[2])) return false;  // a cylinder or a plane
  const Vec3 apex =
      solver.eigenvectors() * (solver.eigenvectors().transpose() * right).cwiseQuotient(solver.eigenvalues());
  Real along = 0, square = 0, other = 0;
  frame.for_corners([&](const Vec3& p, Real w) {
    const Real d = axis.dot(p - apex);
    along += w * d * d, square += w * (p - apex).squaredNorm();
    other += w * (d > 0 ? 1 : 0);
  });
  if (!(square > 0) || (other > 0.02 && other < 0.98)) return false;  // both halves of the double cone
  const Real cosine2 = along / square;
  q.a = cosine2 * Matrix3::Identity() - axis * axis.transpose();
  q.b = -2 * (q.a * apex), q.c = apex.dot(q.a * apex);
  return true;
}

void fit_general(const Frame& frame, Quadric& q) {
  const auto u = taubin<9>(frame, [](const Vec3& p, auto& phi, auto& slope) {
    const Real x = p.x(), y = p.y(), z = p.z();
    phi << x * x, y * y, z * z, x * y, y * z, z * x, x, y, z;
    slope << 2 * x, 0, 0, y, 0, z, 1, 0, 0,  //
        0, 2 * y, 0, x, z, 0, 0, 1, 0,       //
        0, 0, 2 * z, 0, y, x, 0, 0, 1;
  });
  q.a << u[0], u[3] / 2, u[5] / 2, u[3] / 2, u[1], u[4] / 2, u[5] / 2, u[4] / 2, u[2];
  q.b = u.segment<3>(6), q.c = u[9];
}

// Outward, with a floor for the gradient.
void settle(const Frame& frame, Quadric& q) {
  Real facing = 0, slope = 0;
  for (const auto& s : frame.samples) {
    const Vec3 g = q.gradient(s.middle());
    facing += s.weight * s.normal.dot(g), slope += s.weight * g.norm();
  }
  if (facing < 0) q.a = -q.a, q.b = -q.b, q.c = -q.c;
  if (frame.weight > 0) q.least_gradient = 1e-6 * slope / frame.weight;
}

Quadric fit_type(const Frame& frame, QuadricType type, Real normal_weight) {
  Quadric q;
  q.origin = frame.origin, q.scale = frame.scale, q.type = type;
  bool fits = frame.weight > 0;
  if (fits) switch (type) {
      case QuadricType::plane:
        fit_plane(frame, normal_weight, q);
        break;
      case QuadricType::sphere:
        fit_sphere(frame, q);
        break;
      case QuadricType::cylinder:
        fit_cylinder(frame, q);
        break;
      case QuadricType::cone:
        fits = fit_cone(frame, q);
        break;
      case QuadricType::general:
        fit_general(frame, q);
        break;
    }
  if (!fits || !(q.a.allFinite() && q.b.allFinite() && std::isfinite(q.c))) {
    q = Quadric{};
    q.origin = frame.origin, q.scale = frame.scale;
    if (frame.weight > 0)
      fit_plane(frame, normal_weight, q);
    else
      q.b = Vec3::UnitZ();
  }
  settle(frame, q);
  return q;
}

}  // namespace

Real quadric_error(const Quadric& q, const QuadricSample& s, Real normal_weight) {
  Real square = 0;
  for (const Vec3& p : s.corner) {
    const Real d = q.distance(p);
    square += d * d / 3;
  }
  if (normal_weight > 0) {
    const Vec3 g = q.gradient(s.middle());
    const Real length = std::max(g.norm(), q.least_gradient);
    square += normal_weight * (length > 0 ? (s.normal - g / length).squaredNorm() : 1);
  }
  return square;
}

Real quadric_error(const Quadric& q, std::span<const QuadricSample> samples, Real normal_weight) {
  Real error = 0, weight = 0;
  for (const auto& s : samples) error += s.weight * quadric_error(q, s, normal_weight), weight += s.weight;
  return weight > 0 ? error / weight : 0;
}

Quadric fit_quadric(std::span<const QuadricSample> samples, QuadricType type, Real normal_weight) {
  return fit_type(Frame(samples), type, normal_weight);
}

Quadric fit_quadric(std::span<const QuadricSample> samples, const QuadricOptions& options) {
  const Frame frame(samples);
  constexpr QuadricType kLadder[] = {QuadricType::plane, QuadricType::sphere, QuadricType::cylinder, QuadricType::cone,
                                     QuadricType::general};
  const std::size_t types = samples.size() < options.least ? 1 : std::size(kLadder);
  std::array<Quadric, std::size(kLadder)> fit;
  std::array<Real, std::size(kLadder)> error;
  for (std::size_t i = 0; i < types; ++i) {
    fit[i] = fit_type(frame, kLadder[i], options.normal_weight);
    error[i] = std::sqrt(quadric_error(fit[i], samples, options.normal_weight));
  }
  const Real best = *std::min_element(error.begin(), error.begin() + static_cast<std::ptrdiff_t>(types));
  std::size_t i = 0;
  while (i + 1 < types && !(error[i] <= options.within * best + options.slack)) ++i;
  return fit[i];
}

}  // namespace intarsia::kernels
