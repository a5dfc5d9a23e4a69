// --view and --panels of the commands that draw pictures.
#pragma once

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
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

// Of the commands that draw a strip of panels.
struct PictureFlags {
  std::vector<double> view;  // azimuth, elevation in degrees
  std::string panels;
};

// How a strip is drawn: from where, and the folder for its panels as pictures of their own, or none.
struct Pictures {
  std::optional<View> view;
  std::filesystem::path panels;
};

inline void add_picture_flags(CLI::App& app, PictureFlags& flags) {
  add_view_flag(app, flags.view);
  app.add_option("--panels", flags.panels, "also write every panel of the preview as a picture of its own into DIR");
}

inline Pictures pictures_of(const PictureFlags& flags) { return {chosen_view(flags.view), flags.panels}; }

}  // namespace intarsia::tools
