// Choice of the ring that a vertex is fitted in, from its surface variation (Cao, Yan, Wonka 2014, section 3.2).
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

struct SelectOptions {
  Real flat = 0.1;         // paper: omega_-; below it a ring sees a plane (a crease of 35 degrees)
  Real bent = 0.25;        // paper: omega_+; the variation of a well chosen ring (a crease of 53 degrees)
  Real slack = 0.02;       // a smaller ring wins within this distance; 0 = the letter
  bool jump = true;        // third case: largest relative jump in either direction; false = the letter (largest drop)
  int least_fit = 2;       // no fit in a smaller ring
  bool regularise = true;  // lower median of the fit ring over the closed 1-ring

  static SelectOptions paper() {
    SelectOptions o;
    o.slack = 0, o.jump = false, o.least_fit = 1, o.regularise = false;
    return o;
  }
};

enum class Bend : std::uint8_t {
  flat,
  between,
  bent
};  // fewer than, exactly, more than half of the rings reach omega_-

struct Choice {
  int ring;  // 1 .. variation.size()
  Bend bend;
};

// The rule itself, for any number of rings. Requires: variation not empty.
Choice choose_ring(std::span<const Real> variation, const SelectOptions& options);

// The ring or disc code to fit for flat vertices that look bent in larger discs: the first code whose variation is
// within `slack` of the closest to omega_+, or 0 if none reaches omega_-. variation[i] belongs to codes[i] = first + i.
int choose_disc(std::span<const Real> variation, int first, const SelectOptions& options);

// out[v] = lower median of `in` over v and its neighbours; entries 0 do not take part, and stay 0.
// Requires: out.size() == in.size() == vertices; different arrays.
void median_over_neighbours(const Work& work, CsrView neighbours, std::span<const std::uint8_t> in,
                            std::span<std::uint8_t> out);

}  // namespace intarsia::kernels
