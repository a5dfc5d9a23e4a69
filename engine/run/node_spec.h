// A node of a flow with its types erased.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/parallel/work.h"
#include "engine/run/record.h"

namespace intarsia {

class ArtefactReader;
class ArtefactWriter;

// What a node tells about its artefact.
struct NodeOutcome {
  std::uint64_t items = 0, bytes = 0, hash = 0;
  std::vector<Warning> warnings = {};
};

struct NodeSpec {
  std::string stage, branch;
  double weight = 1;
  std::vector<Index> after;                      // nodes that must have ended
  std::function<std::uint64_t()> input_items;    // asked when the node starts; a hint for progress
  std::function<NodeOutcome(const Work&)> body;  // runs once, isolated from other tasks of the arena
  std::function<void()> drop_artefact;           // called for every node after a failed run

  // For checkpoints; empty where there are none of this artefact.
  std::optional<std::uint64_t> recipe;           // hash of all that the artefact depends on beside its inputs
  std::function<std::uint64_t()> content;        // nodes without inputs: exact hash of the artefact, once it is there
  std::function<bool()> is_kept;                 // somebody wants the artefact after the run
  std::function<void()> release_inputs;          // instead of body
  std::function<void(ArtefactWriter&)> store;    // after body
  std::function<void(ArtefactReader&)> restore;  // instead of body
};

}  // namespace intarsia
