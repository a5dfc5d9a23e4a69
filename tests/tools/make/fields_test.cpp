#include "tools/make/fields.h"

#include <doctest/doctest.h>

#include "engine/base/random.h"
#include "tools/make/catalogue.h"

using namespace intarsia;
using namespace intarsia::tools;

namespace {

// Every closed shape, with its defaults and with each parameter at its ends (where that is a shape).
template <class Body>
void for_each_field(const Body& body) {
  for (const ShapeInfo& info : shapes()) {
    std::vector<MakeOptions> variants(1);
    variants[0].shape = info.name;
    for (const ShapeParameter& p : info.parameters) {
      if (p.most >= 100) continue;  // a size: scaling, or no longer a shape beside the others
      for (const Real value : {p.least, p.most}) {
        MakeOptions o;
        o.shape = info.name;
        o.parameters[p.name] = value;
        variants.push_back(o);
      }
    }
    for (const MakeOptions& o : variants) {
      const MadeShape shape = build_shape(o);
      if (!shape.field) continue;
      std::string name = info.name;
      for (const auto& [key, value] : o.parameters) name += " " + key + "=" + std::to_string(value);
      CAPTURE(name);
      body(*shape.field);
    }
  }
}

Vec3 point_in(const Vec3& low, const Vec3& high, const Random& random, std::uint64_t i) {
  return low + Vec3(random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2)).cwiseProduct(high - low);
}

}  // namespace

TEST_CASE("a field is a lower bound of the distance: its slope is at most 1") {
  for_each_field([](const Field& field) {
    const Random random(7, 1);
    const Vec3 margin = 0.2 * (field.high - field.low);
    Real steepest = 0;
    for (std::uint64_t i = 0; i < 40000; ++i) {
      const Vec3 p = point_in(field.low - margin, field.high + margin, random, i);
      const Vec3 d = point_in(Vec3::Constant(-1), Vec3::Constant(1), random, i + (1u << 30));
      const Real scale = std::pow(10.0, -4 * random.uniform(i, 9));
      const Vec3 q = p + scale * d;
      steepest = std::max(steepest, std::abs(field.value(p) - field.value(q)) / (p - q).norm());
    }
    CHECK(steepest <= 1 + 1e-9);
    CHECK(steepest > 0.1);  // not so flat that the search for the surface becomes slow
  });
}

TEST_CASE("gradients are those of the values") {
  for_each_field([](const Field& field) {
    const Random random(8, 2);
    int bad = 0, near = 0, different = 0;
    const Real size = (field.high - field.low).norm(), h = 1e-6 * size;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Vec3 p = point_in(field.low, field.high, random, i);
      Vec3 g;
      const Real f = field.value(p, g);
      different += std::abs(f - field.value(p)) > 1e-14 * size;
      if (std::abs(f) > 0.02 * size) continue;
      ++near;
      Vec3 numeric;
      for (int a = 0; a < 3; ++a) {
        Vec3 step = Vec3::Zero();
        step[a] = h;
        numeric[a] = (field.value(p + step) - field.value(p - step)) / (2 * h);
      }
      bad += (g - numeric).norm() > 1e-4;
    }
    CHECK(different == 0);
    CHECK(near > 50);
    CHECK(bad <= near / 1000 + 3);  // a point may lie within h of a joint of two pieces
  });
}

TEST_CASE("the box of a field holds its surface") {
  for_each_field([](const Field& field) {
    const Random random(9, 3);
    int inside = 0;
    for (std::uint64_t i = 0; i < 60000; ++i) {  // points on the box
      Vec3 p = point_in(field.low, field.high, random, i);
      const int side = static_cast<int>(i % 6);
      p[side / 2] = side & 1 ? field.high[side / 2] : field.low[side / 2];
      inside += field.value(p) < -1e-12;
    }
    CHECK(inside == 0);
  });
}
