// What the public calls have in common: a flow with the caller's threads, progress and cancel flag, and errors as
// statuses.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/data/mesh.h"
#include "engine/run/node.h"
#include "engine/run/time_limit.h"
#include "graph/api/intarsia.h"
#include "graph/artefacts.h"
#include "graph/cost_model.h"
#include "graph/options.h"

namespace intarsia::call {

Status status_of(const Error& e);

// Whatever `make` throws becomes a status; a status without result comes with an empty value.
template <class T, class F>
Result<T> guarded(const F& make) noexcept {
  Result<T> result;
  try {
    try {
      make(result);
    } catch (const Error& e) {
      result.status = status_of(e);
    } catch (const std::bad_alloc&) {
      result.status = status_of(Error(ErrorCode::no_memory, "there is not enough memory"));
    } catch (const std::exception& e) {
      result.status = status_of(Error(ErrorCode::internal, std::string("internal error: ") + e.what()));
    } catch (...) {
      result.status = status_of(Error(ErrorCode::internal, "internal error of unknown kind"));
    }
  } catch (...) {  // no memory for a message
    result.status.code = StatusCode::no_memory;
  }
  if (!result.status.has_result()) result.value = T();
  return result;
}

// The caller's triangles as the engine wants them. Errors: bad_argument, rejected, too_large.
Soup soup_of(const Work& work, const TriangleMesh& mesh);

// Options of the method with what the caller gave. Errors: bad_argument.
graph::LayoutOptions layout_options(const Options& options);

// An artefact without bits: what a last stage returns that fills the caller's result.
struct Done {};
inline std::uint64_t hash_of(const Done&) { return 0; }
inline std::size_t bytes_of(const Done&) { return 0; }
inline std::size_t items_of(const Done&) { return 0; }

class Run : private ProgressListener {
 public:
  // The flow begins with the stage "read", if there is a mesh. cost: its forecast is held against max_memory.
  explicit Run(const RunControl& control, double time_limit = 0);

  Flow& flow() { return flow_; }
  RunContext& context() { return context_; }
  Port<Soup> add_read(const TriangleMesh& mesh, const graph::CostModel* cost = nullptr, std::uint64_t max_memory = 0);
  // One stage that does everything, for calls that are no flow of stages. function: of const Work&.
  template <class F>
  void add_single(const std::string& name, F function) {
    const auto body = [f = std::move(function)](const Work& work) {
      f(work);
      return Done();
    };
    add_stage(flow_, Stage<Done>{name, 1, 0, body, {}, 1});
  }
  // Errors: as Flow::wait; out_of_time; cancelled, also if the caller's progress function threw.
  void run();
  // The result is there: from now on the time limit does not stop the run.
  void stop_clock() {
    if (limit_) limit_->disarm();
  }
  bool was_shortened() const;

 private:
  void stage_begin(const ProgressEvent& e) override { tell(e); }
  void advance(const ProgressEvent& e) override { tell(e); }
  void stage_end(const ProgressEvent& e) override { tell(e); }
  void tell(const ProgressEvent& e);
  RunContext& listened();

  const RunControl& control_;
  bool listener_failed_ = false;
  RunContext context_;
  std::optional<TimeLimit> limit_;
  Flow flow_;
};

template <class T>
std::vector<std::int32_t> signed_numbers(const std::vector<T>& from) {
  return std::vector<std::int32_t>(from.begin(), from.end());  // kNone becomes -1
}

}  // namespace intarsia::call
