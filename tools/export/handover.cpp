#include "tools/export/handover.h"

#include "engine/parallel/for_each.h"
#include "engine/parallel/single_precision.h"

namespace intarsia::tools {

void complete(const Work& work, Handover& handover) {
  const LayoutView& layout = handover.layout;
  handover.input_patch.assign(layout.soup->face_count(), 0);
  for_each(work, Cost::light, layout.face_order.size(),
           [&](std::size_t f) { handover.input_patch[layout.face_order[f]] = layout.face_patch[f]; });
  handover.single =
      is_single_precision(work, *layout.soup, layout.soup->vertex_count(), [](std::size_t v) { return v; });
}

}  // namespace intarsia::tools
