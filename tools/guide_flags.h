// --curves and --pin: what the user wants kept.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "graph/guides.h"

namespace intarsia::tools {

struct GuideFlags {
  std::string curves, pin;
};

void add_guide_flags(CLI::App& app, GuideFlags& flags);

// Reads the curves at once, the pins when the mesh is known. Errors: bad_file.
graph::GuideSource guide_source(const Work& work, const GuideFlags& flags);

}  // namespace intarsia::tools
