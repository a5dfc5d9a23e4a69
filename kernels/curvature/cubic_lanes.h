// The adjacent-normal cubic of eight vertices side by side: every lane is one vertex with its own frame, every fit
// point is broadcast to the lanes that it belongs to. The lanes' points are mostly the same, so nothing is gathered per
// vertex, nothing is added across lanes, and the least squares of eight vertices are solved by the same instructions.
//
// The values are those of solve_cubic (cubic_system.h) up to rounding; a lane's bits depend on the order of its points
// only, not on the lanes beside it nor on the instruction set.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/instruction_set.h"
#include "engine/base/lanes.h"
#include "engine/base/types.h"
#include "kernels/curvature/cubic_system.h"
#include "kernels/curvature/fit_cubic.h"

namespace intarsia::kernels {

struct alignas(64) LaneReals {
  std::array<Real, kLanes> lane{};
  Real& operator[](std::size_t l) { return lane[l]; }
  const Real& operator[](std::size_t l) const { return lane[l]; }
};

// The centres and frames of up to eight vertices.
struct LaneFrames {
  LaneReals px, py, pz, ux, uy, uz, vx, vy, vz, nx, ny, nz;

  void set(std::size_t l, const Vec3& centre, const Frame& frame) {
    px[l] = centre.x(), py[l] = centre.y(), pz[l] = centre.z();
    ux[l] = frame.u.x(), uy[l] = frame.u.y(), uz[l] = frame.u.z();
    vx[l] = frame.v.x(), vy[l] = frame.v.y(), vz[l] = frame.v.z();
    nx[l] = frame.n.x(), ny[l] = frame.n.y(), nz[l] = frame.n.z();
  }
};

// A point that lanes may share, in the coordinates of the mesh; (a, b, c) is its unit normal, or 0.
struct LanePoint {
  Real x, y, z, a, b, c;
  Real area = 1;  // used in discs only
};
struct LaneEntry {
  std::uint32_t point;
  std::uint32_t lanes;  // bit l: the point may belong to lane l
};

// Discs only: what makes the weight of a point in each lane.
struct LaneDiscs {
  LaneReals radius, cell;
};

struct LaneFits {
  std::array<LaneReals, 3> b;
  std::array<LaneReals, 4> c;
  std::array<LaneReals, 2> gradient;
  LaneReals offset, radius, count;
  std::uint32_t solved = 0;  // bit l: lane l has enough points and acceptable pivots

  CubicFit cubic(std::size_t l) const {
    return {
        {b[0][l], b[1][l], b[2][l]}, {c[0][l], c[1][l], c[2][l], c[3][l]}, {gradient[0][l], gradient[1][l]}, offset[l]};
  }
};

// Fits 7 or 9 terms to the points of every lane, all of weight 1; points whose normal deviates more than `gate`
// (cosine) do not take part. The centre itself must not be among a lane's points. Lanes that no entry names remain
// unsolved. Requires: terms is 7 or 9; gate > 0; frames of lanes that entries name are set, the others finite;
// entries.point < points.size().
void fit_ring_lanes(InstructionSet set, const LaneFrames& frames, std::span<const LanePoint> points,
                    std::span<const LaneEntry> entries, std::size_t terms, const FitOptions& options, LaneFits& fits);

// Fits 10 terms to the points closer than radius + cell/2 to every lane's centre, weighted by area times the ramp of
// engine/data/disc_walk.h, with rows and gate of discs.
void fit_disc_lanes(InstructionSet set, const LaneFrames& frames, const LaneDiscs& discs,
                    std::span<const LanePoint> points, std::span<const LaneEntry> entries, const FitOptions& options,
                    LaneFits& fits);

}  // namespace intarsia::kernels
