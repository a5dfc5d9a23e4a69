#include "kernels/denoise/filter_normals.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/reduce.h"
#include "engine/parallel/scan.h"

namespace intarsia::kernels {
namespace {

// The triangles that share a vertex with f, into `out`.
void ring_of(const MeshView& mesh, Index f, std::vector<Index>& out) {
  out.clear();
  for (const Index v : mesh.face(f))
    for (const Index g : mesh.vertex_faces.row(v))
      if (g != f) out.push_back(g);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

// How uneven the normals are on a triangle and its ring: the largest distance from their mean, times how much a single
// edge has of all the bending (Eq. 6 and 7, with the mean in place of all pairs).
struct Patch {
  Vec3 mean = Vec3::Zero();
  Real unevenness = 0;
};

class Filter {
 public:
  Filter(const Work& work, const MeshView& mesh, const Csr& rings, std::span<const Real> area, Vec3View centroid,
         Real sigma)
      : work_(work), mesh_(mesh), rings_(rings), area_(area), centroid_(centroid), sigma_(sigma) {
    const Real distance = sum(work, Cost::light, mesh.edge_count(), Real(0), [&](std::size_t e) {
      const Index g = mesh.edge_f1[e];
      return g == kNone ? Real(0) : (centroid[mesh.edge_f0[e]] - centroid[g]).norm();
    });
    reach_ = 2 * distance / std::max<Real>(1, mesh.edge_count());
    patch_.resize(mesh.face_count());
    guide_.resize(mesh.face_count());
    next_.resize(mesh.face_count());
  }

  void step(Vec3Array& normal) {
    const std::size_t faces = mesh_.face_count();
    for_each(work_, Cost::medium, faces, [&](std::size_t f) { patch_[f] = patch_of(static_cast<Index>(f), normal); });
    for_each(work_, Cost::medium, faces, [&](std::size_t f) {
      Index best = static_cast<Index>(f);
      for (const Index g : rings_.row(static_cast<Index>(f)))
        if (patch_[g].unevenness < patch_[best].unevenness) best = g;
      guide_.set(f, patch_[best].mean);
    });
    for_each(work_, Cost::medium, faces, [&](std::size_t f) { next_.set(f, filtered(static_cast<Index>(f), normal)); });
    std::swap(next_, normal);
  }

 private:
  Patch patch_of(Index f, const Vec3Array& normal) const {
    Patch p;
    p.mean = area_[f] * normal[f];
    for (const Index g : rings_.row(f)) p.mean += area_[g] * normal[g];
    const Real length = p.mean.norm();
    if (!(length > 0)) return {normal[f], 1e9};
    p.mean /= length;
    Real farthest = (normal[f] - p.mean).norm(), most = 0, all = 0;
    for (const Index g : rings_.row(f)) farthest = std::max(farthest, (normal[g] - p.mean).norm());
    const auto bend = [&](Index g) {
      for (int i = 0; i < 3; ++i) {
        const Index e = mesh_.face_edge[3 * std::size_t{g} + i], h = mesh_.other_face(e, g);
        if (h == kNone) continue;
        const Real b = (normal[g] - normal[h]).norm();
        most = std::max(most, b), all += b;
      }
    };
    bend(f);
    for (const Index g : rings_.row(f)) bend(g);
    p.unevenness = farthest * most / (all + 1e-9);
    return p;
  }

  Vec3 filtered(Index f, const Vec3Array& normal) const {
    const Vec3 guide = guide_[f], centre = centroid_[f];
    Vec3 sum = Vec3::Zero();
    const auto add = [&](Index g) {
      const Real away = (centroid_[g] - centre).squaredNorm() / (2 * reach_ * reach_);
      const Real differs = (guide_[g] - guide).squaredNorm() / (2 * sigma_ * sigma_);
      sum += area_[g] * std::exp(-away - differs) * normal[g];
    };
    add(f);
    for (const Index g : rings_.row(f)) add(g);
    const Real length = sum.norm();
    return length > 0 ? Vec3(sum / length) : normal[f];
  }

  const Work& work_;
  const MeshView& mesh_;
  const Csr& rings_;
  std::span<const Real> area_;
  Vec3View centroid_;
  Real sigma_, reach_ = 1;
  std::vector<Patch> patch_;
  Vec3Array guide_, next_;
};

}  // namespace

Csr triangle_rings(const Work& work, const MeshView& mesh) {
  Csr rings;
  const std::size_t faces = mesh.face_count();
  rings.offset.assign(faces + 1, 0);
  for_each_block(work, Cost::medium, faces, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<Index> ring;
    for (std::size_t f = begin; f < end; ++f) {
      ring_of(mesh, static_cast<Index>(f), ring);
      rings.offset[f] = static_cast<Index>(ring.size());
    }
  });
  rings.item.resize(exclusive_scan<Index>(work, rings.offset));
  for_each_block(work, Cost::medium, faces, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<Index> ring;
    for (std::size_t f = begin; f < end; ++f) {
      ring_of(mesh, static_cast<Index>(f), ring);
      std::copy(ring.begin(), ring.end(), rings.item.begin() + rings.offset[f]);
    }
  });
  return rings;
}

void filter_normals(const Work& work, const MeshView& mesh, const Csr& rings, std::span<const Real> area,
                    Vec3View centroid, const NormalFilterOptions& options, Vec3Array& normal) {
  Filter filter(work, mesh, rings, area, centroid, options.sigma);
  for (int i = 0; i < options.iterations; ++i) filter.step(normal);
}

}  // namespace intarsia::kernels
