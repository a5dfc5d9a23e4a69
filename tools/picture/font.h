// Text in a small stroke font of our own, drawn anti-aliased at any size. Printable ASCII; anything else shows as a
// box.
#pragma once

#include <string_view>

#include "tools/picture/image.h"

namespace intarsia::tools {

struct TextStyle {
  float size = 11;       // height of a capital letter, pixels
  float weight = 0.14f;  // thickness of the strokes, as a fraction of the size
  Rgb colour = {40, 42, 48};
};

// Length of the text in pixels.
float text_width(std::string_view text, const TextStyle& style);

// Draws text with its left end at x and its baseline at y (pixels, from the upper left corner of the image). Parts
// outside the image are cut.
void draw_text(Image& image, float x, float y, std::string_view text, const TextStyle& style);

// The same, smaller where it would be wider than `room`.
void draw_text_within(Image& image, float x, float y, std::string_view text, const TextStyle& style, float room);
void draw_centred(Image& image, float centre, float y, std::string_view text, const TextStyle& style, float room);

// A thick line with round ends, for legends. Pixels, from the upper left corner.
void draw_stroke(Image& image, float x0, float y0, float x1, float y1, float width, Rgb colour);

}  // namespace intarsia::tools
