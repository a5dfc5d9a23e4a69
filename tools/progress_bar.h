// Progress for people: a bar with the time left on a terminal, one line a stage elsewhere. For programs: a line of JSON
// for each event. On standard error.
#pragma once

#include <chrono>
#include <string>

#include "engine/run/progress.h"

namespace intarsia::tools {

class ProgressBar : public ProgressListener {
 public:
  enum class Style : std::uint8_t { none, lines, bar, json };
  static Style style_for_terminal();  // bar if standard error is a terminal
  // "auto", "bar", "lines", "json", "none". Requires: one of these.
  static Style style_of(const std::string& name);

  explicit ProgressBar(Style style) : style_(style) {}
  ~ProgressBar() override;

  void stage_begin(const ProgressEvent& event) override { tell("begin", event); }
  void advance(const ProgressEvent& event) override { tell("advance", event); }
  void stage_end(const ProgressEvent& event) override { tell("end", event); }

 private:
  void tell(const char* what, const ProgressEvent& event);
  void draw(const ProgressEvent& event, double left) const;
  Style style_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Seconds that a run still takes, judged by what it took so far; negative while it is too early to say.
double seconds_left(double seconds_so_far, double fraction_done);

// "12 s", "3 min", "2.1 h".
std::string duration_text(double seconds);

}  // namespace intarsia::tools
