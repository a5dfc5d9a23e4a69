#include "tools/export/handover.h"

#include "engine/parallel/single_precision.h"

namespace intarsia::tools {

void complete(const Work& work, Handover& handover) {
  const LayoutView& layout = handover.layout;
  handover.input_patch = input_patches(work, layout);
  handover.single =
      is_single_precision(work, *layout.soup, layout.soup->vertex_count(), [](std::size_t v) { return v; });
}

}  // namespace intarsia::tools
