#include "graph/artefacts.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/parallel/hash_array.h"
#include "graph/fields_visitor.h"

namespace intarsia {

std::uint64_t hash_of(const Soup& a) {
  Hash h;
  for (const auto* c : {&a.x, &a.y, &a.z}) h.add(hash_array(Work{}, *c));
  for (const auto* i : {&a.corner, &a.source_face}) h.add(hash_array(Work{}, *i));
  return h.value();
}
std::size_t bytes_of(const Soup& a) {
  return a.x.size() * 3 * sizeof(Real) + (a.corner.size() + a.source_face.size()) * sizeof(Index);
}
std::size_t items_of(const Soup& a) { return a.face_count(); }

}  // namespace intarsia

namespace intarsia::graph {
namespace {

struct Hasher {
  Hash hash;
  template <class T>
  void array(const std::vector<T>& a) {
    hash.add(hash_array(Work{}, a));
  }
  template <class T>
  void scalar(const T& s) {
    hash.add(s);
  }
  void points(const std::vector<SurfacePoint>& a) {
    hash.add(std::uint64_t{a.size()});
    for (const SurfacePoint& p : a) hash.add(p.kind), hash.add(p.element), hash.add(p.a), hash.add(p.b);
  }
};

struct Sizer {
  std::size_t bytes = 0;
  template <class T>
  void array(const std::vector<T>& a) {
    bytes += a.size() * sizeof(T);
  }
  template <class T>
  void scalar(const T&) {}
  void points(const std::vector<SurfacePoint>& a) { bytes += a.size() * sizeof(SurfacePoint); }
};

template <class T>
std::uint64_t hash_fields(const T& a) {
  Hasher h;
  walk(a, h);
  return h.hash.value();
}

template <class T>
std::size_t size_fields(const T& a) {
  Sizer s;
  walk(a, s);
  return s.bytes;
}

std::vector<Warning> as_warnings(const char* code, const std::vector<std::string>& messages) {
  std::vector<Warning> warnings;
  warnings.reserve(messages.size());
  for (const std::string& m : messages) warnings.push_back({code, m, 1, {}});
  return warnings;
}

}  // namespace

std::vector<Warning> warnings_of(const Surface& a) {
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < kernels::kCleanActions; ++i) {
    const kernels::Fault& fault = a.mended.done[i];
    if (fault.count == 0) continue;
    const auto action = static_cast<kernels::CleanAction>(i);
    std::string text = std::to_string(fault.count) + " " + kernels::text_of(action) + " (first:";
    for (const Index id : fault.first) text += " " + std::to_string(id);
    warnings.push_back({std::string("cleaned-") + kernels::name_of(action), text + ")", fault.count, {}});
  }
  if (a.mended.split_length > 0)
    warnings.push_back({"uneven-split",
                        "the triangles are very uneven, or few and flat: long edges were divided inside, " +
                            std::to_string(a.mesh.face_count()) + " triangles; labels go back to the input's",
                        1,
                        {}});
  if (a.noisy)
    warnings.push_back(
        {"noise-filtered",
         "the mesh is noisy (neighbouring triangles differ by " +
             std::to_string(std::lround(a.rough * 180 / std::numbers::pi)) +
             " degrees): features were looked for on a filtered copy; results keep the input's positions",
         1,
         {}});
  return warnings;
}
std::vector<Warning> warnings_of(const Guides& a) {
  constexpr Real kFar = 0.005;  // diagonals; curves drawn on the surface are much nearer
  std::vector<Warning> warnings;
  if (a.gaps > 0)
    warnings.push_back({"curve-gap",
                        "given curves cannot go on in " + std::to_string(a.gaps) +
                            (a.gaps == 1 ? " place" : " places") +
                            ", where the surface has a hole: they begin anew behind it",
                        a.gaps,
                        {}});
  if (a.farthest > kFar) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.2g", 100 * a.farthest);
    warnings.push_back({"curve-far",
                        std::string("points of given curves are up to ") + percent +
                            " % of the diagonal from the surface; they were put onto the nearest place",
                        1,
                        {}});
  }
  return warnings;
}
std::vector<Warning> warnings_of(const Goal& a) { return as_warnings("tolerance", a.warnings); }
std::vector<Warning> warnings_of(const Network& a) { return as_warnings("network", a.warnings); }
std::vector<Warning> warnings_of(const Patches& a) { return as_warnings("patches", a.warnings); }
std::vector<Warning> warnings_of(const Layout& a) {
  std::vector<Warning> warnings = as_warnings("layout", a.warnings);
  for (const kernels::LayoutCheck& c : a.checks.checks)
    if (!c.passed())
      warnings.push_back({"check-" + c.name,
                          "check " + c.name + " fails for " + std::to_string(c.count) + " elements, first " +
                              c.element + " " + std::to_string(c.example),
                          c.count,
                          {}});
  return warnings;
}

