#include "tools/make/shape.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"
#include "engine/parallel/reduce.h"
#include "tools/make/catalogue.h"
#include "tools/make/surface_net.h"

namespace intarsia::tools {

namespace {

constexpr Real kPilot = 40'000;  // triangles of the small mesh from which sizes are foretold

std::unique_ptr<MeshSource> source_of(const Work& work, const MadeShape& shape, Real size, const Disturbance& d) {
  if (shape.field) return std::make_unique<SurfaceNet>(work, shape.field, size, d);
  const std::uint64_t triangles = std::llround(size);
  return shape.sheet ? sheet_grid(*shape.sheet, triangles, d) : cube_grid(shape.cube_half, triangles, d);
}

// Lattice spacing that gives `wanted` triangles: their number grows like 1 / spacing^2, so a coarse count foretells a
// fine one.
Real spacing_for(const Work& work, const Field& field, Real wanted, std::uint64_t seed) {
  Real spacing = (field.high - field.low).norm() / 30;
  Real goal = std::min(wanted, kPilot);
  for (int round = 0; round < 8; ++round) {
    const Real count = 2 * static_cast<Real>(Lattice(work, field, spacing, seed).quad_count());
    if (count == 0) {
      spacing *= 0.5;
      continue;
    }
    const bool good = std::abs(count / goal - 1) < 0.01;
    if (good && goal == wanted) break;
    if (good || round >= 2) goal = wanted;
    spacing *= std::sqrt(count / goal);
    if (good && wanted > 4 * kPilot) break;  // near enough to its limit: the fine count differs by less than 1 %
  }
  return spacing;
}

struct Measure {
  Real mean_edge = 0, diagonal = 0;
};

// Every inner edge counts twice in the mean.
Measure measure(const Work& work, const MeshSource& source) {
  struct Sum {
    Real edges = 0;
    Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  };
  std::vector<Vec3> point(source.vertex_count());
  std::vector<Index> corner(3 * source.face_count());
  for_each(work, Cost::single, source.piece_count(), [&](std::size_t b) {
    Piece piece;
    source.make(work, b, piece);
    std::copy(piece.point.begin(), piece.point.end(), point.begin() + source.first_vertex(b));
    std::copy(piece.corner.begin(), piece.corner.end(), corner.begin() + 3 * source.first_face(b));
  });
  Sum total;
  for (const Vec3& p : point) total.low = total.low.cwiseMin(p), total.high = total.high.cwiseMax(p);
  for (std::size_t c = 0; c < corner.size(); ++c)
    total.edges += (point[corner[c]] - point[corner[c % 3 == 2 ? c - 2 : c + 1]]).norm();
  return {total.edges / static_cast<Real>(std::max<std::size_t>(1, corner.size())), (total.high - total.low).norm()};
}

}  // namespace

void check(const MakeOptions& options) {
  const ShapeInfo& info = shape_info(options.shape);
  const auto in_range = [](const std::string& name, Real value, Real least, Real most) {
    if (!(value >= least && value <= most))
      throw Error(ErrorCode::bad_argument, name + " must lie between " + std::to_string(least) + " and " +
                                               std::to_string(most) + ", not " + std::to_string(value));
  };
  if (options.triangles < 100) throw Error(ErrorCode::bad_argument, "a shape needs at least 100 triangles");
  if (options.triangles > 4'000'000'000)
    throw Error(ErrorCode::too_large, "at most 4000000000 triangles: vertex numbers in a file have 31 bits");
  in_range("irregularity", options.irregularity, 0, 1);
  in_range("noise as a part of the diagonal", options.noise_diagonal, 0, 1);
  in_range("noise in edge lengths", options.noise_edges, 0, 100);
  for (const auto& parameter : options.parameters) {
    const std::string& name = parameter.first;
    const Real value = parameter.second;
    const auto p = std::find_if(info.parameters.begin(), info.parameters.end(),
                                [&](const ShapeParameter& q) { return q.name == name; });
    if (p == info.parameters.end())
      throw Error(ErrorCode::bad_argument, "shape " + info.name + " has no parameter \"" + name + "\"");
    in_range("parameter " + name + " of shape " + info.name, value, p->least, p->most);
  }
}

std::unique_ptr<MeshSource> plan_shape(const Work& work, const MakeOptions& options) {
  check(options);
  const MadeShape shape = build_shape(options);
  const Real wanted = static_cast<Real>(options.triangles);
  const auto size_for = [&](Real triangles) {
    return shape.field ? spacing_for(work, *shape.field, triangles, options.seed) : triangles;
  };
  Disturbance disturbance{options.irregularity, 0, options.seed};
  const Real size = size_for(wanted);
  if (options.noise_diagonal > 0 || options.noise_edges > 0) {
    const Real small = std::min(wanted, kPilot), pilot_size = small < wanted ? size_for(small) : size;
    const auto pilot = source_of(work, shape, pilot_size, disturbance);
    const Measure m = measure(work, *pilot);
    const Real edge = m.mean_edge * (shape.field ? size / pilot_size : std::sqrt(small / wanted));
    disturbance.noise = std::hypot(options.noise_diagonal * m.diagonal, options.noise_edges * edge);
  }
  auto source = source_of(work, shape, size, disturbance);
  if (source->vertex_count() > 0x7fffffff)
    throw Error(ErrorCode::too_large, "more vertices than a 31-bit number can name: ask for fewer triangles");
  return source;
}

Soup make_shape(const Work& work, const MakeOptions& options) {
  const auto source = plan_shape(work, options);
  Soup soup;
  for (auto* a : {&soup.x, &soup.y, &soup.z}) a->resize(source->vertex_count());
  soup.corner.resize(3 * source->face_count());
  for_each(work, Cost::single, source->piece_count(), [&](std::size_t b) {
    Piece piece;
    source->make(work, b, piece);
    const std::size_t first = source->first_vertex(b);
    for (std::size_t i = 0; i < piece.point.size(); ++i) {
      soup.x[first + i] = piece.point[i].x();
      soup.y[first + i] = piece.point[i].y();
      soup.z[first + i] = piece.point[i].z();
    }
    std::copy(piece.corner.begin(), piece.corner.end(), soup.corner.begin() + 3 * source->first_face(b));
  });
  return soup;
}

struct ShapeDistance::Inside {
  MadeShape shape;
};

ShapeDistance::ShapeDistance(const MakeOptions& options) {
  check(options);
  inside_ = std::make_unique<Inside>(Inside{build_shape(options)});
}

ShapeDistance::~ShapeDistance() = default;

Real ShapeDistance::operator()(const Vec3& p) const {
  const MadeShape& shape = inside_->shape;
  if (shape.sheet) return shape.sheet->profile.distance(p);
  if (!shape.field) {
    const Vec3 q = p.cwiseAbs() - Vec3::Constant(shape.cube_half);
    const Real inner = q.maxCoeff();
    return inner <= 0 ? -inner : q.cwiseMax(0.0).norm();
  }
  Vec3 gradient;
  const Real f = shape.field->value(p, gradient), g = gradient.norm();
  return std::abs(f) / (g > 0 ? g : 1);
}

}  // namespace intarsia::tools
