#include "kernels/scale/disc_voting.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/support/surface.h"

using namespace intarsia;
using namespace intarsia::kernels;
using namespace intarsia::test;

TEST_CASE("discs by packs are discs one by one, on every instruction set and in any order of clusters") {
  for (const Soup& soup : {ellipsoid(6, 1, 0.7, 0.4), jittered(plane(120, 90), 0.002, 3)}) {
    const TestSurface s = make_surface(soup);
    const LevelBuild build = build_sample_levels(Work{}, s.mesh, voting_faces(Work{}, s.mesh), 0.15);
    REQUIRE(build.levels.level.size() >= 3);
    DiscWalker walker(build.levels);
    std::vector<Index> clusters(build.levels.level[0].size());
    for (Index c = 0; c < clusters.size(); ++c) clusters[c] = c;
    std::vector<Real> omega(clusters.size()), again(clusters.size());
    DiscVoting voting(build);
    for (int code : {14, 16, 17}) {
      voting.run(clusters, code, omega);
      Real worst = 0;
      for (Index c = 0; c < clusters.size(); ++c)
        worst = std::max(worst, std::abs(omega[c] - disc_variation(build, c, code, walker)));
      CHECK(worst < 5e-6);
      for (InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2}) {
        if (set > instruction_set()) continue;
        // Backwards, and after larger discs have been looked at.
        DiscVoting other(build, set);
        std::reverse(clusters.begin(), clusters.end());
        other.run(clusters, 15, again);
        other.run(clusters, code, again);
        std::reverse(again.begin(), again.end()), std::reverse(clusters.begin(), clusters.end());
        CHECK(again == omega);
      }
    }
  }
}

TEST_CASE("discs that are not voted on are below the bound") {
  for (const Soup& soup : {ellipsoid(6, 1, 0.7, 0.4), jittered(plane(120, 90), 0.0002, 3)}) {
    const TestSurface s = make_surface(soup);
    const LevelBuild build = build_sample_levels(Work{}, s.mesh, voting_faces(Work{}, s.mesh), 0.15);
    std::vector<Index> clusters(build.levels.level[0].size());
    for (Index c = 0; c < clusters.size(); ++c) clusters[c] = c;
    std::vector<Real> omega(clusters.size()), some(clusters.size());
    DiscVoting voting(build), hasty(build);
    hasty.skip_below(0.1);
    Index skipped = 0, wrong = 0;
    for (int code : {13, 15, 17}) {
      voting.run(clusters, code, omega);
      hasty.run(clusters, code, some);
      for (Index c = 0; c < clusters.size(); ++c) {
        if (some[c] == omega[c]) continue;
        ++skipped;
        wrong += some[c] != 0 || omega[c] >= 0.1;
      }
    }
    CHECK(wrong == 0);
    CHECK(skipped > clusters.size() / 4);
  }
}
