#include "kernels/scale/normal_cones.h"

#include <algorithm>
#include <cmath>

#include "engine/base/lanes.h"
#include "engine/parallel/for_each.h"

namespace intarsia::kernels {

namespace {

constexpr std::size_t kTeam = 8, kTeams = GroupWalker::kGroup / kTeam;

// Mean direction of some cones; false if there is none.
bool mean_axis(std::span<const NormalCone> cones, float* axis) {
  float x = 0, y = 0, z = 0;
  for (const NormalCone& c : cones) x += c.axis[0], y += c.axis[1], z += c.axis[2];
  const float length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0.1f)) return false;
  axis[0] = x / length, axis[1] = y / length, axis[2] = z / length;
  return true;
}

struct alignas(32) PerTeam {
  float of[kTeams];
};

// far[t] = largest chord from the axis of team t among the places that a source of the team reaches.
INTARSIA_WIDE void farthest(const NormalCone* cone, const Index* vertex, const GroupWalker::Mask* within,
                            std::size_t count, const PerTeam* axis, PerTeam& far) {
  PerTeam most = far;
  for (std::size_t i = 0; i < count; ++i) {
    const NormalCone c = cone[vertex[i]];
    const GroupWalker::Mask mask = within[i];
    for (std::size_t t = 0; t < kTeams; ++t) {
      const float x = c.axis[0] - axis[0].of[t], y = c.axis[1] - axis[1].of[t], z = c.axis[2] - axis[2].of[t];
      const float chord = std::sqrt(x * x + y * y + z * z) + c.chord;
      const float seen = (mask >> (kTeam * t) & 255u) != 0 ? chord : 0.0f;
      most.of[t] = most.of[t] > seen ? most.of[t] : seen;
    }
  }
  far = most;
}

}  // namespace

std::vector<NormalCone> normal_cones(const Work& work, const MeshView& mesh, std::span<const VotingFace> faces) {
  std::vector<NormalCone> out(mesh.vertex_count());
  for_each(work, Cost::light, out.size(), [&](std::size_t v) {
    const auto around = mesh.vertex_faces.row(static_cast<Index>(v));
    float x = 0, y = 0, z = 0;
    for (Index f : around) x += faces[f].normal[0], y += faces[f].normal[1], z += faces[f].normal[2];
    const float length = std::sqrt(x * x + y * y + z * z);
    const float scale = length > 0 ? 1 / length : 0;
    x *= scale, y *= scale, z *= scale;
    float most = -1;
    for (Index f : around) {
      const float* n = faces[f].normal;
      const float dx = n[0] - x, dy = n[1] - y, dz = n[2] - z;
      const float squared = faces[f].area > 0 ? dx * dx + dy * dy + dz * dz : -1.0f;
      most = squared > most ? squared : most;
    }
    out[v] = {{x, y, z}, most < 0 ? -4.0f : std::sqrt(most)};
  });
  return out;
}

float safe_chord(Real variation) {
  const Real cosine = 1 / std::sqrt(1 + 0.99 * std::max(variation, Real(0)));
  return static_cast<float>(std::sqrt(2 * (1 - cosine)));
}

bool FlatTeams::all(const GroupWalker& walker, Index first, Index count) const {
  float axis[3];
  if (cone.empty() || !mean_axis(cone.subspan(first, count), axis)) return false;
  const auto vertices = walker.vertices(outer_rings - 1);
  const std::size_t near = walker.vertices(inner_rings - 1).size();
  const auto beyond = [&](std::size_t begin, std::size_t end, float most) {
    float far = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const NormalCone& c = cone[vertices[i]];
      const float x = c.axis[0] - axis[0], y = c.axis[1] - axis[1], z = c.axis[2] - axis[2];
      const float chord = std::sqrt(x * x + y * y + z * z) + c.chord;
      far = chord > far ? chord : far;
    }
    return !(far < most);
  };
  return !beyond(0, count, inner) && !beyond(count, near, inner) && !beyond(near, vertices.size(), outer);
}

std::uint32_t FlatTeams::some(const GroupWalker& walker, Index first, Index count) const {
  if (cone.empty()) return 0;
  PerTeam axis[3] = {}, far_inner = {}, far_outer = {};
  std::uint32_t with_axis = 0;
  for (std::size_t t = 0; kTeam * t < count; ++t) {
    float mean[3];
    if (!mean_axis(cone.subspan(first + kTeam * t, std::min<std::size_t>(kTeam, count - kTeam * t)), mean)) continue;
    with_axis |= 1u << t;
    for (std::size_t i = 0; i < 3; ++i) axis[i].of[t] = mean[i];
  }
  const auto inner_within = walker.within(inner_rings - 1), outer_within = walker.within(outer_rings - 1);
  const Index* vertex = walker.vertices(outer_rings - 1).data();
  farthest(cone.data(), vertex, inner_within.data(), inner_within.size(), axis, far_inner);
  farthest(cone.data(), vertex, outer_within.data(), outer_within.size(), axis, far_outer);
  std::uint32_t flat = 0;
  for (std::size_t t = 0; t < kTeams; ++t)
    flat |= static_cast<std::uint32_t>(far_inner.of[t] < inner && far_outer.of[t] < outer) << t;
  return flat & with_axis;
}

}  // namespace intarsia::kernels
