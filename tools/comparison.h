// The numbers of a comparison of methods on several meshes, as Markdown, CSV and JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "graph/evaluate.h"

namespace intarsia::tools {

// One way of rebuilding: relative to the diagonal of the input.
struct RebuiltNumbers {
  bool made = false;
  double hausdorff = 0, rms = 0, mean = 0;
};

struct MethodNumbers {
  std::string method, name;  // short, and as in tables
  Index patches = 0, not_discs = 0, failed = 0;
  RebuiltNumbers triangulated, area, transfinite, filled;
  double q_median = 0, q_high = 0, q_most = 0;  // perimeter^2 / (4 pi area)
  double seconds = 0;
};

struct MeshNumbers {
  std::string mesh;
  Index triangles = 0, wanted = 0;
  double diagonal = 1;
  std::string reference;  // measured against another mesh: left out of the means
  std::vector<MethodNumbers> methods;
};

MethodNumbers numbers_of(const graph::Evaluation& evaluation);

// Geometric means over the meshes of the ratios to the method `base`; meshes with a reference are left out.
struct MeanRatios {
  std::string method, name;
  int meshes = 0;
  double hausdorff[4] = {}, rms[4] = {}, worst_rms[4] = {};  // triangulated, area, transfinite, filled
  double q_median = 0, q_high = 0, q_most = 0;
  int not_discs = 0;
};
std::vector<MeanRatios> mean_ratios(const std::vector<MeshNumbers>& table, const std::string& base);

std::string comparison_markdown(const std::vector<MeshNumbers>& table, const std::string& settings);
std::string comparison_csv(const std::vector<MeshNumbers>& table);
nlohmann::json comparison_json(const std::vector<MeshNumbers>& table);

}  // namespace intarsia::tools
