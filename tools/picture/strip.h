// Several pictures of one object side by side, with titles: the program's preview.
//
//   Strip strip;
//   strip.add({.title = "input", .caption = "10044 vertices", .shape = shape_of(mesh)});
//   strip.add({.title = "filtered", .caption = "38 curves", .shape = shape_of(mesh), .lines = lines_of(mesh, curves)});
//   const std::vector<Rgb> colours = patch_colours(work, adjacent_patches(work, mesh, patch_of_face, patches));
//   Shape patched = shape_of(mesh);
//   patched.face_label = patch_of_face, patched.label_colour = colours;   // views: keep the arrays alive
//   strip.add({.title = "42 patches", .shape = patched, .lines = restyled(lines_of(mesh, borders), kBorderLine)});
//   write_png("preview.png", draw_strip(work, strip));
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/picture/camera.h"
#include "tools/picture/shade.h"

namespace intarsia::tools {

inline constexpr LineStyle kBorderLine = {{44, 44, 50}, 1.7f};  // borders of coloured patches

struct Panel {
  std::string title;    // "network"; ASCII
  std::string caption;  // smaller, below the title; may be empty
  Shape shape;
  Lines lines;
};

struct StripOptions {
  int width = 620, height = 560;  // pixels; largest size of a panel without its text; panels shrink around the object
  int samples = 3;                // per pixel and side
  int per_row = 0;                // panels per row; 0 = all in one row
  bool legend = true;             // names of the kinds of curves that appear in the panels, below
  std::optional<View> view;       // none: best_view of the first panel
  ShadeOptions shade;
};

struct Strip {
  std::vector<Panel> panel;
  StripOptions options;
  void add(Panel p) { panel.push_back(std::move(p)); }
};

// All panels in one camera, fitted to the first panel's shape. Panels in a row that draw the same arrays share the
// work of finding what is visible.
// Requires: at least one panel; every shape has a face.
// Ensures: the same bytes for any number of threads.
// Errors: bad_argument.
Image draw_strip(const Work& work, const Strip& strip);

// Every panel by itself, as in the strip but without text: for other compositions.
std::vector<Image> draw_panels(const Work& work, const Strip& strip);

// The same as PNG files named after the panels: "closed network" becomes closed-network.png. Makes the folder.
// Errors: write_failed.
void write_panels(const Work& work, const Strip& strip, const std::filesystem::path& folder);

}  // namespace intarsia::tools
