// --view of the commands that draw a preview.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/picture/camera.h"

namespace intarsia::tools {

inline void add_view_flag(CLI::App& app, std::vector<double>& degrees) {
  app.add_option("--view", degrees, "azimuth and elevation of the preview, degrees, z up; default: chosen")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(-360.0, 360.0));
}

inline std::optional<View> chosen_view(const std::vector<double>& degrees) {
  if (degrees.empty()) return std::nullopt;
  const double azimuth = degrees[0] * std::numbers::pi / 180, elevation = degrees[1] * std::numbers::pi / 180;
  View view;
  view.toward =
      Vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  view.up = Vec3::UnitZ();
  return view;
}

}  // namespace intarsia::tools
