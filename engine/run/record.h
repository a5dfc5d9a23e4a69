// What happened in a run: one entry per node, warnings, memory. Written as JSON into reports.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/base/types.h"

namespace intarsia {

// A fact the user should know although the run went on. Codes are stable lower-case words with hyphens.
struct Warning {
  std::string code;
  std::string message;
  std::uint64_t count = 1;  // elements concerned
  std::string stage;        // filled in by the node that reports it
};

// One executed node.
struct NodeRecord {
  std::string stage, branch;
  Index node = kNone;                            // place in the flow's order of declaration
  Real start = 0, wall = 0;                      // seconds; start counts from the start of the run
  Real cpu = 0;                                  // seconds of processor time, see CpuMeter
  std::uint64_t items = 0, bytes = 0, hash = 0;  // of the artefact
  bool restored = false;                         // not computed: from a checkpoint
  bool shortened = false;                        // it was late (Work::is_late): not all that was asked for
  int thread = 0;                                // place in the arena of the thread that ran the node's own code
};

// The nodes of one stage name together.
struct StageSummary {
  std::string name;
  Real wall = 0;  // time in which at least one of its nodes ran
  Real cpu = 0;   // sums over the nodes
  std::uint64_t items = 0, bytes = 0;
  bool restored = true;    // all of them come from checkpoints
  bool shortened = false;  // one of them was
  std::uint64_t hash = 0;  // of the single node, or of all hashes in order of declaration
};

// Safe to write from several threads; read it when the run has ended.
class RunRecord {
 public:
  void add(NodeRecord node);
  void add(Warning warning);
  void set_times(Real start, Real wall) { start_ = start, wall_ = wall; }
  void set_failure(std::string stage, std::string code, std::string message);

  // In order of declaration.
  std::vector<NodeRecord> nodes() const;
  // In order of the first declared node of each stage.
  std::vector<StageSummary> stages() const;
  // In order of declaration of the stages that gave them, those of no stage last.
  std::vector<Warning> warnings() const;
  Real start() const { return start_; }  // seconds on the process's monotone clock
  Real wall() const { return wall_; }

  // {"seconds", "cpu_seconds", "peak_memory_bytes", "stages": [{"name", "seconds", "cpu_seconds", "items", "bytes",
  // "hash", and "from_checkpoint", "shortened" where they hold}], "warnings": [{"code", "stage", "count", "message"}],
  // and "error" after a failure}; hashes are 16 hex digits.
  nlohmann::json to_json() const;

 private:
  mutable std::mutex mutex_;
  std::vector<NodeRecord> nodes_;
  std::vector<Warning> warnings_;
  Real start_ = 0, wall_ = 0;
  std::string failed_stage_, failure_code_, failure_;
};

// The largest resident size of the process so far.
std::uint64_t peak_memory_bytes();

std::string hex_text(std::uint64_t hash);

}  // namespace intarsia
