#include <filesystem>

#include <fmt/format.h>

#include "engine/run/context.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/layout_handover.h"
#include "tools/picture/best_view.h"
#include "tools/picture/colour_map.h"
#include "tools/picture/png_file.h"
#include "tools/picture/shade.h"
#include "tools/read_deviation.h"
#include "tools/usual_flags.h"
#include "tools/view/read_page.h"
#include "tools/view_flag.h"

namespace intarsia::tools {
namespace {

constexpr int kMostPixels = 16384;  // along a side

struct RenderFlags {
  std::string input, output, size = "1600x1200", stage = "patches", lines = "auto";
  std::vector<double> view, camera;
  double zoom = 1, line_width = 1, perspective = 0.16;
  int samples = 4, threads = 0;
  bool quiet = false;
};

std::pair<int, int> size_of(const std::string& text) {
  int width = 0, height = 0, read = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &read) != 2 ||
      static_cast<std::size_t>(read) != text.size() || std::min(width, height) < 32 ||
      std::max(width, height) > kMostPixels)
    throw Error(ErrorCode::bad_argument,
                fmt::format("--size: '{}' is no size like 1600x1200 with sides from 32 to {}", text, kMostPixels));
  return {width, height};
}

View view_of(const Work& work, const RenderFlags& flags, const Shape& shape) {
  if (flags.camera.empty()) {
    const auto chosen = chosen_view(flags.view);
    return chosen ? *chosen : best_view(work, shape);
  }
  const std::vector<double>& c = flags.camera;
  View view;
  view.toward = Vec3(c[0], c[1], c[2]).normalized();
  view.up = c.size() == 6 ? Vec3(c[3], c[4], c[5]).normalized() : best_view(work, shape).up;
  if (c.size() == 3 && view.toward.cross(view.up).norm() < 1e-6) view.up = Vec3(view.up.y(), view.up.z(), view.up.x());
  if (!(view.toward.cross(view.up).norm() > 1e-6))
    throw Error(ErrorCode::bad_argument, "--camera: the direction and the vertical must differ, and not be zero");
  return view;
}

Lines arc_lines(const LayoutView& layout, const RenderFlags& flags, Real scale) {
  const MeshView mesh = layout.refined->mesh;
  const bool by_kind = flags.lines == "kinds" || (flags.lines == "auto" && flags.stage == "network");
  Lines lines;
  std::vector<Vec3> point;
  for (Index a = 0; a < layout.graph->arc_count(); ++a) {
    LineStyle style = by_kind ? style_of(layout.graph->kind[a]) : LineStyle{{44, 44, 50}, 1.7f};
    style.width *= static_cast<float>(scale * flags.line_width);
    point.clear();
    for (const Index v : layout.graph->arc.row(a)) point.push_back(mesh.point(v));
    lines.add(point, style);
  }
  return lines;
}

Lines feature_lines_of(const PageLines& from, const RenderFlags& flags, Real scale) {
  Lines lines;
  for (std::size_t l = 0; l < from.count(); ++l) {
    LineStyle style = flags.lines == "plain" ? LineStyle{{44, 44, 50}, 1.7f} : style_of(from.kind[l]);
    style.width *= static_cast<float>(scale * flags.line_width);
    lines.add(from.line(l), style);
  }
  return lines;
}

struct DeviationColours {
  std::vector<Rgb> face;  // of the input's triangles
  ColourScale scale;
};

DeviationColours deviation_colours(const Work& work, const RenderFlags& flags, const LayoutView& layout) {
  const std::filesystem::path path = std::filesystem::path(flags.input) / "deviation.ply";
  std::vector<Real> percent = read_face_deviation(work, path), area;
  const MeshView mesh = layout.mesh;
  if (percent.size() != mesh.face_count())
    throw Error(ErrorCode::bad_file,
                fmt::format("{}: it has {} triangles, the result {}; let intarsia eval {} write it again",
                            path.string(), percent.size(), mesh.face_count(), flags.input));
  for (Real& p : percent) p *= 100 / layout.diagonal;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto c = mesh.face(f);
    area.push_back((mesh.point(c[1]) - mesh.point(c[0])).cross(mesh.point(c[2]) - mesh.point(c[0])).norm() / 2);
  }
  DeviationColours out;
  out.scale = scale_for(percent, area, "distance, % of the diagonal");
  out.face = colours_of(work, percent, out.scale);
  return out;
}

