// What a triangle soup must fulfil before it is a surface the method can take.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Accepts isolated vertices and zero-area faces with three different corners. Linear, parallel.
// Ensures on return: corner ids are in range and different within a face; used coordinates are finite; some face has
// area; every edge has one face or two oppositely directed ones; the faces of every vertex form one fan.
// Errors: too_large if corners do not fit Index; rejected otherwise, for the first failing check in the order above and
// there for the smallest element: face (as Soup::source_of names it) or, for fans and coordinates, vertex.
void check_soup(const Work& work, const Soup& soup);

// The part of it that no cleaning can mend: ids in range, coordinates finite, some area. Errors: as above.
void check_corners(const Work& work, const Soup& soup);

// What the rest would say, without refusing. Requires: check_corners accepts the soup.
struct SoupState {
  bool repeated_corners = false;        // some triangle has a corner twice; then nothing else is looked at
  bool is_surface = false;              // check_soup accepts
  std::vector<std::uint8_t> on_border;  // per vertex, 1 on a border edge; exact where is_surface
};
SoupState look_at_soup(const Work& work, const Soup& soup);

}  // namespace intarsia::kernels