std::uint64_t hash_of(const Surface& a) { return hash_fields(a); }
std::uint64_t hash_of(const Scale& a) { return hash_fields(a); }
std::uint64_t hash_of(const Sharp& a) { return hash_fields(a); }
std::uint64_t hash_of(const Curvature& a) { return hash_fields(a); }
std::uint64_t hash_of(const Directions& a) { return hash_fields(a); }
std::uint64_t hash_of(const Lines& a) { return hash_fields(a); }
std::uint64_t hash_of(const Ridges& a) { return hash_fields(a); }
std::uint64_t hash_of(const Curves& a) { return hash_fields(a); }
std::uint64_t hash_of(const Guides& a) { return hash_fields(a); }
std::uint64_t hash_of(const Goal& a) { return hash_fields(a); }
std::uint64_t hash_of(const Network& a) { return hash_fields(a); }
std::uint64_t hash_of(const Patches& a) { return hash_fields(a); }
std::uint64_t hash_of(const Smoothing& a) { return hash_fields(a); }
std::uint64_t hash_of(const Layout& a) { return hash_fields(a); }

std::size_t bytes_of(const Surface& a) { return size_fields(a); }
std::size_t bytes_of(const Scale& a) { return size_fields(a); }
std::size_t bytes_of(const Sharp& a) { return size_fields(a); }
std::size_t bytes_of(const Curvature& a) { return size_fields(a); }
std::size_t bytes_of(const Directions& a) { return size_fields(a); }
std::size_t bytes_of(const Lines& a) { return size_fields(a); }
std::size_t bytes_of(const Ridges& a) { return size_fields(a); }
std::size_t bytes_of(const Curves& a) { return size_fields(a); }
std::size_t bytes_of(const Guides& a) { return size_fields(a); }
std::size_t bytes_of(const Goal& a) { return size_fields(a); }
std::size_t bytes_of(const Network& a) { return size_fields(a); }
std::size_t bytes_of(const Patches& a) { return size_fields(a); }
std::size_t bytes_of(const Smoothing& a) { return size_fields(a); }
std::size_t bytes_of(const Layout& a) { return size_fields(a); }

std::size_t items_of(const Surface& a) { return a.mesh.face_count(); }
std::size_t items_of(const Scale& a) { return a.fields.scale.size(); }
std::size_t items_of(const Sharp& a) { return a.edges.curves.curve_count(); }
std::size_t items_of(const Curvature& a) { return a.fields.vertex_count(); }
std::size_t items_of(const Directions& a) { return a.normal.size(); }
std::size_t items_of(const Lines& a) { return a.lines.vertex_count(); }
std::size_t items_of(const Ridges& a) { return a.curves.curve_count(); }
std::size_t items_of(const Curves& a) { return a.curves.curve_count(); }
std::size_t items_of(const Guides& a) { return a.curves.curve_count(); }
std::size_t items_of(const Goal& a) { return a.patches; }
std::size_t items_of(const Network& a) { return a.patches; }
std::size_t items_of(const Patches& a) { return a.labels.count; }
std::size_t items_of(const Smoothing& a) { return a.graph.arc_count(); }
std::size_t items_of(const Layout& a) { return a.labels.count; }

}  // namespace intarsia::graph
