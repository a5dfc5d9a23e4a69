#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/read_mesh.h"
#include "engine/run/context.h"
#include "graph/stages.h"
#include "kernels/surface/diagnose_soup.h"
#include "kernels/surface/self_intersections.h"
#include "tools/commands.h"
#include "tools/counted.h"
#include "tools/exit_code.h"
#include "tools/forecast.h"
#include "tools/interrupt.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

using kernels::Fault;
using kernels::SoupDiagnosis;
using nlohmann::json;

struct InfoFlags {
  std::string input;
  int threads = 0;
  bool json = false, intersections = false;
};

// What run would make of it: mended, measured; or why it would refuse.
struct Prospect {
  std::string refusal;          // empty: run takes it
  std::vector<Warning> mended;  // what the surface stage would report
  Real roughness = 0;           // degrees
  Real variation = 0;           // standard deviation / mean of the edge lengths
  bool noisy = false;
  std::uint64_t searched = 0;                         // triangles the features would be looked for on
  std::optional<kernels::SelfIntersections> meeting;  // where asked for
};

Prospect prospect_of(const Work& work, const Soup& soup) {
  Prospect p;
  p.variation = kernels::edge_variation(work, soup);
  try {
    const graph::Surface surface = graph::mesh_to_surface(work, soup);
    p.mended = graph::warnings_of(surface);
    p.roughness = surface.rough * 180 / std::numbers::pi, p.noisy = surface.noisy;
    p.searched = surface.mesh.face_count();
  } catch (const Error& e) {
    if (e.code() != ErrorCode::rejected) throw;
    p.refusal = e.what();
  }
  return p;
}

// A guess, said as one: files of these kinds have no units. Millimetres for things between a coin and a car.
const char* likely_unit(Real diagonal) { return diagonal >= 20 && diagonal < 5000 ? "mm" : "not clear"; }

struct NamedFault {
  const char *key, *text, *element;
  const Fault* fault;
};

std::vector<NamedFault> faults_of(const SoupDiagnosis& d) {
  return {{"isolated_vertices", "isolated vertices", "vertex", &d.isolated_vertices},
          {"repeated_corners", "faces with a corner twice", "face", &d.repeated_corners},
          {"zero_area", "faces without area", "face", &d.zero_area},
          {"duplicate_faces", "duplicate faces", "face", &d.duplicate_triangles},
          {"non_manifold_edges", "edges of three faces or more", "face", &d.non_manifold_edges},
          {"turned_edges", "edges whose two faces disagree in orientation", "face", &d.turned_edges},
          {"several_fans", "vertices where surfaces only touch", "vertex", &d.several_fans}};
}

json json_of(const std::string& input, const SoupDiagnosis& d, const Forecast& forecast, const Prospect& p) {
  const auto list = [](const Vec3& at) { return json{at.x(), at.y(), at.z()}; };
  json faults = json::object();
  for (const NamedFault& f : faults_of(d)) faults[f.key] = {{"count", f.fault->count}, {"first", f.fault->first}};
  json mended = json::array();
  if (p.meeting)
    faults["self_intersections"] = {
        {"count", p.meeting->triangles.count}, {"first", p.meeting->triangles.first}, {"pairs", p.meeting->pairs}};
  for (const Warning& w : p.mended) mended.push_back({{"code", w.code}, {"count", w.count}, {"message", w.message}});
  return {{"schema", "intarsia-info"},
          {"schema_version", 1},
          {"input", input},
          {"vertices", d.vertices},
          {"triangles", d.triangles},
          {"edges", d.edges},
          {"components", d.components},
          {"border_edges", d.border_edges},
          {"border_loops", d.border_loops},
          {"genus", d.genus >= 0 ? json(d.genus) : json()},
          {"surface", d.is_surface()},
          {"refusal", p.refusal.empty() ? json() : json(p.refusal)},
          {"mended", mended},
          {"roughness_degrees", p.roughness},
          {"noisy", p.noisy},
          {"edge_variation", p.variation},
          {"searched_triangles", p.searched},
          {"likely_unit", likely_unit(d.diagonal)},
          {"faults", faults},
          {"box", {{"low", list(d.low)}, {"high", list(d.high)}, {"diagonal", d.diagonal}}},
          {"area", d.area},
          {"edge_length", {{"mean", d.edge_mean}, {"least", d.edge_least}, {"most", d.edge_most}}},
          {"forecast", {{"cpu_seconds", forecast.cpu_seconds}, {"peak_memory_bytes", forecast.peak_memory}}}};
}

