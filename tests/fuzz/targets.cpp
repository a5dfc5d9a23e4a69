#include "tests/fuzz/targets.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "graph/stages.h"
#include "kernels/surface/check_soup.h"
#include "kernels/surface/diagnose_soup.h"
#include "tests/fuzz/seeds.h"

namespace intarsia::fuzz {
namespace {

void expect(bool good, const char* promise) {
  if (!good) throw std::logic_error(promise);
}

// Runs f; of errors, only those that name a cause and a cure are allowed.
template <class F>
bool refuses(const F& f) {
  try {
    f();
    return false;
  } catch (const Error& e) {
    const bool clean = e.code() == ErrorCode::bad_file || e.code() == ErrorCode::too_large ||
                       e.code() == ErrorCode::rejected || e.code() == ErrorCode::numeric;
    if (!clean) throw std::logic_error(std::string("refused as ") + name_of(e.code()) + ": " + e.what());
    expect(std::string_view(e.what()).size() > 10, "an error without a message");
    return true;
  }
}

void check_soup_of(const Soup& soup, std::size_t file_bytes) {
  expect(!soup.corner.empty() && soup.corner.size() % 3 == 0, "no triangles, or parts of them");
  expect(soup.y.size() == soup.x.size() && soup.z.size() == soup.x.size(), "coordinates of different number");
  for (const Index v : soup.corner) expect(v < soup.x.size(), "a corner out of range");
  for (const auto* a : {&soup.x, &soup.y, &soup.z})
    for (const Real value : *a) expect(std::isfinite(value), "a coordinate that is not finite");
  expect(soup.source_face.empty() || soup.source_face.size() == soup.face_count(), "source_face of another length");
  expect(std::is_sorted(soup.source_face.begin(), soup.source_face.end()), "source_face not ascending");
  const std::size_t bytes = 24 * soup.x.capacity() + 4 * (soup.corner.capacity() + soup.source_face.capacity());
  expect(bytes <= 4096 + 64 * file_bytes, "more memory than the file explains");
}

void fuzz_mesh(const char* name, std::string_view bytes) {
  Soup soup;
  if (!refuses([&] { soup = read_mesh(Work{}, name, bytes); })) check_soup_of(soup, bytes.size());
}

void fuzz_labels(std::string_view bytes) {
  std::vector<int> label;
  refuses([&] { label = read_face_labels(Work{}, "labels", bytes, "patch"); });
  expect(label.capacity() * sizeof(int) <= 4096 + 8 * bytes.size(), "more memory than the file explains");
}

// Any small soup: one byte a coordinate (a coarse grid, so that vertices meet), one byte a corner.
Soup soup_of(std::string_view bytes) {
  Soup soup;
  if (bytes.empty()) return soup;
  const std::size_t vertices = 1 + static_cast<unsigned char>(bytes[0]) % 40;
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  std::size_t at = 1;
  for (std::size_t v = 0; v < vertices; ++v)
    for (auto* a : {&soup.x, &soup.y, &soup.z}) {
      const unsigned code = byte(at++);
      a->push_back(code < 250 ? code % 16 : code == 250 ? 1e-9 : code == 251 ? 1e12 : code == 252 ? -0.0 : 7.0);
    }
  for (; at + 3 <= bytes.size(); at += 3)
    for (std::size_t i = 0; i < 3; ++i) soup.corner.push_back(static_cast<Index>(byte(at + i) % vertices));
  return soup;
}

void fuzz_surface(std::string_view bytes) {
  const Soup soup = soup_of(bytes);
  if (soup.corner.empty()) return;
  kernels::diagnose_soup(Work{}, soup);
  const bool is_surface = !refuses([&] { kernels::check_soup(Work{}, soup); });
  graph::Surface surface;
  const bool refused = refuses([&] { surface = graph::mesh_to_surface(Work{}, soup, {}); });
  graph::LayoutOptions strict;
  strict.clean.strict = true;
  expect(refuses([&] { graph::mesh_to_surface(Work{}, soup, strict); }) == !is_surface, "strict is not check_soup");
  if (refused) return;
  const Mesh& mesh = surface.mesh;
  const Vec3Array& normal = surface.face_normal;
  Soup cleaned{mesh.x, mesh.y, mesh.z, mesh.corner, {}};
  expect(!refuses([&] { kernels::check_soup(Work{}, cleaned); }), "cleaned, and still no surface");
  expect(std::isfinite(surface.area) && std::isfinite(surface.mean_edge), "measures that are not finite");
  for (const auto* a : {&mesh.x, &mesh.y, &mesh.z, &normal.x, &normal.y, &normal.z})
    for (const Real value : *a) expect(std::isfinite(value), "a number that is not finite");
  expect(surface.order.vertex.size() == mesh.x.size() && surface.order.face.size() == mesh.face_count(),
         "maps of another length");
  for (const Index v : surface.order.vertex) expect(v < soup.x.size() || v == kNone, "a vertex from nowhere");
  for (const Index f : surface.order.face) expect(f < soup.face_count(), "a face from nowhere");
}

constexpr Target kTargets[] = {
    {"ply", [](std::string_view b) { fuzz_mesh("mesh.ply", b); }, ply_seeds},
    {"stl", [](std::string_view b) { fuzz_mesh("mesh.stl", b); }, stl_seeds},
    {"obj", [](std::string_view b) { fuzz_mesh("mesh.obj", b); }, obj_seeds},
    {"off", [](std::string_view b) { fuzz_mesh("mesh.off", b); }, off_seeds},
    {"labels", fuzz_labels, label_seeds},
    {"surface", fuzz_surface, surface_seeds},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }

const Target& target(std::string_view name) {
  for (const Target& t : kTargets)
    if (t.name == name) return t;
  throw std::invalid_argument("no such target");
}

}  // namespace intarsia::fuzz
