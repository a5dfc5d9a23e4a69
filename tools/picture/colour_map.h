// Numbers as colours: a sequential map for shaded surfaces, and the bar that explains it.
//
//   const ColourScale scale = scale_for(values, weights, "distance, % of diagonal");
//   shape.face_colour = colours;                       // colours = colours_of(work, values, scale)
//   Image image = draw_strip(work, strip);
//   image = with_scale_bar(image, scale);              // or draw_scale_bar() into a place of its own
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/types.h"
#include "engine/parallel/work.h"
#include "tools/picture/image.h"

namespace intarsia::tools {

// t = 0 is nearly white and t = 1 a dark violet; lightness falls evenly over yellow-green, teal and blue, so that the
// order can be read without colour, equal steps look equal (OKLab), and shading stays visible where values are small.
// t outside [0, 1] counts as its nearest end.
Rgb map_colour(Real t);

struct ColourScale {
  Real top = 1;       // value of the darkest colour; 0 is the lightest
  bool open = false;  // values above top exist
  std::string label;  // ASCII
};

// A scale from 0 to a round number: at least the value that all but `beyond` of the total weight stay below.
// Requires: weights as many as values, or none (all alike).
ColourScale scale_for(std::span<const Real> value, std::span<const Real> weight, std::string label,
                      Real beyond = 0.005);

std::vector<Rgb> colours_of(const Work& work, std::span<const Real> value, const ColourScale& scale);

inline constexpr int kScaleBarHeight = 62;  // pixels, text included

// Bar, numbers and label with the upper left corner at (left, top). Parts outside the image are cut.
void draw_scale_bar(Image& image, int left, int top, int width, const ColourScale& scale);

// The picture with the bar below it, centred.
Image with_scale_bar(const Image& picture, const ColourScale& scale);

// Pictures side by side on white, tops aligned.
Image beside(const Image& a, const Image& b);

}  // namespace intarsia::tools
