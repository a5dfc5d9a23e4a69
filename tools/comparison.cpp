#include "tools/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace intarsia::tools {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> kWays{"triangulated", "area", "transfinite", "filled"};

const RebuiltNumbers& way(const MethodNumbers& m, std::size_t i) {
  return i == 0 ? m.triangulated : i == 1 ? m.area : i == 2 ? m.transfinite : m.filled;
}

RebuiltNumbers of(const graph::Rebuilt& r) {
  if (!r.made) return {};
  return {true, r.distance.hausdorff(), r.distance.rms(), r.distance.mean()};
}

// Distances below this are rounding: of two exact rebuilds neither is the better one.
double ratio(double a, double b) {
  constexpr double kRounding = 1e-9;  // diagonals
  return std::max(a, kRounding) / std::max(b, kRounding);
}

// Geometric mean of what was added; 0 of nothing.
class GeometricMean {
 public:
  void add(double value) { sum_ += std::log(value), ++count_; }
  double value() const { return count_ > 0 ? std::exp(sum_ / count_) : 0; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

const MethodNumbers* find(const MeshNumbers& mesh, const std::string& method) {
  for (const MethodNumbers& m : mesh.methods)
    if (m.method == method) return &m;
  return nullptr;
}

// In thousandths of the diagonal; the least of its column in bold.
std::string cell(double value, double least) {
  const std::string text = fmt::format("{:.2f}", 1e3 * value);
  return fmt::format("{:.2f}", 1e3 * least) == text ? "**" + text + "**" : text;
}

void add_mesh(std::string& out, const MeshNumbers& mesh) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, 8> least;
  least.fill(kNone);
  for (const MethodNumbers& m : mesh.methods)
    for (std::size_t i = 0; i < 4; ++i)
      if (way(m, i).made) {
        least[2 * i] = std::min(least[2 * i], way(m, i).hausdorff);
        least[2 * i + 1] = std::min(least[2 * i + 1], way(m, i).rms);
      }
  for (const MethodNumbers& m : mesh.methods) {
    out += fmt::format("| {}{} | {} | {} | {} |", mesh.mesh, mesh.reference.empty() ? "" : " (against its reference)",
                       mesh.triangles, m.name, m.patches);
    for (const std::size_t i : {0, 2, 3})
      out += way(m, i).made ? fmt::format(" {} | {} |", cell(way(m, i).hausdorff, least[2 * i]),
                                          cell(way(m, i).rms, least[2 * i + 1]))
                            : " - | - |";
    out += fmt::format(" {:.2f} / {:.1f} / {:.1f} | {} | {:.1f} |\n", m.q_median, m.q_high, m.q_most, m.not_discs,
                       m.seconds);
  }
}

}  // namespace

MethodNumbers numbers_of(const graph::Evaluation& e) {
  MethodNumbers m;
  m.patches = e.patches, m.not_discs = e.not_discs;
  m.triangulated = of(e.triangulated), m.area = of(e.triangulated_area);
  m.transfinite = of(e.transfinite), m.filled = of(e.filled);
  m.failed = std::max({e.triangulated.failed, e.transfinite.failed, e.filled.failed});
  m.q_median = e.compactness.median, m.q_high = e.compactness.high, m.q_most = e.compactness.most;
  return m;
}

std::vector<MeanRatios> mean_ratios(const std::vector<MeshNumbers>& table, const std::string& base) {
  std::vector<MeanRatios> means;
  if (table.empty()) return means;
  for (const MethodNumbers& first : table.front().methods) {
    MeanRatios r;
    r.method = first.method, r.name = first.name;
    std::array<GeometricMean, 4> h, rms;
    GeometricMean q, high, most;
    for (const MeshNumbers& mesh : table) {
      const MethodNumbers *m = find(mesh, first.method), *b = find(mesh, base);
      if (!m || !b || !mesh.reference.empty()) continue;
      ++r.meshes;
      r.not_discs += static_cast<int>(m->not_discs);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!way(*m, i).made || !way(*b, i).made) continue;
        const double of_rms = ratio(way(*m, i).rms, way(*b, i).rms);
        h[i].add(ratio(way(*m, i).hausdorff, way(*b, i).hausdorff)), rms[i].add(of_rms);
        r.worst_rms[i] = std::max(r.worst_rms[i], of_rms);
      }
      q.add(m->q_median / b->q_median), high.add(m->q_high / b->q_high), most.add(m->q_most / b->q_most);
    }
    if (r.meshes == 0) continue;
    for (std::size_t i = 0; i < 4; ++i) r.hausdorff[i] = h[i].value(), r.rms[i] = rms[i].value();
    r.q_median = q.value(), r.q_high = high.value(), r.q_most = most.value();
    means.push_back(r);
  }
  return means;
}

