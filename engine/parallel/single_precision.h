// Whether coordinates carry no more than single precision.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/reduce.h"

namespace intarsia {

// True if x, y and z of the soup's vertices vertex(0) .. vertex(count - 1) are all exactly floats.
template <class VertexOf>
bool is_single_precision(const Work& work, const Soup& soup, std::size_t count, const VertexOf& vertex) {
  const int doubles = reduce(  // an int: neighbours in a vector<bool> share a byte
      work, Cost::light, count, 0,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          for (const Real c : {soup.x[vertex(i)], soup.y[vertex(i)], soup.z[vertex(i)]})
            if (static_cast<Real>(static_cast<float>(c)) != c) return 1;
        return 0;
      },
      [](int a, int b) { return a | b; });
  return doubles == 0;
}

}  // namespace intarsia
