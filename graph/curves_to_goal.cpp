#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "graph/evaluate.h"
#include "graph/stages.h"

namespace intarsia::graph {
namespace {

// What a layout of so many patches rebuilds, by the curves alone.
class Trial {
 public:
  Trial(const Work& work, const Surface& surface, const Directions& directions, const Lines& lines,
        const Curves& curves, const Guides& guides, const LayoutOptions& options)
      : work_(work),
        surface_(surface),
        directions_(directions),
        lines_(lines),
        curves_(curves),
        guides_(guides),
        options_(options) {
    options_.tolerance = {};
  }

  struct Result {
    Index patches = 0;  // that there are; more cannot be reached once this stays behind what is asked for
    Real rms = 0;
  };

  // quick: without reconsidering patches, which makes layouts a little better and takes most of their time.
  const Result& operator()(Index wanted, bool quick) {
    const auto known = result_.find({wanted, quick});
    if (known != result_.end()) return known->second;
    options_.patches = wanted;
    options_.refine.rounds = quick ? 0 : rounds_;
    const Network network = curves_to_network(work_, surface_, directions_, curves_, guides_, options_);
    const Patches patches = network_to_patches(work_, surface_, network, options_);
    const Layout layout = smoothing_to_layout(
        work_, surface_, patches_to_smoothing(work_, surface_, lines_, network, patches, options_), options_);
    EvaluateOptions evaluation;
    evaluation.make_transfinite = evaluation.make_filled = false;
    evaluation.distance.samples = 200'000;
    Result r{layout.labels.count, 1};
    if (layout.labels.count > 1 || layout.graph.arc_count() > 0)
      r.rms = evaluate(work_, surface_, layout, evaluation).triangulated.distance.rms();
    return result_[{wanted, quick}] = r;
  }

  Index tries() const { return static_cast<Index>(result_.size()); }

 private:
  const Work& work_;
  const Surface& surface_;
  const Directions& directions_;
  const Lines& lines_;
  const Curves& curves_;
  const Guides& guides_;
  LayoutOptions options_;
  int rounds_ = options_.refine.rounds;
  std::map<std::pair<Index, bool>, Result> result_;
};

std::string percent(Real share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

}  // namespace

Goal curves_to_goal(const Work& work, const Surface& surface, const Directions& directions, const Lines& lines,
                    const Curves& curves, const Guides& guides, const LayoutOptions& options) {
  Goal goal;
  goal.patches = options.patches;
  if (!(options.tolerance.value > 0)) return goal;
  const Real wanted = options.tolerance.in_diagonals(surface.box.diagonal, surface.mean_edge);
  constexpr Index kFirst = 24, kMost = 20000, kMostTries = 9;
  constexpr Real kNearEnough = 1.05;
  Trial trial(work, surface, directions, lines, curves, guides, options);
  // The deviation falls about as 1 / patches: from a first layout to one that should do, then by bisection between the
  // most that does not do and the least that does.
  Index fails = 0, holds = kNone, at = kFirst, best = kFirst;
  while (trial.tries() < kMostTries && !work.is_late()) {
    const auto& [patches, rms] = trial(at, true);
    if (rms < trial(best, true).rms) best = at;
    if (rms <= wanted)
      holds = at;
    else
      fails = at;
    if (rms > wanted && (patches < at || at >= kMost)) break;  // no more can be had
    if (holds != kNone && (holds <= fails + 1 || holds <= kNearEnough * fails || holds == 1)) break;
    const Real guess = std::pow(rms / wanted, 1.1) * at;
    const Index next = static_cast<Index>(std::clamp<Real>(std::ceil(guess), 1, kMost));
    if (holds == kNone)
      at = std::max<Index>(next, at + at / 4 + 1);
    else if (fails == 0)
      at = std::min<Index>(next, holds - holds / 4 - 1);
    else
      at = std::clamp<Index>(static_cast<Index>(std::lround(std::sqrt(Real(fails) * holds))), fails + 1, holds - 1);
    at = std::clamp<Index>(at, 1, kMost);
  }
  goal.patches = holds == kNone ? best : holds;
  for (int more = 0;; ++more) {
    constexpr int kMostMore = 3;
    goal.rms = trial(goal.patches, false).rms;
    if (holds == kNone || goal.rms <= wanted || more == kMostMore || work.is_late()) break;
    goal.patches += std::max<Index>(1, goal.patches / 16);
  }
  goal.tries = trial.tries();
  if (goal.rms > wanted)
    goal.warnings.push_back("the tolerance of " + percent(wanted) +
                            " of the diagonal was not reached: " + std::to_string(goal.patches) +
                            " patches rebuild the surface to " + percent(goal.rms) + " (RMS)");
  return goal;
}

}  // namespace intarsia::graph
