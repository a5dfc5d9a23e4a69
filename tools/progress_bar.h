// Progress for people: a bar on a terminal, one line a stage elsewhere. On standard error.
#pragma once

#include <string>

#include "engine/run/progress.h"

namespace intarsia::tools {

class ProgressBar : public ProgressListener {
 public:
  enum class Style : std::uint8_t { none, lines, bar };
  static Style style_for_terminal();  // bar if standard error is a terminal

  explicit ProgressBar(Style style) : style_(style) {}
  ~ProgressBar() override;

  void stage_begin(const ProgressEvent& event) override;
  void advance(const ProgressEvent& event) override;
  void stage_end(const ProgressEvent& event) override;

 private:
  void draw(const ProgressEvent& event);
  Style style_;
  bool drawn_ = false;
};

}  // namespace intarsia::tools
