#include "tools/progress_bar.h"

#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

namespace intarsia::tools {

ProgressBar::Style ProgressBar::style_for_terminal() { return isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines; }

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::stage_begin(const ProgressEvent& event) {
  if (style_ == Style::bar) draw(event);
}

void ProgressBar::advance(const ProgressEvent& event) {
  if (style_ == Style::bar) draw(event);
}

void ProgressBar::stage_end(const ProgressEvent& event) {
  if (style_ == Style::bar) draw(event);
  if (style_ == Style::lines)
    fmt::print(stderr, "{:3.0f} %  {}{}{}\n", std::floor(100 * event.overall), event.stage,
               event.branch.empty() ? "" : " ", event.branch);
}

void ProgressBar::draw(const ProgressEvent& event) {
  constexpr int kWidth = 30;
  const int full = static_cast<int>(std::lround(kWidth * event.overall));
  fmt::print(stderr, "\r\033[K[{:=<{}}{: <{}}] {:3.0f} %  {} {}", "", full, "", kWidth - full,
             std::floor(100 * event.overall), event.stage, event.branch);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace intarsia::tools
