// The strip of five pictures that shows a run: input, raw lines, filtered curves, closed network, patches.
#pragma once

#include <optional>

#include "engine/io/write_layout.h"
#include "graph/artefacts.h"
#include "tools/picture/camera.h"
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

// view: where from; none = chosen from the geometry.
Image draw_preview(const Work& work, const PreviewInput& input, const std::optional<View>& view = {});

}  // namespace intarsia::tools