// Pictures from this height on carry the scale of their colours.
constexpr int kLeastWithScale = 240;

Image draw(const Work& work, const RenderFlags& flags, int width, int height) {
  const auto result = LayoutHandover::read(work, flags.input);
  const LayoutView& layout = result->handover().layout;
  std::vector<Rgb> colour;
  for (const auto& c : layout.patch_colour) colour.push_back({c[0], c[1], c[2]});
  Shape shape = shape_of(layout.refined->mesh.view());
  DeviationColours deviation;
  const bool with_scale = flags.stage == "deviation" && height >= kLeastWithScale;
  if (with_scale) height -= kScaleBarHeight;
  if (flags.stage == "patches") {
    shape.face_label = layout.labels->patch_of_face, shape.label_colour = colour;
  } else if (flags.stage == "deviation") {
    deviation = deviation_colours(work, flags, layout);
    shape = shape_of(layout.mesh), shape.face_colour = deviation.face;
  }
  FitOptions fit;
  fit.width = width, fit.height = height, fit.margin = 0.03 * std::min(width, height);
  fit.perspective = flags.perspective;
  const View view = view_of(work, flags, shape_of(layout.mesh));
  Camera camera = fit_camera(work, shape, view, fit);
  camera.scale *= flags.zoom;
  const Real scale = std::min(width, height) / 560.;  // widths of lines are for that size
  Lines lines;
  if (flags.stage == "raw" || flags.stage == "filtered") {
    const PageFeatures features =
        read_page_features(std::filesystem::path(flags.input) / "view.html", grid_of(layout.refined->mesh));
    lines = feature_lines_of(flags.stage == "raw" ? features.raw : features.chosen, flags, scale);
  } else if (flags.stage != "input") {
    lines = arc_lines(layout, flags, scale);
  }
  const Image image = render(work, shape, flags.lines == "none" ? Lines() : lines, camera, flags.samples);
  return with_scale ? with_scale_bar(image, deviation.scale) : image;
}

int run_render(const RenderFlags& flags) {
  const auto [width, height] = size_of(flags.size);
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  context.execute([&, w = width, h = height] { write_png(flags.output, draw(work, flags, w, h)); });
  if (!flags.quiet) fmt::print("written to {}\n", flags.output);
  return kExitDone;
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* command = app.add_subcommand("render", "draw a result as a picture, without a display");
  command->add_option("input", flags->input, "folder written by intarsia run")->required();
  command->add_option("-o,--output", flags->output, "picture: .png")->required()->check(file_ending(".png"));
  command->add_option("--size", flags->size, "pixels, WIDTHxHEIGHT")->capture_default_str();
  command
      ->add_option("--stage", flags->stage,
                   "input: the surface; raw: all ridges and valleys; filtered: those that were chosen; network: the "
                   "borders by kind; patches; deviation: of the rebuilt surface, after intarsia eval")
      ->check(CLI::IsMember({"input", "raw", "filtered", "network", "patches", "deviation"}))
      ->capture_default_str();
  auto* view = command->add_option("--view", flags->view, "azimuth and elevation, degrees, z up; default: chosen");
  view->expected(2)->delimiter(',')->check(CLI::Range(-360.0, 360.0));
  command
      ->add_option("--camera", flags->camera,
                   "direction towards the viewer X,Y,Z, and the vertical X,Y,Z; the key C of the page copies it")
      ->expected(3, 6)
      ->delimiter(',')
      ->excludes(view);
  command->add_option("--zoom", flags->zoom, "1: the whole object")->check(CLI::Range(0.05, 100.0));
  command->add_option("--perspective", flags->perspective, "0: parallel")->check(CLI::Range(0.0, 0.49));
  command->add_option("--lines", flags->lines, "auto, kinds, plain or none")
      ->check(CLI::IsMember({"auto", "kinds", "plain", "none"}))
      ->capture_default_str();
  command->add_option("--line-width", flags->line_width, "times the usual width")->check(CLI::Range(0.1, 10.0));
  command->add_option("--samples", flags->samples, "per pixel and side")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] {
    if (flags->camera.size() != 0 && flags->camera.size() != 3 && flags->camera.size() != 6)
      throw Error(ErrorCode::bad_argument, "--camera takes three numbers or six");
    exit_code = run_render(*flags);
  });
}

}  // namespace intarsia::tools
