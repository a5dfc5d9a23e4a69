// From a Stage to a node of a Flow, with typed arrows between them.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <typeinfo>
#include <utility>

#include "engine/base/hash.h"
#include "engine/run/flow.h"
#include "engine/run/stage.h"

namespace intarsia {

// Where an artefact waits for those that use it. The last stage to use it frees it.
template <class T>
class Slot {
 public:
  void add_user() { users_.fetch_add(1, std::memory_order_relaxed); }
  void publish(T&& value) { value_ = std::make_shared<const T>(std::move(value)); }
  const T& get() const { return *value_; }
  const std::shared_ptr<const T>& share() const { return value_; }
  void release() {
    if (users_.fetch_sub(1, std::memory_order_acq_rel) == 1) value_.reset();
  }
  void drop() { value_.reset(); }
  bool is_there() const { return value_ != nullptr; }
  void keep() {
    add_user();
    kept_ = true;
  }
  bool is_kept() const { return kept_; }

 private:
  std::shared_ptr<const T> value_;
  bool kept_ = false;  // set before the run
  std::atomic<int> users_{0};
};

// The output of a stage, to be given to later stages of the same flow or kept for after the run.
template <class T>
struct Port {
  std::shared_ptr<Slot<T>> slot;
  Index node = kNone;
};

// The artefact outlives its last consumer, until the flow and all ports are gone. An artefact that no stage takes is
// always kept. Call before the run.
template <class T>
void keep(const Port<T>& port) {
  port.slot->keep();
}

// After the run: the artefact of a port that was kept or has no consumers; null after a failed run.
template <class T>
std::shared_ptr<const T> fetch(const Port<T>& port) {
  return port.slot->share();
}

// Artefacts that can be kept from one run to the next offer, found by argument-dependent lookup:
//   void write_to(ArtefactWriter&, const T&);   every field that anybody reads
//   void read_from(ArtefactReader&, T&);
// and those that a flow begins with std::uint64_t exact_hash_of(const T&), of their bits.
template <class T>
concept HasCheckpoint = requires(ArtefactWriter& to, ArtefactReader& from, T& out) {
  write_to(to, std::as_const(out));
  read_from(from, out);
};

// A node that runs the stage once all its inputs are there. The output is hashed and measured, shared with the
// consumers as const, and freed after the last of them. A stage without inputs starts with the run.
template <class Out, class... In>
Port<Out> add_stage(Flow& flow, Stage<Out, In...> stage, const std::type_identity_t<Port<In>>&... inputs) {
  auto slot = std::make_shared<Slot<Out>>();
  (inputs.slot->add_user(), ...);

  NodeSpec spec;
  spec.stage = stage.name, spec.branch = stage.branch, spec.weight = stage.weight;
  spec.after = {inputs.node...};
  spec.input_items = [... in = inputs.slot] {
    return std::max({std::uint64_t{0}, (in->is_there() ? static_cast<std::uint64_t>(items_of(in->get())) : 0)...});
  };
  spec.body = [slot, function = std::move(stage.function), ... in = inputs.slot](const Work& work) {
    Out out = function(work, in->get()...);
    work.check();  // never publish what a cancelled loop may have left half-made
    (in->release(), ...);
    NodeOutcome outcome{items_of(out), bytes_of(out), hash_of(out), {}};
    if constexpr (requires { warnings_of(out); }) outcome.warnings = warnings_of(out);
    slot->publish(std::move(out));
    return outcome;
  };
  spec.drop_artefact = [slot] { slot->drop(); };
  spec.is_kept = [slot] { return slot->is_kept(); };
  if constexpr (HasCheckpoint<Out>) {
    if (stage.is_pure) {
      Hash recipe;
      recipe.add(std::string_view(spec.stage)), recipe.add(std::string_view(spec.branch)), recipe.add(stage.revision);
      recipe.add(stage.options_hash), recipe.add(std::string_view(typeid(Out).name()));
      recipe.add(flow.context().order());
      spec.recipe = recipe.value();
    }
    spec.release_inputs = [... in = inputs.slot] { (in->release(), ...); };
    spec.store = [slot](ArtefactWriter& to) { write_to(to, slot->get()); };
    spec.restore = [slot](ArtefactReader& from) {
      Out out;
      read_from(from, out);
      slot->publish(std::move(out));
    };
  } else if constexpr (sizeof...(In) == 0 && requires(const Out& out) { exact_hash_of(out); }) {
    spec.content = [slot] { return exact_hash_of(slot->get()); };
  }
  return {slot, flow.add_node(std::move(spec))};
}

}  // namespace intarsia
