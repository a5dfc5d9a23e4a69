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
  // Errors (of both): bad_file naming the file; rejected.
  static std::unique_ptr<LayoutHandover> read(const Work& work, const std::filesystem::path& folder);
  // The same where the layout of that folder has been read. Requires: it stays as it is while this lives.
  static std::unique_ptr<LayoutHandover> of(const Work& work, const std::filesystem::path& folder,
                                            const LayoutFromFile& layout);
  LayoutHandover(const LayoutHandover&) = delete;
  LayoutHandover& operator=(const LayoutHandover&) = delete;

  const Handover& handover() const { return handover_; }

 private:
  LayoutHandover() = default;
  void look_at(const LayoutFromFile& layout);

  LayoutFromFile layout_;  // of read()
  PatchLabels labels_;
  std::vector<Index> vertex_order_, face_order_, face_patch_;
  std::vector<std::array<std::uint8_t, 3>> colour_;
  CurveNetwork no_interior_;
  Handover handover_;
};

}  // namespace intarsia::tools
