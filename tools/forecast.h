// What a run will cost (graph/cost_model.h), from a file that has not been read, and what may be spent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "graph/cost_model.h"

namespace intarsia::tools {

using graph::CostModel;
using graph::Forecast;
using graph::kFeaturesCost;
using graph::kRunCost;

// Vertices of the mesh in a file, from its first bytes and its size alone: exact for PLY and OFF; for STL and OBJ what
// a closed surface has. 0 where it cannot be told.
std::uint64_t vertices_in(const std::filesystem::path& file);

// Memory that this process may still take: what the system has available or what its control group allows, whichever
// is less.
std::uint64_t available_memory();

// "1.65 GB".
std::string memory_text(std::uint64_t bytes);

// Errors: no_memory if more than `most` bytes are wanted; 0 = no limit.
void check_memory(const Forecast& forecast, std::uint64_t most);

}  // namespace intarsia::tools
