// A result folder's layout, ready for the writers of tools/export.
#pragma once

#include <memory>

#include "tools/export/handover.h"
#include "tools/read_layout.h"

namespace intarsia::tools {

// Owns what its handover views; stays where it was made. There are no feature lines, no interior curves, and the arcs
// are known but not the kinds of single edges.
class LayoutHandover {
 public:
  // Errors: bad_file naming the file; rejected.
  static std::unique_ptr<LayoutHandover> read(const Work& work, const std::filesystem::path& folder);
  LayoutHandover(const LayoutHandover&) = delete;
  LayoutHandover& operator=(const LayoutHandover&) = delete;

  const Handover& handover() const { return handover_; }
  const LayoutFromFile& layout() const { return layout_; }

 private:
  LayoutHandover() = default;

  LayoutFromFile layout_;
  PatchLabels labels_;
  std::vector<Index> vertex_order_, face_order_, face_patch_;
  std::vector<std::array<std::uint8_t, 3>> colour_;
  CurveNetwork no_interior_;
  Handover handover_;
};

}  // namespace intarsia::tools
