#include "tools/picture/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace intarsia::tools {
namespace {

// A glyph is a list of strokes separated by spaces. A stroke is a list of points, two characters each (x, then y, in
// base 36). Baseline 4, x-height 12 ('c'), capitals to 16 ('g'), descenders to 0. A leading '~' makes the points
// the control points of an open quadratic B-spline that starts and ends at its first and last point, '@' of a closed
// one, '.' a dot.
struct Glyph {
  int advance;
  const char* strokes;
};

constexpr int kBaseline = 4, kCapital = 12;  // units; a capital letter is kCapital high

constexpr std::array<Glyph, 95> kGlyphs = {{
    {5, ""},                                          // space
    {3, "0g08 .04"},                                  // !
    {6, "0g0c 3g3c"},                                 // "
    {11, "3g14 7g54 0c8c 0888"},                      // #
    {10, "~6b5c0c0868641405 3h33"},                   // $
    {13, "9g14 @0g4g4c0c @68a8a464"},                 // %
    {12, "~941d2g5g5c0a046499"},                      // &
    {3, "0g0c"},                                      // '
    {6, "~3h0e0632"},                                 // (
    {6, "~0h3e3602"},                                 // )
    {9, "3g3a 0f6b 0b6f"},                            // *
    {11, "4c44 0888"},                                // +
    {4, "1402"},                                      // ,
    {8, "0858"},                                      // -
    {3, ".04"},                                       // .
    {9, "036h"},                                      // /
    {10, "@0g7g7404"},                                // 0
    {8, "0d3g34"},                                    // 1
    {10, "~0d0g7g7b04 0474"},                         // 2
    {10, "~0e1g6g6a3a ~3a7a741406"},                  // 3
    {11, "5g0878 5g54"},                              // 4
    {10, "6g1g1a ~1a2b7b741405"},                     // 5
    {10, "@0b7b7404 ~080e5g"},                        // 6
    {10, "0g7g24"},                                   // 7
    {10, "@1g6g6a1a @0a7a7404"},                      // 8
    {10, "@0g7g7909 ~7c7624"},                        // 9
    {3, ".0b .04"},                                   // :
    {4, ".1b 1402"},                                  // ;
    {10, "7c0874"},                                   // <
    {10, "0a7a 0676"},                                // =
    {10, "0c7804"},                                   // >
    {9, "~0e0g6g6b3b38 .34"},                         // ?
    {14, "@3c7c7636 7c77 ~7776b6bg0g0292"},           // @
    {11, "044g84 2969"},                              // A
    {11, "040g 0g4g ~4g7g7a4a 0a4a ~4a8a8444 0444"},  // B
    {11, "~8e6g0g046486"},                            // C
    {11, "040g 0g3g ~3g8g8434 3404"},                 // D
    {10, "7g0g0474 0a6a"},                            // E
    {10, "7g0g04 0a6a"},                              // F
    {11, "~8e6g0g04848a 8a5a"},                       // G
    {11, "040g 848g 0a8a"},                           // H
    {7, "0g4g 2g24 0444"},                            // I
    {8, "5g57 ~57540407"},                            // J
    {10, "040g 7g08 3b74"},                           // K
    {9, "0g0474"},                                    // L
    {13, "040g57aga4"},                               // M
    {11, "040g848g"},                                 // N
    {12, "@0g9g9404"},                                // O
    {10, "040g 0g4g ~4g8g8949 4909"},                 // P
    {12, "@0g9g9404 6793"},                           // Q
    {11, "040g 0g4g ~4g8g8949 4909 4984"},            // R
    {10, "~7e6g0g0a7a741406"},                        // S
    {11, "0g8g 4g44"},                                // T
    {11, "0g08 ~08048488 888g"},                      // U
    {11, "0g448g"},                                   // V
    {15, "0g346g94cg"},                               // W
    {11, "0g84 048g"},                                // X
    {11, "0g4a8g 4a44"},                              // Y
    {11, "0g8g0484"},                                 // Z
    {6, "3h0h0232"},                                  // [
    {9, "0h63"},                                      // backslash
    {6, "0h3h3202"},                                  // ]
    {9, "0c3g6c"},                                    // ^
    {11, "0282"},                                     // _
    {5, "0g2d"},                                      // `
    {9, "@0c6c6404 6c64"},                            // a
    {9, "@0c6c6404 0g04"},                            // b
    {9, "~6b5c0c045465"},                             // c
    {9, "@0c6c6404 6g64"},                            // d
    {9, "0868 ~686c0c045465"},                        // e
    {6, "~5g2g2d 2d24 0c4c"},                         // f
    {9, "@0c6c6404 6c62 ~62601001"},                  // g
    {9, "0g04 ~090c6c69 6964"},                       // h
    {3, "0c04 .0f"},                                  // i
    {5, "2c22 ~222000 .2f"},                          // j
    {9, "0g04 6c07 2864"},                            // k
    {3, "0g04"},                                      // l
    {13, "0c04 ~090c5c59 5954 ~595cacaa aaa4"},       // m
    {9, "0c04 ~090c6c69 6964"},                       // n
    {10, "@0c7c7404"},                                // o
    {9, "@0c6c6404 0c00"},                            // p
    {9, "@0c6c6404 6c60"},                            // q
    {6, "0c04 ~090c4c"},                              // r
    {9, "~5b4c0c0868641405"},                         // s
    {7, "2f26 ~262454 0c5c"},                         // t
    {9, "0c07 ~07046467 6c64"},                       // u
    {9, "0c346c"},                                    // v
    {13, "0c345c84bc"},                               // w
    {9, "0c64 046c"},                                 // x
    {9, "0c34 6c34 ~342100"},                         // y
    {9, "0c6c0464"},                                  // z
    {6, "~4h2h2909 ~09292141"},                       // {
    {3, "0h01"},                                      // |
    {6, "~0h2h2949 ~49292101"},                       // }
    {10, "~082b5578"},                                // ~
}};
constexpr Glyph kUnknown = {9, "060g6g6404"};

const Glyph& glyph_of(char c) { return c >= ' ' && c <= '~' ? kGlyphs[static_cast<std::size_t>(c - ' ')] : kUnknown; }

struct Point {
  float x, y;
};

// Coverage of the pixels by one glyph or stroke: strokes of a glyph join without darker spots because the largest
// coverage counts.
class Mask {
 public:
  Mask(float x0, float y0, float x1, float y1)
      : left_(static_cast<int>(std::floor(x0))),
        top_(static_cast<int>(std::floor(y0))),
        width_(static_cast<int>(std::ceil(x1)) - left_ + 1),
        height_(static_cast<int>(std::ceil(y1)) - top_ + 1),
        coverage_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0f) {}

