// The strip of five pictures that shows a run: input, raw lines, filtered curves, closed network, patches.
#pragma once

#include "engine/io/write_layout.h"
#include "graph/artefacts.h"
#include "tools/picture/image.h"

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

Image draw_preview(const Work& work, const PreviewInput& input);

}  // namespace intarsia::tools
