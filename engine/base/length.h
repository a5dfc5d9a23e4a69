// A length as users give it: in units of the model, of the bounding box or of the mesh.
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/types.h"

namespace intarsia {

struct Length {
  enum class Unit : std::uint8_t { model, diagonal, edge };
  Real value = 0;
  Unit unit = Unit::model;

  // In diagonals of the bounding box. mean_edge: in diagonals.
  Real in_diagonals(Real diagonal, Real mean_edge) const {
    return unit == Unit::model ? value / diagonal : unit == Unit::edge ? value * mean_edge : value;
  }
};

// "1.5": units of the model; "0.2%": of the diagonal; "3e": mean edge lengths. Finite, not negative.
// Errors: bad_argument naming the text.
Length parse_length(const std::string& text);
std::string text_of(const Length& length);

}  // namespace intarsia
