#include "engine/run/flow.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

#include <tbb/flow_graph.h>

#include "engine/run/checkpoints.h"

namespace intarsia {
namespace {

using ContinueNode = tbb::flow::continue_node<tbb::flow::continue_msg>;

// Any exception as an Error that carries the stage's name.
Error as_error(const std::exception_ptr& thrown, const std::string& stage) {
  const auto with_stage = [&](Error e) {
    e.set_stage(stage);
    return e;
  };
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& e) {
    return with_stage(e);
  } catch (const std::bad_alloc&) {
    return with_stage(
        Error(ErrorCode::no_memory, "there is not enough memory; try a smaller mesh or fewer meshes at once"));
  } catch (const std::exception& e) {
    return with_stage(Error(ErrorCode::internal, std::string("internal error: ") + e.what()));
  } catch (...) {
    return with_stage(Error(ErrorCode::internal, "internal error of unknown kind"));
  }
}

// Calls `tick` at a steady pace on a thread of its own until destroyed.
class Ticker {
 public:
  explicit Ticker(std::function<void()> tick) : thread_([this, tick = std::move(tick)] { loop(tick); }) {}
  ~Ticker() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

 private:
  void loop(const std::function<void()>& tick) {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::milliseconds(kProgressIntervalMilliseconds), [&] { return done_; }))
      tick();
  }
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;  // last: starts when the rest exists
};

}  // namespace

struct Flow::Graph {
  tbb::flow::graph graph;
  std::deque<ContinueNode> node;  // addresses stay
  std::optional<Ticker> ticker;
};

Flow::Flow(RunContext& context, std::string run)
    : context_(context), run_(std::move(run)), progress_(run_, context.listeners()) {
  // A flow graph runs in the arena in which it was made.
  context_.execute([&] { graph_ = std::make_unique<Graph>(); });
}

Flow::~Flow() {
  if (state_ == State::started) {
    try {
      wait();
    } catch (const Error&) {  // whoever wanted to know has called wait()
    }
  }
  context_.execute([&] { graph_.reset(); });
}

Index Flow::add_node(NodeSpec spec) {
  const Index id = static_cast<Index>(nodes_.size());
  progress_.add(spec.stage, spec.branch, spec.weight);
  ContinueNode& node =
      graph_->node.emplace_back(graph_->graph, [this, id](const tbb::flow::continue_msg&) { execute(id); });
  for (Index before : spec.after) tbb::flow::make_edge(graph_->node[before], node);
  nodes_.push_back(std::move(spec));
  errors_.emplace_back();
  return id;
}

void Flow::fail(Index node, std::exception_ptr error) {
  errors_[node] = std::move(error);
  stop_.store(true, std::memory_order_relaxed);
}

NodeOutcome Flow::outcome_of(const Work& work, NodeRecord& entry, const std::atomic<bool>& shortened) {
  const NodeSpec& spec = nodes_[entry.node];
  if (plan_) entry.restored = plan_->begin(work, entry.node) != CheckpointPlan::Action::compute;
  if (entry.restored) {
    spec.release_inputs();
    return plan_->outcome(entry.node);
  }
  NodeOutcome outcome = spec.body(work);
  entry.shortened = shortened.load(std::memory_order_relaxed);
  if (plan_) plan_->end(work, entry.node, outcome, !entry.shortened);
  return outcome;
}

// Never throws into the flow graph, and never cancels it: that would cut short the parallel loops of other running
// nodes without telling them. They see stop_ instead.
void Flow::execute(Index node) {
  const NodeSpec& spec = nodes_[node];
  std::atomic<bool> shortened{false};
  Work work(&context_.cancel_flag(), &progress_.ticks(node), context_.order(), &stop_);
  work.watch(&context_.late_flag(), &shortened);
  if (work.cancelled()) return;
  try {
    constexpr std::uint64_t kLoopsGuess = 4;  // a stage passes over its input a few times
    progress_.begin(node, kLoopsGuess * spec.input_items());
    NodeRecord entry{spec.stage, spec.branch, node};
    entry.thread = tbb::this_task_arena::current_thread_index();
    CpuMeter::Share cpu;
    const Real begin = wall_seconds();
    context_.cpu_meter().begin(cpu);
    NodeOutcome outcome;
    std::exception_ptr thrown;
    try {
      // While this thread waits in an inner loop it must not pick up another node.
      tbb::this_task_arena::isolate([&] { outcome = outcome_of(work, entry, shortened); });
    } catch (...) {
      thrown = std::current_exception();
    }
    context_.cpu_meter().end(cpu);
    entry.start = begin - record_.start(), entry.wall = wall_seconds() - begin, entry.cpu = cpu.seconds;
    entry.items = outcome.items, entry.bytes = outcome.bytes, entry.hash = outcome.hash;
    record_.add(std::move(entry));
    if (thrown) std::rethrow_exception(thrown);
    for (Warning& w : outcome.warnings) {
      w.stage = spec.stage;
      record_.add(std::move(w));
    }
    ended_.fetch_add(1, std::memory_order_relaxed);
    progress_.end(node);
  } catch (...) {
    fail(node, std::current_exception());
  }
}

void Flow::start() {
  if (state_ != State::built) throw Error(ErrorCode::internal, "a flow runs only once");
  state_ = State::started;
  if (checkpoints_) plan_ = std::make_unique<CheckpointPlan>(*checkpoints_, nodes_, record_);
  record_.set_times(wall_seconds(), 0);
  if (progress_.has_listeners()) graph_->ticker.emplace([this] { progress_.poll(); });
  context_.execute([&] {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].after.empty()) graph_->node[i].try_put(tbb::flow::continue_msg());
  });
}

void Flow::wait() {
  if (state_ != State::started)
    throw Error(ErrorCode::internal, "a flow must be started, once, before it is waited for");
  context_.execute([&] { graph_->graph.wait_for_all(); });
  state_ = State::waited;
  graph_->ticker.reset();
  plan_.reset();
  record_.set_times(record_.start(), wall_seconds() - record_.start());
  if (ended_.load() == nodes_.size()) return;

  for (const NodeSpec& spec : nodes_) spec.drop_artefact();
  std::optional<Error> first;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!errors_[i]) continue;
    Error e = as_error(errors_[i], nodes_[i].stage);
    // A node stopped because of another's failure is not the cause.
    if (!first || (first->code() == ErrorCode::cancelled && e.code() != ErrorCode::cancelled)) first = std::move(e);
  }
  if (!first) first.emplace(ErrorCode::cancelled, "the run was cancelled");
  record_.set_failure(first->stage(), name_of(first->code()), first->what());
  throw *first;
}

}  // namespace intarsia
