#include "tools/progress_bar.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace intarsia::tools {

double seconds_left(double seconds_so_far, double fraction_done) {
  constexpr double kTooEarly = 0.04, kLeastSeconds = 0.5;
  if (fraction_done < kTooEarly || seconds_so_far < kLeastSeconds) return -1;
  return seconds_so_far * (1 - fraction_done) / fraction_done;
}

std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} min", std::ceil(seconds / 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

ProgressBar::Style ProgressBar::style_for_terminal() { return isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines; }

ProgressBar::Style ProgressBar::style_of(const std::string& name) {
  return name == "bar"     ? Style::bar
         : name == "lines" ? Style::lines
         : name == "json"  ? Style::json
         : name == "none"  ? Style::none
                           : style_for_terminal();
}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::tell(const char* what, const ProgressEvent& event) {
  if (style_ == Style::none) return;
  const double so_far = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = seconds_left(so_far, event.overall);
  if (style_ == Style::bar) {
    draw(event, left);
    drawn_ = true;
  } else if (style_ == Style::lines && std::strcmp(what, "end") == 0) {
    fmt::print(stderr, "{:3.0f} %  {}{}{}\n", std::floor(100 * event.overall), event.stage,
               event.branch.empty() ? "" : " ", event.branch);
  } else if (style_ == Style::json) {
    nlohmann::ordered_json line = {
        {"event", what},
        {"run", event.run},
        {"stage", event.stage},
        {"branch", event.branch},
        {"fraction", event.stage_fraction},
        {"overall", event.overall},
        {"seconds", so_far},
        {"seconds_left", left < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(left)}};
    fmt::print(stderr, "{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
}

void ProgressBar::draw(const ProgressEvent& event, double left) const {
  constexpr int kWidth = 30;
  const int full = static_cast<int>(std::lround(kWidth * event.overall));
  fmt::print(stderr, "\r\033[K[{:=<{}}{: <{}}] {:3.0f} %  {}{}  {}{}", "", full, "", kWidth - full,
             std::floor(100 * event.overall), left < 0 ? "" : duration_text(left), left < 0 ? "" : " left", event.stage,
             event.branch.empty() ? "" : " " + event.branch);
  std::fflush(stderr);
}

}  // namespace intarsia::tools
