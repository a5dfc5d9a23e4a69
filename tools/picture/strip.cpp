#include "tools/picture/strip.h"

#include <array>
#include <cmath>
#include <tuple>

#include "tools/picture/best_view.h"
#include "tools/picture/font.h"
#include "tools/picture/png_file.h"

namespace intarsia::tools {
namespace {

struct LegendItem {
  CurveKind kind;
  const char* name;
};
constexpr std::array<LegendItem, kCurveKinds> kLegend = {{{CurveKind::ridge, "ridge"},
                                                          {CurveKind::valley, "valley"},
                                                          {CurveKind::sharp, "sharp edge"},
                                                          {CurveKind::border, "border"},
                                                          {CurveKind::extension, "extension"},
                                                          {CurveKind::subdivision, "subdivision"},
                                                          {CurveKind::given, "given"}}};

const TextStyle kTitle = {17.0f, 0.145f, {28, 30, 36}};
const TextStyle kCaption = {13.0f, 0.12f, {98, 102, 112}};
constexpr int kGap = 14, kTitleBaseline = 30, kCaptionBaseline = 54;  // pixels; baselines are below the panel

std::vector<LegendItem> kinds_shown(const Strip& strip) {
  std::vector<LegendItem> shown;
  for (const LegendItem& item : kLegend) {
    const Rgb colour = style_of(item.kind).colour;
    bool found = false;
    for (const Panel& p : strip.panel)
      found = found || std::any_of(p.lines.style.begin(), p.lines.style.end(),
                                   [&](const LineStyle& s) { return s.colour == colour; });
    if (found) shown.push_back(item);
  }
  return shown;
}

void draw_legend(Image& image, const std::vector<LegendItem>& items, float baseline) {
  constexpr float kDash = 34, kSpace = 10, kBetween = 40;
  float width = -kBetween;
  for (const LegendItem& item : items) width += kDash + kSpace + text_width(item.name, kCaption) + kBetween;
  float x = 0.5f * (static_cast<float>(image.width) - width);
  for (const LegendItem& item : items) {
    const LineStyle style = style_of(item.kind);
    const float y = baseline - 0.35f * kCaption.size;
    draw_stroke(image, x, y, x + kDash, y, style.width + 1.2f, style.colour);
    x += kDash + kSpace;
    draw_text(image, x, baseline, item.name, kCaption);
    x += text_width(item.name, kCaption) + kBetween;
  }
}

Camera camera_of(const Work& work, const Strip& strip) {
  if (strip.panel.empty()) throw Error(ErrorCode::bad_argument, "a strip needs at least one panel");
  const Shape& first = strip.panel.front().shape;
  FitOptions fit;
  fit.width = strip.options.width, fit.height = strip.options.height;
  return fit_camera_tightly(work, first, strip.options.view ? *strip.options.view : best_view(work, first), fit, 200);
}

// place(i): the picture of panel i and the panel's upper left corner there.
template <class Place>
void shade_panels(const Work& work, const Strip& strip, const Camera& camera, const Place& place) {
  Scene scene;
  const Shape* prepared = nullptr;
  for (int i = 0; i < static_cast<int>(strip.panel.size()); ++i) {
    const Panel& panel = strip.panel[static_cast<std::size_t>(i)];
    if (!prepared || !prepared->same_geometry(panel.shape) || prepared->smooth != panel.shape.smooth ||
        prepared->vertex_normal.x.data() != panel.shape.vertex_normal.x.data())
      prepare_scene(work, panel.shape, camera, strip.options.samples, strip.options.shade, scene);
    prepared = &panel.shape;
    const auto [image, left, top] = place(i);
    shade(work, panel.shape, panel.lines, scene, *image, left, top);
  }
}

}  // namespace

Image draw_strip(const Work& work, const Strip& strip) {
  const StripOptions& o = strip.options;
  const Camera camera = camera_of(work, strip);

  const int count = static_cast<int>(strip.panel.size());
  const int per_row = o.per_row > 0 ? std::min(o.per_row, count) : count, rows = (count + per_row - 1) / per_row;
  const bool captions =
      std::any_of(strip.panel.begin(), strip.panel.end(), [](const Panel& p) { return !p.caption.empty(); });
  const int text = (captions ? kCaptionBaseline : kTitleBaseline) + 14;
  const std::vector<LegendItem> legend = o.legend ? kinds_shown(strip) : std::vector<LegendItem>{};
  const int below = legend.empty() ? 0 : 36;
  Image image(per_row * camera.width + (per_row + 1) * kGap, rows * (camera.height + text) + kGap + below);

  const auto corner = [&](int i) {
    return std::pair{kGap + (i % per_row) * (camera.width + kGap), kGap + (i / per_row) * (camera.height + text)};
  };
  shade_panels(work, strip, camera, [&](int i) { return std::tuple{&image, corner(i).first, corner(i).second}; });
  for (int i = 0; i < count; ++i) {
    const Panel& panel = strip.panel[static_cast<std::size_t>(i)];
    const auto [left, top] = corner(i);
    const float centre = static_cast<float>(left) + 0.5f * static_cast<float>(camera.width);
    const auto bottom = static_cast<float>(top + camera.height), room = static_cast<float>(camera.width + kGap - 4);
    draw_centred(image, centre, bottom + kTitleBaseline, panel.title, kTitle, room);
    draw_centred(image, centre, bottom + kCaptionBaseline, panel.caption, kCaption, room);
  }
  if (!legend.empty()) draw_legend(image, legend, static_cast<float>(image.height) - 14);
  return image;
}

std::vector<Image> draw_panels(const Work& work, const Strip& strip) {
  const Camera camera = camera_of(work, strip);
  std::vector<Image> images(strip.panel.size(), Image(camera.width, camera.height));
  shade_panels(work, strip, camera, [&](int i) { return std::tuple{&images[static_cast<std::size_t>(i)], 0, 0}; });
  return images;
}

void write_panels(const Work& work, const Strip& strip, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::vector<Image> images = draw_panels(work, strip);
  for (std::size_t i = 0; i < images.size(); ++i) {
    std::string name = strip.panel[i].title;
    std::replace(name.begin(), name.end(), ' ', '-');
    write_png(folder / (name + ".png"), images[i]);
  }
}

}  // namespace intarsia::tools
