// What a triangle soup must fulfil before it is a surface the method can take.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Accepts isolated vertices and zero-area faces with three different corners. Linear, parallel.
// Ensures on return: corner ids are in range and different within a face; used coordinates are finite; some face has
// area; every edge has one face or two oppositely directed ones; the faces of every vertex form one fan.
// Errors: too_large if corners do not fit Index; rejected otherwise, for the first failing check in the order above and
// there for the smallest element: face (as Soup::source_of names it) or, for fans and coordinates, vertex.
void check_soup(const Work& work, const Soup& soup);

}  // namespace intarsia::kernels
