// From options to a shape: the parameters looked up, the field or grid built. Inside tools/make only.
#pragma once

#include <memory>
#include <optional>

#include "tools/make/field.h"
#include "tools/make/grid.h"
#include "tools/make/shape.h"

namespace intarsia::tools {

// A closed shape has a field; a sheet its profile; the sharp cube only its half size.
struct MadeShape {
  std::shared_ptr<const Field> field;
  std::optional<Sheet> sheet;
  Real cube_half = 0;
};

// The value given, or the default. Requires: checked options.
Real parameter(const MakeOptions& options, const char* name);

MadeShape build_shape(const MakeOptions& options);

}  // namespace intarsia::tools
