// Test shapes as callers of the public interface have them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "graph/api/intarsia.h"
#include "tests/support/shapes.h"

namespace intarsia::test {

struct PlainMesh {
  std::vector<double> positions;
  std::vector<std::int32_t> triangles;

  TriangleMesh view() const { return {positions, triangles}; }
};

inline PlainMesh plain(const Soup& soup) {
  PlainMesh out;
  for (Index v = 0; v < soup.vertex_count(); ++v)
    out.positions.insert(out.positions.end(), {soup.x[v], soup.y[v], soup.z[v]});
  out.triangles.assign(soup.corner.begin(), soup.corner.end());
  return out;
}

}  // namespace intarsia::test