  void stroke(Point a, Point b, float width) {
    const float half = 0.5f * width, dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const int x0 = static_cast<int>(std::floor(std::min(a.x, b.x) - half - 1)) - left_;
    const int x1 = static_cast<int>(std::ceil(std::max(a.x, b.x) + half + 1)) - left_;
    const int y0 = static_cast<int>(std::floor(std::min(a.y, b.y) - half - 1)) - top_;
    const int y1 = static_cast<int>(std::ceil(std::max(a.y, b.y) + half + 1)) - top_;
    for (int y = std::max(0, y0); y < std::min(height_, y1 + 1); ++y)
      for (int x = std::max(0, x0); x < std::min(width_, x1 + 1); ++x) {
        const float px = static_cast<float>(x + left_) + 0.5f - a.x, py = static_cast<float>(y + top_) + 0.5f - a.y;
        const float t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0f, 1.0f) : 0.0f;
        const float distance = std::hypot(px - t * dx, py - t * dy);
        float& cell =
            coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        cell = std::max(cell, std::clamp(half + 0.5f - distance, 0.0f, 1.0f));
      }
  }
  void blend(Image& image, Rgb colour) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float c =
            coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        if (c > 0 && image.contains(x + left_, y + top_)) {
          Rgb& pixel = image.at(x + left_, y + top_);
          pixel = mix(pixel, colour, c);
        }
      }
  }

 private:
  int left_, top_, width_, height_;
  std::vector<float> coverage_;
};

