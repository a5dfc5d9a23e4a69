#include "graph/api/run.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/for_each.h"

namespace intarsia {
namespace call {
namespace {

RunSettings settings_of(const RunControl& control) {
  RunSettings settings;
  settings.threads = control.threads, settings.whole_process = false;
  return settings;
}

StatusCode code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_argument:
      return StatusCode::bad_argument;
    case ErrorCode::bad_file:
    case ErrorCode::rejected:
      return StatusCode::rejected;
    case ErrorCode::too_large:
      return StatusCode::too_large;
    case ErrorCode::no_memory:
      return StatusCode::no_memory;
    case ErrorCode::out_of_time:
      return StatusCode::out_of_time;
    case ErrorCode::cancelled:
      return StatusCode::cancelled;
    case ErrorCode::numeric:
    case ErrorCode::write_failed:
    case ErrorCode::internal:
      return StatusCode::internal;
  }
  return StatusCode::internal;
}

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 500'000) / 1'000'000) + " MB"; }

template <class Number>
void copy_corners(const Work& work, std::span<const Number> from, std::size_t vertices, std::vector<Index>& to) {
  to.resize(from.size());
  for_each(work, Cost::light, from.size(), [&](std::size_t i) {
    const Number v = from[i];
    to[i] = v < 0 || static_cast<std::uint64_t>(v) >= vertices ? kNone : static_cast<Index>(v);
  });
  const auto wrong = std::find(to.begin(), to.end(), kNone);
  if (wrong == to.end()) return;
  const std::size_t corner = static_cast<std::size_t>(wrong - to.begin());
  throw Error(ErrorCode::rejected,
              "triangle " + std::to_string(corner / 3) + " has vertex " + std::to_string(from[corner]) +
                  ", but vertices are numbered 0 to " + std::to_string(static_cast<std::int64_t>(vertices) - 1),
              static_cast<Index>(corner / 3));
}

}  // namespace

Status status_of(const Error& e) {
  Status status{code_of(e.code()), e.what(), e.stage()};
  if (e.element() != kNone) status.element = e.element();
  return status;
}

Soup soup_of(const Work& work, const TriangleMesh& mesh) {
  const std::size_t corners = mesh.triangles.size() + mesh.triangles64.size();
  if (!mesh.triangles.empty() && !mesh.triangles64.empty())
    throw Error(ErrorCode::bad_argument, "triangles are given twice, with 32 and with 64 bits");
  if (mesh.positions.size() % 3 != 0)
    throw Error(ErrorCode::bad_argument, "positions must be three numbers a vertex: " +
                                             std::to_string(mesh.positions.size()) + " is no multiple of three");
  if (corners % 3 != 0)
    throw Error(ErrorCode::bad_argument,
                "triangles must be three vertices each: " + std::to_string(corners) + " is no multiple of three");
  const std::size_t vertices = mesh.positions.size() / 3;
  if (vertices >= kNone || corners >= kNone)
    throw Error(ErrorCode::too_large, "at most " + std::to_string(kNone / 3) + " triangles can be numbered");
  Soup soup;
  soup.x.resize(vertices), soup.y.resize(vertices), soup.z.resize(vertices);
  for_each(work, Cost::light, vertices, [&](std::size_t v) {
    soup.x[v] = mesh.positions[3 * v], soup.y[v] = mesh.positions[3 * v + 1], soup.z[v] = mesh.positions[3 * v + 2];
  });
  if (mesh.triangles64.empty())
    copy_corners(work, mesh.triangles, vertices, soup.corner);
  else
    copy_corners(work, mesh.triangles64, vertices, soup.corner);
  return soup;
}

RunContext& Run::listened() {
  if (control_.progress || control_.cancel) context_.add_listener(*this);
  return context_;
}

Run::Run(const RunControl& control, double time_limit)
    : control_(control), context_(settings_of(control)), flow_(listened()) {
  if (!(time_limit >= 0)) throw Error(ErrorCode::bad_argument, "the time limit must be 0 (none) or more seconds");
  if (control_.cancel && control_.cancel->load(std::memory_order_relaxed)) context_.cancel();
  if (time_limit > 0) limit_.emplace(context_, time_limit);
}

Port<Soup> Run::add_read(const TriangleMesh& mesh, const graph::CostModel* cost, std::uint64_t max_memory) {
  const auto read = [mesh, cost, max_memory](const Work& work) {
    const std::uint64_t triangles = (mesh.triangles.size() + mesh.triangles64.size()) / 3;
    const std::uint64_t needed = cost ? (*cost)(mesh.positions.size() / 3, triangles).peak_memory : 0;
    if (max_memory > 0 && needed > max_memory)
      throw Error(ErrorCode::no_memory, "this mesh needs about " + megabytes(needed) + ", more than the " +
                                            megabytes(max_memory) + " that were allowed; nothing was begun");
    return soup_of(work, mesh);
  };
  return add_stage(flow_, Stage<Soup>{"read", 1, 0, read, {}, 0.1});
}

void Run::tell(const ProgressEvent& e) {
  bool go_on = !(control_.cancel && control_.cancel->load(std::memory_order_relaxed));
  if (go_on && control_.progress && !listener_failed_) {
    try {
      go_on = control_.progress(e.stage, std::clamp(e.overall, 0.0, 1.0));
    } catch (...) {
      listener_failed_ = true, go_on = false;
    }
  }
  if (!go_on) context_.cancel();
}

void Run::run() {
  try {
    flow_.run();
  } catch (const Error& e) {
    if (e.code() != ErrorCode::cancelled) throw;
    if (limit_ && limit_->has_expired())
      throw Error(ErrorCode::out_of_time, "no result within the time limit; allow more time, or simplify the mesh");
    if (listener_failed_) throw Error(ErrorCode::cancelled, "the progress function threw; the call was cancelled");
    throw Error(ErrorCode::cancelled, "the call was cancelled");
  }
}

bool Run::was_shortened() const {
  const auto stages = flow_.record().stages();
  return std::any_of(stages.begin(), stages.end(), [](const StageSummary& s) { return s.shortened; });
}

}  // namespace call

inline namespace api {

#define INTARSIA_TEXT_OF(x) #x
#define INTARSIA_TEXT(x) INTARSIA_TEXT_OF(x)

constexpr std::string_view kHeaderVersion = INTARSIA_TEXT(INTARSIA_VERSION_MAJOR) "." INTARSIA_TEXT(
    INTARSIA_VERSION_MINOR) "." INTARSIA_TEXT(INTARSIA_VERSION_PATCH);
static_assert(kHeaderVersion == INTARSIA_VERSION, "the header's version is not that of CMakeLists.txt");

const char* version() noexcept { return INTARSIA_VERSION; }

int Status::exit_status() const noexcept {
  switch (code) {
    case StatusCode::ok:
      return 0;
    case StatusCode::degraded:
      return 5;
    case StatusCode::bad_argument:
      return 2;
    case StatusCode::rejected:
      return 4;
    case StatusCode::shortened:
    case StatusCode::too_large:
    case StatusCode::no_memory:
    case StatusCode::out_of_time:
      return 6;
    case StatusCode::cancelled:
      return 130;
    case StatusCode::internal:
      return 1;
  }
  return 1;
}

}  // namespace api
}  // namespace intarsia
