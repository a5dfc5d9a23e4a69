#include "kernels/scale/group_voting.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "kernels/scale/lane_series.h"

namespace intarsia::kernels {

namespace {

constexpr std::size_t kWide = 8;  // vertices side by side: a team
constexpr std::size_t kTeams = GroupWalker::kGroup / kWide;
constexpr Real kCancelled = 1e6;  // variation where all normals cancel

typedef std::uint64_t Words __attribute__((vector_size(32), may_alias));
typedef std::uint8_t Bytes32 __attribute__((vector_size(32), may_alias));
typedef std::uint8_t Bytes8 __attribute__((vector_size(8), may_alias));

struct alignas(32) Coordinates {
  float of[GroupWalker::kGroup];
};

// What was walked, for the bodies.
struct Task {
  GroupVotingScratch& s;
  const VotingFace* record;
  const Coordinates* at;  // x, y, z of the sources
  std::size_t met, faces;
  const GroupWalker::Mask* within[kRings];
  const Index* face;
  const std::array<Index, 3>* place;
  bool folds;
  std::uint32_t flat;  // bit t: team t is not voted on
};

namespace baseline {
constexpr std::size_t kWidth = 2;
#include "kernels/scale/group_voting.inc"
}  // namespace baseline
INTARSIA_BEGIN_AVX2
constexpr std::size_t kWidth = 4;
#include "kernels/scale/group_voting.inc"
INTARSIA_END_SET
INTARSIA_BEGIN_AVX512
constexpr std::size_t kWidth = 8;
#include "kernels/scale/group_voting.inc"
INTARSIA_END_SET

}  // namespace

void GroupVotingScratch::make_room(std::size_t vertices, std::size_t faces) {
  if (vertex_rings.size() < vertices) vertex_rings.resize(2 * vertices), vertex_reach.resize(2 * vertices);
  if (face.size() < faces) {
    const std::size_t n = 2 * faces;
    centroid.resize(n), normal.resize(n), vote.resize(n);
    face.resize(n), face_rings.resize(n), distance.resize(n);
    bucket.resize(n * kTeams * (kRings + 1));
  }
  std::uint16_t* list = bucket.data();
  for (auto& team : bucket_end)
    for (auto& end : team) end = list, list += face.size();
}

GroupVoting::GroupVoting(const MeshView& mesh, std::span<const VotingFace> faces, bool fold_guard, InstructionSet set)
    : mesh_(mesh), record_(faces), fold_guard_(fold_guard), set_(set), walker_(mesh) {
  scratch_.make_room(512, 1024);
}

// False if no vertex can have a first moment that counts: the moment is at least the smallest cosine against any axis,
// and above sqrt(1/2) its variation stays below 1.
bool GroupVoting::normals_spread(std::span<const Index> faces) const {
  float axis[3] = {};
  for (const Index f : faces)
    for (int i = 0; i < 3; ++i) axis[i] += record_[f].area * record_[f].normal[i];
  const float bound = 0.7072f * std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  bool spread = false;
  for (const Index f : faces) {
    const float* n = record_[f].normal;
    spread |= record_[f].area > 0 && !(n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2] > bound);
  }
  return spread;
}

bool GroupVoting::run(Index first, std::span<Variation> out) {
  const Index count = static_cast<Index>(out.size());
  if (!walker_.meet(first, count, kRings - 1, kMostVertices)) return false;
  std::uint32_t flat = 0;
  if (!flat_.all(walker_, first, count)) {
    walker_.reach();
    flat = flat_.some(walker_, first, count);
  } else {
    flat = (1u << kTeams) - 1;
  }
  for (std::size_t b = 0; b < out.size(); ++b)
    if (flat >> (b / kWide) & 1) out[b] = Variation{};
  const std::uint32_t all = (1u << (out.size() + kWide - 1) / kWide) - 1;
  if ((flat & all) == all) return true;
  walker_.collect_faces(kRings);
  const auto faces = walker_.faces(kRings);
  if (faces.size() > kMostFaces) return false;
  const std::size_t met = walker_.vertices(kRings - 1).size();
  scratch_.make_room(met + 1, faces.size() + 1);
  Coordinates at[3];
  const std::span<const Real> from[3] = {mesh_.x, mesh_.y, mesh_.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t b = 0; b < GroupWalker::kGroup; ++b)
      at[i].of[b] = static_cast<float>(from[i][first + std::min(b, out.size() - 1)]);
  Task task{scratch_,
            record_.data(),
            at,
            met,
            faces.size(),
            {},
            faces.data(),
            walker_.face_places().data(),
            fold_guard_ && normals_spread(faces),
            flat};
  for (int k = 0; k < kRings; ++k) task.within[k] = walker_.within(k).data();
  if (task.folds)
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (int j = 0; j < 3; ++j) scratch_.normal[i].of[j] = record_[faces[i]].area * record_[faces[i]].normal[j];
  if (set_ == InstructionSet::avx512)
    avx512::vote_group(task, out);
  else if (set_ == InstructionSet::avx2)
    avx2::vote_group(task, out);
  else
    baseline::vote_group(task, out);
  return true;
}

}  // namespace intarsia::kernels
