#include "kernels/curvature/disc_fitter.h"

#include <algorithm>
#include <cmath>

namespace intarsia::kernels {

namespace {

// Squared distances of all samples from one point.
INTARSIA_WIDE void square_distances(const Real* x, const Real* y, const Real* z, std::size_t count, const Vec3& from,
                                    Real* out) {
  const Real fx = from.x(), fy = from.y(), fz = from.z();
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes dx = lanes_at(x + i) - fx, dy = lanes_at(y + i) - fy, dz = lanes_at(z + i) - fz;
    lanes_at(out + i) = dx * dx + dy * dy + dz * dz;
  }
}

}  // namespace

void DiscFitter::collect(Index c, std::span<const std::uint8_t> fit_ring) {
  items_.clear();
  codes_ = 0;
  collect_below(start_level(levels_), c, fit_ring);
}

void DiscFitter::collect_below(std::size_t level, Index c, std::span<const std::uint8_t> fit_ring) {
  for (Index i : levels_.level[level].member.row(c)) {
    if (level > 0) {
      collect_below(level - 1, i, fit_ring);
    } else if (is_disc(fit_ring[i])) {
      items_.push_back({i, c, fit_ring[i]});
      codes_ |= 1u << fit_ring[i];
    }
  }
}

const DiscFitter::Gathered& DiscFitter::samples_of(const DiscWalker::Place& place, Index cluster, int code) {
  Gathered& g = gathered_[static_cast<std::size_t>(code - kFirstDisc)];
  if (g.place.same_list(place)) return g;
  const DiscWalker::Samples samples = walker_.around(cluster, code);
  const SampleLevel& level = levels_.level[samples.level];
  const Vec3Array& normal = sample_normal_[samples.level];
  g.place = place;
  g.points.resize(samples.id.size());
  for (LaneArray* a : {&g.x, &g.y, &g.z})
    if (a->size() < samples.id.size()) a->resize(samples.id.size());
  for (std::size_t i = 0; i < samples.id.size(); ++i) {
    const Index s = samples.id[i];
    LanePoint& p = g.points[i];
    p = {level.centre.x[s], level.centre.y[s], level.centre.z[s], normal.x[s], normal.y[s], normal.z[s], level.area[s]};
    g.x.data()[i] = p.x, g.y.data()[i] = p.y, g.z.data()[i] = p.z;
  }
  return g;
}

// The next up to eight vertices of this scale that share a list of samples.
bool DiscFitter::next_pack(int code, std::size_t& next, const Vec3View& normal, const FitOptions& options) {
  DiscWalker::Place place, here;
  Index cluster = kNone;
  pack_.size = 0;
  pack_.code = code;
  for (; next < items_.size() && pack_.size < kLanes; ++next) {
    const Item& item = items_[next];
    if (item.code != code) continue;
    if (item.cluster != cluster) {
      here = walker_.place(item.cluster, code);
      cluster = item.cluster;
      if (pack_.size == 0) place = here;
    }
    if (!here.same_list(place)) break;
    const std::size_t l = pack_.size++;
    const Vec3 n = normal[item.vertex];
    pack_.vertex[l] = item.vertex;
    pack_.cluster[l] = item.cluster;
    pack_.frames.set(l, mesh_.point(item.vertex), Frame(n.squaredNorm() > 0.5 ? n : Vec3(Vec3::UnitZ())));
    discs_.radius[l] = here.radius;
    discs_.cell[l] = here.cell;
  }
  if (pack_.size == 0) return false;
  fit_pack(samples_of(place, pack_.cluster[0], code), options);
  return true;
}

void DiscFitter::fit_pack(const Gathered& samples, const FitOptions& options) {
  const LaneFrames& f = pack_.frames;
  Vec3 middle = Vec3::Zero();
  for (std::size_t l = 0; l < pack_.size; ++l) middle += Vec3(f.px[l], f.py[l], f.pz[l]);
  middle /= static_cast<Real>(pack_.size);
  Real reach = 0;
  for (std::size_t l = 0; l < pack_.size; ++l)
    reach = std::max(reach, (Vec3(f.px[l], f.py[l], f.pz[l]) - middle).norm() + discs_.radius[l] + discs_.cell[l] / 2);

  // Samples in reach of any lane. Rounding must not lose one that a lane would take.
  const std::size_t count = samples.points.size();
  if (entries_.size() < count) entries_.resize(2 * count);
  if (squared_.size() < count) squared_.resize(2 * count);
  square_distances(samples.x.data(), samples.y.data(), samples.z.data(), count, middle, squared_.data());
  const Real most = reach * reach * (1 + 1e-9);
  const std::uint32_t lanes = (1u << pack_.size) - 1;
  std::size_t size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    entries_[size] = {static_cast<std::uint32_t>(i), lanes};
    size += squared_.data()[i] <= most;
  }
  fit_disc_lanes(instruction_set(), f, discs_, samples.points, std::span(entries_).first(size), options, pack_.fits);
}

}  // namespace intarsia::kernels
