// The task graph of one run: nodes start when the nodes they come after have ended, side by side where they can.
// Stages are added through node.h; this file owns what is the same for all of them.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "engine/parallel/work.h"
#include "engine/run/context.h"
#include "engine/run/node_spec.h"
#include "engine/run/record.h"

namespace intarsia {

class CheckpointPlan;
class Checkpoints;

// Built, run once, asked for its artefacts and its record. Several flows may run at once in one context.
// Cancel, or an error in one node, stops the others at their next poll; nothing half-made is published.
class Flow {
 public:
  explicit Flow(RunContext& context, std::string run = {});
  ~Flow();  // waits for a started run
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  // Requires: not started; ids in `after` were returned before. Returns the node's id.
  Index add_node(NodeSpec spec);
  // Stages are resumed from there and stored there. Requires: not started; `checkpoints` outlives the flow.
  void use(const Checkpoints& checkpoints) { checkpoints_ = &checkpoints; }

  // start() returns at once; wait() returns when every node has ended.
  // Errors of wait: that of the first node in order of declaration that failed, with the stage's name (foreign
  // exceptions as no_memory or internal); cancelled if the context was cancelled before the last node had ended.
  void start();
  void wait();
  void run() { start(), wait(); }

  const std::string& run_name() const { return run_; }
  RunContext& context() { return context_; }
  Progress& progress() { return progress_; }
  RunRecord& record() { return record_; }  // complete after wait(), also if that throws
  const RunRecord& record() const { return record_; }

 private:
  struct Graph;  // keeps the flow-graph header out of everybody else's
  void execute(Index node);
  NodeOutcome outcome_of(const Work& work, NodeRecord& entry, const std::atomic<bool>& shortened);
  void fail(Index node, std::exception_ptr error);

  RunContext& context_;
  std::string run_;
  Progress progress_;
  RunRecord record_;
  const Checkpoints* checkpoints_ = nullptr;
  std::unique_ptr<CheckpointPlan> plan_;  // while it runs, if there are checkpoints
  std::unique_ptr<Graph> graph_;
  std::vector<NodeSpec> nodes_;
  std::vector<std::exception_ptr> errors_;  // per node; each written by its own node only
  std::atomic<bool> stop_{false};
  std::atomic<std::size_t> ended_{0};
  enum class State : std::uint8_t { built, started, waited };
  State state_ = State::built;
};

}  // namespace intarsia
