#include "kernels/surface/normalise_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/parallel/reduce.h"

namespace intarsia::kernels {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<Real>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<Real>::infinity());
  Index bad = kNone;  // smallest vertex with a coordinate that is not finite
};

Box join(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high), std::min(a.bad, b.bad)};
}

}  // namespace

BoxTransform normalise_box(const Work& work, const Soup& soup) {
  if (soup.corner.empty()) throw Error(ErrorCode::rejected, "the mesh has no faces; give a triangle surface");
  const Box box = reduce(
      work, Cost::light, soup.corner.size(), Box{},
      [&](std::size_t begin, std::size_t end) {
        Box part;
        for (std::size_t c = begin; c < end; ++c) {
          const Index v = soup.corner[c];
          const Vec3 p{soup.x[v], soup.y[v], soup.z[v]};
          if (!p.allFinite()) {
            part.bad = std::min(part.bad, v);
            continue;
          }
          part.low = part.low.cwiseMin(p), part.high = part.high.cwiseMax(p);
        }
        return part;
      },
      join);
  if (box.bad != kNone)
    throw Error(ErrorCode::rejected,
                "vertex " + std::to_string(box.bad) +
                    " has a coordinate that is not a finite number; remove the vertex and its faces",
                box.bad);
  const Vec3 size = box.high - box.low;
  BoxTransform t;
  t.diagonal = std::hypot(size.x(), size.y(), size.z());
  t.centre = box.low + 0.5 * size;
  if (!(t.diagonal > 0))
    throw Error(ErrorCode::rejected, "all vertices that faces use lie at one point; check the export of the mesh");
  if (!std::isfinite(t.diagonal) || !t.centre.allFinite() || !std::isfinite(1 / t.diagonal))
    throw Error(ErrorCode::rejected,
                "the size of the mesh is outside the range of numbers; scale it to a sensible unit");
  return t;
}

}  // namespace intarsia::kernels