float unit(char c) { return static_cast<float>(c <= '9' ? c - '0' : c - 'a' + 10); }

// The stroke as a polyline in glyph units.
std::vector<Point> flatten(std::string_view stroke) {
  const char form = stroke.front();
  if (form == '~' || form == '@' || form == '.') stroke.remove_prefix(1);
  std::vector<Point> control;
  for (std::size_t i = 0; i + 1 < stroke.size(); i += 2) control.push_back({unit(stroke[i]), unit(stroke[i + 1])});
  if (form != '~' && form != '@') return control;
  const auto middle = [](Point a, Point b) { return Point{0.5f * (a.x + b.x), 0.5f * (a.y + b.y)}; };
  const std::size_t n = control.size();
  std::vector<Point> line;
  const auto arc = [&](Point a, Point c, Point b) {
    constexpr int kSteps = 8;
    for (int i = line.empty() ? 0 : 1; i <= kSteps; ++i) {
      const float t = static_cast<float>(i) / kSteps, u = 1 - t;
      line.push_back({u * u * a.x + 2 * u * t * c.x + t * t * b.x, u * u * a.y + 2 * u * t * c.y + t * t * b.y});
    }
  };
  if (form == '@') {
    for (std::size_t i = 0; i < n; ++i)
      arc(middle(control[(i + n - 1) % n], control[i]), control[i], middle(control[i], control[(i + 1) % n]));
  } else {
    for (std::size_t i = 1; i + 1 < n; ++i)
      arc(i == 1 ? control[0] : middle(control[i - 1], control[i]), control[i],
          i + 2 == n ? control[n - 1] : middle(control[i], control[i + 1]));
  }
  return line;
}

}  // namespace

float text_width(std::string_view text, const TextStyle& style) {
  int units = 0;
  for (char c : text) units += glyph_of(c).advance;
  return static_cast<float>(units) * style.size / kCapital;
}

void draw_text(Image& image, float x, float y, std::string_view text, const TextStyle& style) {
  const float scale = style.size / kCapital, width = style.weight * style.size;
  for (char c : text) {
    const Glyph& glyph = glyph_of(c);
    const float right = x + static_cast<float>(glyph.advance) * scale;
    Mask mask(x - width - 2, y - 1.3f * style.size - 2, right + width + 2, y + 0.5f * style.size + 2);
    std::string_view rest = glyph.strokes;
    while (!rest.empty()) {
      const std::string_view stroke = rest.substr(0, rest.find(' '));
      rest.remove_prefix(std::min(rest.size(), stroke.size() + 1));
      std::vector<Point> line = flatten(stroke);
      for (Point& p : line) p = {x + scale * (p.x + 0.5f), y - scale * (p.y - kBaseline)};
      const bool dot = stroke.front() == '.';
      if (dot) line.push_back(line.front());
      for (std::size_t i = 0; i + 1 < line.size(); ++i) mask.stroke(line[i], line[i + 1], dot ? 1.3f * width : width);
    }
    mask.blend(image, style.colour);
    x = right;
  }
}

void draw_text_within(Image& image, float x, float y, std::string_view text, const TextStyle& style, float room) {
  TextStyle fitting = style;
  if (const float width = text_width(text, style); width > room) fitting.size *= room / width;
  draw_text(image, x, y, text, fitting);
}

void draw_centred(Image& image, float centre, float y, std::string_view text, const TextStyle& style, float room) {
  const float width = std::min(room, text_width(text, style));
  draw_text_within(image, std::round(centre - 0.5f * width), y, text, style, room);
}

void draw_stroke(Image& image, float x0, float y0, float x1, float y1, float width, Rgb colour) {
  Mask mask(std::min(x0, x1) - width - 2, std::min(y0, y1) - width - 2, std::max(x0, x1) + width + 2,
            std::max(y0, y1) + width + 2);
  mask.stroke({x0, y0}, {x1, y1}, width);
  mask.blend(image, colour);
}

}  // namespace intarsia::tools
