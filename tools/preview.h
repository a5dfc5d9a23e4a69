// The strip of five pictures that shows a run: input, raw lines, filtered curves, closed network, patches.
#pragma once

#include <string>

#include "engine/io/write_layout.h"
#include "graph/artefacts.h"
#include "tools/picture/strip.h"

namespace intarsia::tools {

struct PreviewInput {
  const graph::Surface& surface;
  const graph::Ridges& ridges;
  const graph::Ridges& valleys;
  const graph::Sharp& sharp;
  const graph::Network& network;
  const graph::Layout& layout;
  std::span<const Rgb> patch_colour;
};

// A view of its input, which must outlive it.
Strip preview_strip(const PreviewInput& input);

struct BaselinePreviewInput {
  const graph::Surface& surface;
  const graph::Patches& patches;  // per face of the surface
  const graph::Layout& layout;
  const std::string& method;
  std::span<const Rgb> patch_colour;
};

// Input, the method's labels as they came, and the layout made of them.
Strip baseline_strip(const BaselinePreviewInput& input);

}  // namespace intarsia::tools