std::string comparison_markdown(const std::vector<MeshNumbers>& table, const std::string& settings) {
  std::string out = settings + "\n\n";
  const auto means = mean_ratios(table, "vsa");
  if (!means.empty()) {
    out += fmt::format("Geometric means over {} meshes of the ratio to VSA; (worst mesh).\n\n", means.front().meshes);
    out +=
        "| method | triangulated H | triangulated R | transfinite H | transfinite R | filled H | filled R "
        "| q median | q 90 % | q most | not discs |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const MeanRatios& r : means) {
      out += "| " + r.name + " |";
      for (const std::size_t i : {0, 2, 3})
        out += fmt::format(" {:.2f} | {:.2f} ({:.2f}) |", r.hausdorff[i], r.rms[i], r.worst_rms[i]);
      out += fmt::format(" {:.2f} | {:.2f} | {:.2f} | {} |\n", r.q_median, r.q_high, r.q_most, r.not_discs);
    }
    out += "\n";
  }
  out +=
      "H: Hausdorff distance, R: root mean square, both the larger of the two directions, in thousandths of the "
      "input's diagonal; q: perimeter^2 / (4 pi area) of the patches, median / 90 % / largest.\n\n";
  out +=
      "| mesh | \\|f\\| | method | \\|P\\| | triangulated H | R | transfinite H | R | filled H | R | q "
      "| not discs | seconds |\n|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const MeshNumbers& mesh : table) add_mesh(out, mesh);
  return out;
}

std::string comparison_csv(const std::vector<MeshNumbers>& table) {
  std::string out = "mesh,triangles,diagonal,reference,method,wanted,patches,not_discs,failed,seconds";
  for (const char* w : kWays)
    out += fmt::format(",{0}_hausdorff,{0}_rms,{0}_mean,{0}_hausdorff_absolute,{0}_rms_absolute", w);
  out += ",q_median,q_90,q_most\n";
  for (const MeshNumbers& mesh : table)
    for (const MethodNumbers& m : mesh.methods) {
      out += fmt::format("{},{},{},{},{},{},{},{},{},{:.3f}", mesh.mesh, mesh.triangles, mesh.diagonal, mesh.reference,
                         m.method, mesh.wanted, m.patches, m.not_discs, m.failed, m.seconds);
      for (std::size_t i = 0; i < 4; ++i) {
        const RebuiltNumbers& r = way(m, i);
        out += r.made ? fmt::format(",{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}", r.hausdorff, r.rms, r.mean,
                                    r.hausdorff * mesh.diagonal, r.rms * mesh.diagonal)
                      : ",,,,,";
      }
      out += fmt::format(",{:.6g},{:.6g},{:.6g}\n", m.q_median, m.q_high, m.q_most);
    }
  return out;
}

json comparison_json(const std::vector<MeshNumbers>& table) {
  json out = {
      {"schema", "intarsia-table1"}, {"schema_version", 1}, {"meshes", json::array()}, {"means", json::array()}};
  for (const MeshNumbers& mesh : table) {
    json rows = json::array();
    for (const MethodNumbers& m : mesh.methods) {
      json row = {{"method", m.method},       {"name", m.name},     {"patches", m.patches},
                  {"not_discs", m.not_discs}, {"failed", m.failed}, {"seconds", m.seconds},
                  {"q_median", m.q_median},   {"q_90", m.q_high},   {"q_most", m.q_most}};
      for (std::size_t i = 0; i < 4; ++i)
        if (const RebuiltNumbers& r = way(m, i); r.made)
          row[kWays[i]] = {{"hausdorff", r.hausdorff},
                           {"rms", r.rms},
                           {"mean", r.mean},
                           {"hausdorff_absolute", r.hausdorff * mesh.diagonal},
                           {"rms_absolute", r.rms * mesh.diagonal},
                           {"mean_absolute", r.mean * mesh.diagonal}};
      rows.push_back(std::move(row));
    }
    out["meshes"].push_back({{"mesh", mesh.mesh},
                             {"triangles", mesh.triangles},
                             {"diagonal", mesh.diagonal},
                             {"wanted_patches", mesh.wanted},
                             {"reference", mesh.reference},
                             {"methods", std::move(rows)}});
  }
  for (const MeanRatios& r : mean_ratios(table, "vsa")) {
    json row = {{"method", r.method}, {"name", r.name},     {"meshes", r.meshes},      {"q_median", r.q_median},
                {"q_90", r.q_high},   {"q_most", r.q_most}, {"not_discs", r.not_discs}};
    for (std::size_t i = 0; i < 4; ++i)
      row[kWays[i]] = {{"hausdorff", r.hausdorff[i]}, {"rms", r.rms[i]}, {"worst_rms", r.worst_rms[i]}};
    out["means"].push_back(std::move(row));
  }
  return out;
}

}  // namespace intarsia::tools
