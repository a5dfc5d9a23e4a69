#include "kernels/quality/segmentation_metrics.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/compact.h"
#include "engine/parallel/reduce.h"
#include "engine/parallel/sort.h"
#include "kernels/quality/geodesic_distance.h"

namespace intarsia::kernels {
namespace {

// Faces that have one label in the candidate and one in the reference.
struct Overlap {
  Index candidate = 0, reference = 0;
  Real faces = 0, area = 0;
};

std::vector<Overlap> overlaps(const Work& work, std::span<const Real> area, const Segmentation& candidate,
                              const Segmentation& reference) {
  struct Key {
    std::uint64_t pair;
    Index face;
    bool operator<(const Key& o) const { return pair != o.pair ? pair < o.pair : face < o.face; }
  };
  std::vector<Key> key(area.size());
  for_each(work, Cost::light, key.size(), [&](std::size_t f) {
    key[f] = {std::uint64_t{candidate.label[f]} << 32 | reference.label[f], static_cast<Index>(f)};
  });
  sort_total(work, key.begin(), key.end());
  std::vector<Overlap> list;
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (i == 0 || key[i].pair != key[i - 1].pair)
      list.push_back({static_cast<Index>(key[i].pair >> 32), static_cast<Index>(key[i].pair), 0, 0});
    list.back().faces += 1, list.back().area += area[key[i].face];
  }
  return list;
}

// Area of all faces outside the best match of their segment: DH(S1 => S2) for segments `of` matched by others.
template <class Of>
Real unmatched(std::span<const Overlap> overlap, std::span<const Real> segment_area, const Of& of) {
  std::vector<Real> best(segment_area.size(), 0);
  for (const Overlap& o : overlap) best[of(o)] = std::max(best[of(o)], o.area);
  Real total = 0;
  for (std::size_t s = 0; s < best.size(); ++s) total += segment_area[s] - best[s];
  return std::max(total, Real{0});
}

Real pairs(Real n) { return 0.5 * n * (n - 1); }

Index candidate_of(const Overlap& o) { return o.candidate; }
Index reference_of(const Overlap& o) { return o.reference; }

void check_labels(std::size_t faces, const Segmentation& s) {
  if (s.label.size() != faces) throw Error(ErrorCode::bad_argument, "as many labels as faces are wanted");
}

// Mean of the values at both ends over the edges, by length; unreached edges are left out and counted.
struct BorderMean {
  Real sum = 0, length = 0, unreached = 0;
};

BorderMean mean_over(const MeshView& mesh, std::span<const Index> edge, std::span<const Real> distance) {
  BorderMean m;
  for (const Index e : edge) {
    const Index a = mesh.edge_v0[e], b = mesh.edge_v1[e];
    const Real length = (mesh.point(a) - mesh.point(b)).norm(), d = 0.5 * (distance[a] + distance[b]);
    if (std::isfinite(d))
      m.sum += length * d, m.length += length;
    else
      m.unreached += length;
  }
  return m;
}

std::vector<Index> ends_of(const MeshView& mesh, std::span<const Index> edge) {
  std::vector<Index> end;
  for (const Index e : edge) end.push_back(mesh.edge_v0[e]), end.push_back(mesh.edge_v1[e]);
  std::sort(end.begin(), end.end());
  end.erase(std::unique(end.begin(), end.end()), end.end());
  return end;
}

Real mean_radius(const Work& work, const MeshView& mesh) {
  struct Sums {
    Real area = 0;
    Vec3 moment = Vec3::Zero();
  };
  const auto corners = [&](std::size_t f) {
    const auto [a, b, c] = mesh.face(static_cast<Index>(f));
    return std::array<Vec3, 3>{mesh.point(a), mesh.point(b), mesh.point(c)};
  };
  const auto area_of = [](const std::array<Vec3, 3>& p) { return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm(); };
  const Sums sums = reduce(
      work, Cost::light, mesh.face_count(), Sums{},
      [&](std::size_t begin, std::size_t end) {
        Sums s;
        for (std::size_t f = begin; f < end; ++f) {
          const auto p = corners(f);
          const Real area = area_of(p);
          s.area += area, s.moment += area / 3 * (p[0] + p[1] + p[2]);
        }
        return s;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a.area + b.area, a.moment + b.moment};
      });
  if (!(sums.area > 0)) return 0;
  const Vec3 centroid = sums.moment / sums.area;
  // By the middles of the sides: exact for quadratic functions.
  const Real total = sum(work, Cost::light, mesh.face_count(), Real{0}, [&](std::size_t f) {
    const auto p = corners(f);
    Real d = 0;
    for (std::size_t i = 0; i < 3; ++i) d += (0.5 * (p[i] + p[(i + 1) % 3]) - centroid).norm();
    return area_of(p) * d / 3;
  });
  return total / sums.area;
}

}  // namespace

