#include "tools/step/triangulate_model.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia::tools {
namespace {

// The flattened points of the patch, those of its border where the face's border is.
std::vector<Vec2> trimmed(const PatchPiece& piece, const FittedFace& fitted, const CadModel& model,
                          const CadFace& face) {
  std::vector<Vec2> uv = fitted.uv;
  for (std::size_t l = 0; l < piece.loop.size(); ++l)
    for (std::size_t s = 0; s < piece.loop[l].side.size(); ++s) {
      const std::vector<Index> along = piece.side_points(piece.loop[l], s);
      std::vector<Real> t(along.size(), 0);
      for (std::size_t i = 1; i < along.size(); ++i)
        t[i] = t[i - 1] + (piece.point[along[i]] - piece.point[along[i - 1]]).norm();
      const CadSide& side = face.loops[l][s];
      const Real length = model.edge[side.edge].curve.length;
      for (std::size_t i = 0; i + 1 < along.size(); ++i) {
        const Real x = t.back() > 0 ? t[i] / t.back() * length : 0;
        uv[along[i]] = side.at(side.forward ? x : length - x);
      }
    }
  return uv;
}

struct Triangles {
  std::vector<Vec3> point;
  std::vector<Index> corner;
};

Triangles on_surface(const PatchPiece& piece, const FaceSurface& surface, std::span<const Vec2> uv, Real deflection) {
  Triangles out;
  const Real cell = surface.is_plane ? 1e300 : std::max(surface.spline.domain.u_step(), surface.spline.domain.v_step());
  for (const auto& c : piece.triangle) {
    const Vec2 corner[3] = {uv[c[0]], uv[c[1]], uv[c[2]]};
    Real bent = 0, longest = 0;
    if (!surface.is_plane)
      for (int i = 0; i < 3; ++i) {
        const Vec2 &a = corner[i], &b = corner[(i + 1) % 3];
        const Vec3 middle = (surface.at(a).point + surface.at(b).point) / 2;
        bent = std::max(bent, (surface.at((a + b) / 2).point - middle).norm());
        longest = std::max(longest, (a - b).norm());
      }
    const int n = static_cast<int>(
        std::clamp(std::max(std::ceil(std::sqrt(bent / deflection)), std::ceil(longest / cell)), 1.0, 40.0));
    const Index base = static_cast<Index>(out.point.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Real a = static_cast<Real>(i) / n, b = static_cast<Real>(j) / n;
        out.point.push_back(surface.at((1 - a - b) * corner[0] + a * corner[1] + b * corner[2]).point);
      }
    const auto at = [&](int i, int j) { return base + static_cast<Index>(i * (n + 1) - i * (i - 1) / 2 + j); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        out.corner.insert(out.corner.end(), {at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) out.corner.insert(out.corner.end(), {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  return out;
}

}  // namespace

ModelTriangles triangulate_model(const Work& work, const FittedLayout& layout, const CadModel& model, Real deflection) {
  std::vector<Triangles> made(model.face.size());
  for_each(work, Cost::single, made.size(), [&](std::size_t f) {
    const CadFace& face = model.face[f];
    const PatchPiece& piece = layout.piece[face.patch];
    const std::vector<Vec2> uv = trimmed(piece, layout.face[face.patch], model, face);
    made[f] = on_surface(piece, face.surface, uv, deflection);
  });
  ModelTriangles out;
  for (std::size_t f = 0; f < made.size(); ++f) {
    const Index base = static_cast<Index>(out.x.size());
    for (const Vec3& p : made[f].point) out.x.push_back(p.x()), out.y.push_back(p.y()), out.z.push_back(p.z());
    for (const Index c : made[f].corner) out.corner.push_back(base + c);
    out.face.resize(out.corner.size() / 3, static_cast<Index>(f));
  }
  return out;
}

}  // namespace intarsia::tools
