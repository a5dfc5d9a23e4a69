// The shape of a model; included by the files of this folder only.
#pragma once

#include <vector>

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include "tools/step/cad_shape.h"

namespace intarsia::tools {

struct CadShape::Impl {
  TopoDS_Shape shape;
  std::vector<TopoDS_Face> face;  // as the model has them
  Real vertex_gap = 0;            // of the model, in the shape's units
};

struct BuiltShape {
  TopoDS_Shape shape;
  std::vector<TopoDS_Face> face;
};

BuiltShape build_shape(const CadModel& model, const Vec3& centre, Real scale);

}  // namespace intarsia::tools