LabelMetrics compare_labels(const Work& work, std::span<const Real> face_area, const Segmentation& candidate,
                            const Segmentation& reference) {
  check_labels(face_area.size(), candidate), check_labels(face_area.size(), reference);
  const std::vector<Overlap> overlap = overlaps(work, face_area, candidate, reference);
  std::vector<Real> area_c(candidate.count, 0), area_r(reference.count, 0), faces_c(area_c), faces_r(area_r);
  Real total = 0, faces = 0, together = 0;
  for (const Overlap& o : overlap) {
    area_c[o.candidate] += o.area, area_r[o.reference] += o.area;
    faces_c[o.candidate] += o.faces, faces_r[o.reference] += o.faces;
    total += o.area, faces += o.faces, together += pairs(o.faces);
  }
  if (!(total > 0) || faces < 2)
    throw Error(ErrorCode::rejected, "segmentations need two faces and an area to be compared");
  LabelMetrics m;
  m.missing_rate = unmatched(overlap, area_r, reference_of) / total;
  m.false_alarm = unmatched(overlap, area_c, candidate_of) / total;
  m.hamming = 0.5 * (m.missing_rate + m.false_alarm);
  Real apart = -2 * together;
  for (const Real n : faces_c) apart += pairs(n);
  for (const Real n : faces_r) apart += pairs(n);
  m.rand_error = apart / pairs(faces);
  Real forward = 0, backward = 0, local = 0;
  for (const Overlap& o : overlap) {
    const Real e12 = area_c[o.candidate] > 0 ? 1 - o.area / area_c[o.candidate] : 0;
    const Real e21 = area_r[o.reference] > 0 ? 1 - o.area / area_r[o.reference] : 0;
    forward += o.area * e12, backward += o.area * e21, local += o.area * std::min(e12, e21);
  }
  m.gce = std::max(std::min(forward, backward) / total, Real{0});
  m.lce = std::max(local / total, Real{0});
  return m;
}

std::vector<Index> border_edges(const Work& work, const MeshView& mesh, std::span<const Index> label) {
  return compact(work, mesh.edge_count(), [&](std::size_t e) {
    return mesh.edge_f1[e] != kNone && label[mesh.edge_f0[e]] != label[mesh.edge_f1[e]];
  });
}

std::optional<CutDiscrepancy> cut_discrepancy(const Work& work, const MeshView& mesh, const Segmentation& candidate,
                                              const Segmentation& reference) {
  check_labels(mesh.face_count(), candidate), check_labels(mesh.face_count(), reference);
  const std::vector<Index> edge_c = border_edges(work, mesh, candidate.label),
                           edge_r = border_edges(work, mesh, reference.label);
  if (edge_c.empty() || edge_r.empty()) return std::nullopt;
  const BorderMean forward = mean_over(mesh, edge_c, geodesic_distance(work, mesh, ends_of(mesh, edge_r)));
  const BorderMean backward = mean_over(mesh, edge_r, geodesic_distance(work, mesh, ends_of(mesh, edge_c)));
  CutDiscrepancy cut;
  cut.radius = mean_radius(work, mesh);
  if (!(forward.length > 0 && backward.length > 0 && cut.radius > 0)) return std::nullopt;
  cut.forward = forward.sum / forward.length, cut.backward = backward.sum / backward.length;
  const Real unreached = forward.unreached + backward.unreached;
  cut.unreached = unreached / (unreached + forward.length + backward.length);
  return cut;
}

}  // namespace intarsia::kernels
