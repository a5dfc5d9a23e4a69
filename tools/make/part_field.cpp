// A cast machine part after the manner of a rocker arm.
#include "tools/make/fields.h"
#include "tools/make/solids.h"

namespace intarsia::tools {

namespace {

struct Part {
  Real fillet, edge;

  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    // Lever: two tapered bars, the long one with a pocket on either face.
    const T pocket =
        extrude_round(tapered_bar(x, y, 0.2, 0.02, 0.30, 2.0, 0.4, 0.13), T(magnitude(z) - 0.34), 0.22, edge);
    T bar = extrude_round(tapered_bar(x, y, 0, 0, 0.52, 2.1, 0.42, 0.30), z, 0.21, edge);
    bar = intersect_round(bar, T(-pocket), edge);
    const T tail = extrude_round(tapered_bar(x, y, 0, 0, 0.46, -1.75, 0.1, 0.36), T(z + 0.02), 0.19, edge);

    // Bosses.
    const T main_axis = length(x, y), small_axis = length(T(x - 2.1), T(y - 0.42));
    const T main_boss = extrude_round(T(main_axis - 0.66), T(z - 0.08), 0.62, edge);
    const T small_boss = extrude_round(T(small_axis - 0.40), z, 0.40, edge);

    // Block at the tail's end, its pad arched.
    const Real c = 0.9781476007338057, s = 0.20791169081775934;  // turned by 12 degrees
    const T bx = (x + 1.95) * c + (y - 0.12) * s, by = (y - 0.12) * c - (x + 1.95) * s;
    T block = box_round(bx, by, T(z + 0.06), {0.34, 0.46, 0.44}, edge);
    block = intersect_round(block, T(length(bx, T(z + 0.85)) - 1.14), edge);

    // Pin with a hexagonal collar on the tail.
    const T px = x + 1.12, py = y - 0.06;
    const T collar = extrude_round(hexagon(px, py, 0.25), T(z - 0.2), 0.18, 0.6 * edge);
    const T pin = extrude_round(T(length(px, py) - 0.15), T(z - 0.34), 0.36, 1.5 * edge);

    T body = unite_round(bar, tail, fillet);
    body = unite_round(body, main_boss, fillet);
    body = unite_round(body, small_boss, fillet);
    body = unite_round(body, block, fillet);
    body = unite_round(body, unite_round(collar, pin, 0.5 * fillet), 0.5 * fillet);

    // Through holes.
    body = intersect_round(body, T(0.40 - main_axis), edge);
    body = intersect_round(body, T(0.19 - small_axis), edge);
    return body * 0.5;  // where three bodies and a hole meet, the roundings can add up to this slope
  }
};

}  // namespace

std::unique_ptr<Field> part_field(Real fillet, Real edge) {
  return make_field(Part{fillet, edge}, Vec3(-2.5, -0.8, -0.65), Vec3(2.6, 0.95, 0.8));
}

}  // namespace intarsia::tools