void print(const std::string& input, const SoupDiagnosis& d, const Forecast& forecast, const Prospect& p) {
  fmt::print("{}\n", input);
  fmt::print("  {}, {}, {}", counted(d.vertices, "vertex", "vertices"), counted(d.triangles, "triangle"),
             counted(d.components, "component"));
  if (d.border_loops > 0)
    fmt::print(", {} of {} edges", counted(d.border_loops, "boundary loop"), d.border_edges);
  else
    fmt::print(", closed");
  fmt::print("{}\n", d.genus >= 0 ? fmt::format(", genus {}", d.genus) : "");
  fmt::print("  box {:g} x {:g} x {:g}, diagonal {:g}, area {:g}; unit, a guess: {}\n", d.high.x() - d.low.x(),
             d.high.y() - d.low.y(), d.high.z() - d.low.z(), d.diagonal, d.area, likely_unit(d.diagonal));
  fmt::print("  edges {:g} on the mean ({:g} % of the diagonal), {:g} to {:g}\n", d.edge_mean,
             d.diagonal > 0 ? 100 * d.edge_mean / d.diagonal : 0, d.edge_least, d.edge_most);
  fmt::print("  edge lengths vary by {:.0f} %{}; neighbouring triangles differ by {:.1f} degrees{}\n",
             100 * p.variation,
             p.variation < 0.4 ? " (even)"
             : p.variation < 1 ? " (uneven)"
                               : " (very uneven)",
             p.roughness, p.noisy ? " (noisy)" : "");
  bool clean = true;
  for (const NamedFault& f : faults_of(d)) {
    if (f.fault->count == 0) continue;
    clean = false;
    fmt::print("  {} {}: {} {}{}\n", f.fault->count, f.text, f.element, fmt::join(f.fault->first, ", "),
               f.fault->count > f.fault->first.size() ? ", ..." : "");
  }
  if (p.meeting && p.meeting->pairs > 0) {
    const Fault& f = p.meeting->triangles;
    clean = false;
    fmt::print("  {} faces that meet others, in {} pairs: face {}{}\n", f.count, p.meeting->pairs,
               fmt::join(f.first, ", "), f.count > f.first.size() ? ", ..." : "");
  }
  if (clean) fmt::print("  no faults\n");
  if (!p.refusal.empty()) fmt::print("  run refuses it: {}\n", p.refusal);
  for (const Warning& w : p.mended) fmt::print("  run mends: {}\n", w.message);
  if (p.refusal.empty() && p.mended.empty()) fmt::print("  a surface that run takes as it is\n");
  fmt::print("  forecast of run: {:.1f} CPU seconds, {} of memory at the peak\n", forecast.cpu_seconds,
             memory_text(forecast.peak_memory));
}

int info(const InfoFlags& flags) {
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  SoupDiagnosis d;
  const Work work = context.work();
  Prospect prospect;
  context.execute([&] {
    const Soup soup = read_mesh(work, flags.input);
    d = kernels::diagnose_soup(work, soup);
    prospect = prospect_of(work, soup);
    if (flags.intersections) prospect.meeting = kernels::self_intersections(work, soup);
  });
  const Forecast forecast =
      kRunCost(std::max(d.vertices, prospect.searched / 2), std::max(d.triangles, prospect.searched));
  if (flags.json)
    fmt::print("{}\n", json_of(flags.input, d, forecast, prospect).dump(1, ' ', false, json::error_handler_t::replace));
  else
    print(flags.input, d, forecast, prospect);
  return kExitDone;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<InfoFlags>();
  CLI::App* command = app.add_subcommand("info", "what a mesh is like, what is wrong with it, what a run will cost");
  command->add_option("input", flags->input, "mesh: .ply .obj .stl .off")->required();
  command->add_flag("--self-intersections", flags->intersections,
                    "also look for triangles that cross, overlap or touch others: exact, takes longer");
  command->add_flag("--json", flags->json, "print JSON");
  add_threads_flag(*command, flags->threads);
  command->callback([flags, &exit_code] { exit_code = info(*flags); });
}

}  // namespace intarsia::tools
