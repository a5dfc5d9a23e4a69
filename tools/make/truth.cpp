#include "tools/make/truth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/make/catalogue.h"
#include "tools/make/fields.h"
#include "tools/make/temporary_file.h"

namespace intarsia::tools {

namespace {

// Twelve edges and eight corners of a box: an edge along axis `a` runs from -inner to +inner, `at_edge` away from the
// middle planes along the two other axes; corners lie `at_corner` away along all three.
TrueFeatures box_features(const Vec3& inner, const Vec3& at_edge, const Vec3& at_corner) {
  TrueFeatures f;
  for (int a = 0; a < 3; ++a) {
    if (!(inner[a] > 0)) continue;
    for (int signs = 0; signs < 4; ++signs) {
      Vec3 p;
      p[(a + 1) % 3] = signs & 1 ? at_edge[(a + 1) % 3] : -at_edge[(a + 1) % 3];
      p[(a + 2) % 3] = signs & 2 ? at_edge[(a + 2) % 3] : -at_edge[(a + 2) % 3];
      TrueCurve line;
      for (const Real end : {-inner[a], inner[a]}) {
        p[a] = end;
        line.point.push_back(p);
      }
      f.curves.push_back(line);
    }
  }
  for (int c = 0; c < 8; ++c)
    f.corners.push_back({c & 1 ? at_corner.x() : -at_corner.x(), c & 2 ? at_corner.y() : -at_corner.y(),
                         c & 4 ? at_corner.z() : -at_corner.z()});
  return f;
}

}  // namespace

TrueFeatures true_features(const MakeOptions& options, int samples) {
  check(options);
  build_shape(options);  // refuses parameters that do not fit together
  if (samples < 2) throw Error(ErrorCode::bad_argument, "a curve needs at least 2 samples");
  const auto get = [&](const char* name) { return parameter(options, name); };
  TrueFeatures f;
  if (options.shape == "rounded-box") {
    const Real r = get("fillet");
    const Vec3 inner = Vec3(get("half-x"), get("half-y"), get("half-z")) - Vec3::Constant(r);
    return box_features(inner, inner + Vec3::Constant(r / std::sqrt(2.0)), inner + Vec3::Constant(r / std::sqrt(3.0)));
  }
  if (options.shape == "cube") {
    const Vec3 half = Vec3::Constant(get("half"));
    return box_features(half, half, half);
  }
  if (options.shape == "ellipsoid") {
    const Vec3 axes(get("a"), get("b"), get("c"));
    Eigen::Index shortest = 0;
    const Real least = axes.minCoeff(&shortest);
    const int u = (static_cast<int>(shortest) + 1) % 3, v = (static_cast<int>(shortest) + 2) % 3;
    if (!(least < std::min(axes[u], axes[v]))) return f;
    TrueCurve loop;
    loop.closed = true;
    for (int i = 0; i < samples; ++i) {
      const Real t = 6.283185307179586 * i / samples;
      Vec3 p = Vec3::Zero();
      p[u] = axes[u] * std::cos(t), p[v] = axes[v] * std::sin(t);
      loop.point.push_back(p);
    }
    f.curves.push_back(loop);
  }
  if (options.shape == "star") {
    constexpr Real kCrisp = 0.75;
    const int petals = static_cast<int>(std::round(get("petals")));
    for (int k = 0; k < petals; ++k) {
      TrueCurve crest;
      for (int i = 0; i < samples; ++i)
        crest.point.push_back(star_crest(get("petals"), get("depth"), get("crease"), get("twist"), k,
                                         kCrisp * (2.0 * i / (samples - 1) - 1)));
      f.curves.push_back(crest);
    }
  }
  if (options.shape == "half-pipe") {
    const Sheet sheet = *build_shape(options).sheet;
    for (const int lip : {1, 3}) {  // the parts are deck, lip, pipe, lip, deck
      const Real s = 0.5 * (sheet.profile.joints()[lip] + sheet.profile.joints()[lip + 1]);
      Vec3 p, normal;
      sheet.profile.at(s, p, normal);
      TrueCurve line;
      for (const Real end : {-0.5 * sheet.depth, 0.5 * sheet.depth}) line.point.push_back({p.x(), end, p.z()});
      f.curves.push_back(line);
    }
  }
  return f;
}

void write_truth(const TrueFeatures& features, const std::filesystem::path& path) {
  std::string text = "# feature curves (l) and corners (p) known by construction\n", elements;
  std::size_t next = 1;
  const auto vertex = [&](const Vec3& p) {
    char line[96];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    text += line;
    return std::to_string(next++);
  };
  for (const TrueCurve& c : features.curves) {
    elements += "l";
    const std::string first = std::to_string(next);
    for (const Vec3& p : c.point) elements += " " + vertex(p);
    if (c.closed) elements += " " + first;
    elements += "\n";
  }
  for (const Vec3& p : features.corners) elements += "p " + vertex(p) + "\n";
  text += elements;
  TemporaryFile file(path);
  file.write_at(0, text.data(), text.size());
  file.finish();
}

}  // namespace intarsia::tools
