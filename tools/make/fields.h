// The closed shapes as fields.
#pragma once

#include <memory>

#include "tools/make/field.h"

namespace intarsia::tools {

std::unique_ptr<Field> sphere_field(Real radius);
std::unique_ptr<Field> ellipsoid_field(Real a, Real b, Real c);
std::unique_ptr<Field> torus_field(Real ring, Real tube);                 // about the z axis
std::unique_ptr<Field> rounded_box_field(const Vec3& half, Real fillet);  // half sizes include the fillet
std::unique_ptr<Field> star_field(Real petals, Real depth, Real crease, Real twist);
// A point on the crest of a ridge; height: sine of the latitude before z is squeezed, -1..1.
Vec3 star_crest(Real petals, Real depth, Real crease, Real twist, int ridge, Real height);
std::unique_ptr<Field> head_field(Real bumps);
std::unique_ptr<Field> part_field(Real fillet, Real edge);

}  // namespace intarsia::tools
