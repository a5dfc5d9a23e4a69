// Artefacts of stages in a folder, for the next run: a killed or changed run begins at the first stage whose inputs,
// options or program changed. What it resumes from is what it would compute, bit by bit.
//
// Every artefact has a key: the hash of the program, of the stage with its options, and of the keys of its inputs, down
// to the bits of what was read. A file that carries another key, is cut, or has a wrong checksum is as good as none.
// There is one file for each stage, that of the last run which computed it, under its name or the old one, never half.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "engine/run/node_spec.h"
#include "engine/run/record.h"

namespace intarsia {

// The folder. Shared by any number of flows, one after the other or at once.
class Checkpoints {
 public:
  // Makes the folder if there is none. program: hash of the program that computes.
  // Errors: write_failed if there is no such folder to write into.
  Checkpoints(const std::filesystem::path& folder, std::uint64_t program);

  std::uint64_t program() const { return program_; }
  std::filesystem::path file_of(const NodeSpec& node) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t program_;
};

// What one flow takes from the folder and puts into it. All members may be called from any thread.
class CheckpointPlan {
 public:
  // Requires: all arguments outlive this object; no nodes are added any more.
  CheckpointPlan(const Checkpoints& checkpoints, const std::vector<NodeSpec>& nodes, RunRecord& record);

  enum class Action : std::uint8_t { compute, restore, skip };

  // Before the node's body. The first call decides for all nodes and reads what is needed: an artefact that is there is
  // restored if a stage that must be computed or somebody after the run wants it, and skipped otherwise.
  // Errors: cancelled; no_memory.
  Action begin(const Work& work, Index node);
  // Of a node that was not computed: as it was then.
  const NodeOutcome& outcome(Index node) const { return entry_[node].outcome; }
  // After the body of a computed node. exact: the artefact is what the options ask for; others are never stored, nor
  // what is made from them. Failures to write become warnings.
  void end(const Work& work, Index node, const NodeOutcome& outcome, bool exact);

 private:
  struct Entry {
    Action action = Action::compute;
    bool has_key = false, is_exact = true;
    std::uint64_t key = 0;
    NodeOutcome outcome;
  };

  void plan(const Work& work);
  void find_key(Index node);
  bool look_up(const Work& work, Index node, bool with_artefact);

  const Checkpoints& checkpoints_;
  const std::vector<NodeSpec>& nodes_;
  RunRecord& record_;
  std::mutex mutex_;
  bool planned_ = false;
  std::vector<Entry> entry_;
};

}  // namespace intarsia
