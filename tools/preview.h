// The strip of five pictures that shows a run: input, raw lines, filtered curves, closed network, patches.
#pragma once

#include <optional>
#include <string>

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

struct BaselinePreviewInput {
  const graph::Surface& surface;
  const graph::Patches& patches;  // per face of the surface
  const graph::Layout& layout;
  const std::string& method;
  std::span<const Rgb> patch_colour;
};

// Input, the method's labels as they came, and the layout made of them.
Image draw_baseline_preview(const Work& work, const BaselinePreviewInput& input, const std::optional<View>& view = {});

}  // namespace intarsia::tools
