// Variational shape approximation by the CGAL library, for comparison: L2,1 metric, each of its seedings, then the
// given number of iterations. Prints the energy of the best labelling by our own formula and may write it as a .seg
// file.
//
//     cgal_vsa MESH K [ITERATIONS = 30] [LABELS.seg]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_approximation/L21_metric_plane_proxy.h>
#include <CGAL/Variational_shape_approximation.h>

#include "engine/io/read_mesh.h"
#include "graph/stages.h"
#include "kernels/baselines/face_graph.h"
#include "kernels/baselines/vsa.h"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using PointMap = boost::property_map<SurfaceMesh, boost::vertex_point_t>::type;
using Metric = CGAL::Surface_mesh_approximation::L21_metric_plane_proxy<SurfaceMesh, PointMap, Kernel>;
using Approximation = CGAL::Variational_shape_approximation<SurfaceMesh, PointMap, Metric, Kernel>;
namespace Vsa = CGAL::Surface_mesh_approximation;

// The soup scaled to a bounding-box diagonal of 1, as our own energies are.
SurfaceMesh surface_of(const intarsia::Soup& soup) {
  intarsia::Vec3 low = intarsia::Vec3::Constant(1e300), high = -low;
  for (const intarsia::Index v : soup.corner) {
    const intarsia::Vec3 p(soup.x[v], soup.y[v], soup.z[v]);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const double scale = 1 / (high - low).norm();
  SurfaceMesh mesh;
  for (intarsia::Index v = 0; v < soup.vertex_count(); ++v)
    mesh.add_vertex(Kernel::Point_3(soup.x[v] * scale, soup.y[v] * scale, soup.z[v] * scale));
  for (intarsia::Index f = 0; f < soup.face_count(); ++f) {
    const auto at = [&](intarsia::Index i) { return SurfaceMesh::Vertex_index(soup.corner[3 * f + i]); };
    if (mesh.add_face(at(0), at(1), at(2)) == SurfaceMesh::null_face())
      throw std::runtime_error("triangle " + std::to_string(f) + " makes the surface no oriented manifold");
  }
  return mesh;
}

// sum over regions of 2 (A - |sum A n|).
double energy_of(const SurfaceMesh& mesh, const std::vector<std::size_t>& label) {
  const std::size_t count = 1 + *std::max_element(label.begin(), label.end());
  std::vector<double> area(count, 0);
  std::vector<Kernel::Vector_3> sum(count, CGAL::NULL_VECTOR);
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h)),
               r = mesh.point(mesh.target(mesh.next(h)));
    const Kernel::Vector_3 n = CGAL::cross_product(q - p, r - p) / 2;
    area[label[f]] += std::sqrt(n.squared_length());
    sum[label[f]] = sum[label[f]] + n;
  }
  double energy = 0;
  for (std::size_t l = 0; l < count; ++l) energy += 2 * (area[l] - std::sqrt(sum[l].squared_length()));
  return energy;
}

struct Run {
  double energy, seconds;
  std::size_t proxies;
  std::vector<std::size_t> label;
};

Run run(SurfaceMesh& mesh, Vsa::Seeding_method seeding, std::size_t count, std::size_t iterations) {
  const auto start = std::chrono::steady_clock::now();
  const PointMap points = get(CGAL::vertex_point, mesh);
  const Metric metric(mesh, points);
  Approximation approximation(mesh, points, metric);
  approximation.initialize_seeds(CGAL::parameters::seeding_method(seeding).max_number_of_proxies(count));
  approximation.run(iterations);
  auto proxy = mesh.add_property_map<SurfaceMesh::Face_index, std::size_t>("f:proxy", 0).first;
  approximation.proxy_map(proxy);
  Run r;
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const auto f : mesh.faces()) r.label.push_back(proxy[f]);
  r.proxies = approximation.number_of_proxies();
  r.energy = energy_of(mesh, r.label);
  return r;
}

// iterations 0: the baseline as it is, with four starts and exchanges; else one start and so many steps.
Run run_ours(const intarsia::Soup& soup, const SurfaceMesh& mesh, std::size_t count, std::size_t iterations) {
  const intarsia::Work work;
  const intarsia::graph::Surface surface = intarsia::graph::mesh_to_surface(work, soup);
  const auto start = std::chrono::steady_clock::now();
  intarsia::kernels::VsaOptions options;
  options.patches = static_cast<intarsia::Index>(count);
  if (iterations > 0) options.starts = 1, options.iterations = static_cast<int>(iterations), options.exchange_faces = 0;
  const std::vector<intarsia::Index> label =
      intarsia::kernels::fit_planes(work, intarsia::kernels::make_face_graph(work, surface.mesh, surface.face_normal),
                                    options)
          .region;
  Run r;
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  r.label.resize(label.size());
  for (std::size_t f = 0; f < label.size(); ++f) r.label[surface.order.face[f]] = label[f];
  r.proxies = 1 + *std::max_element(r.label.begin(), r.label.end());
  r.energy = energy_of(mesh, r.label);
  return r;
}

void print(const char* name, const Run& r) {
  std::printf("%-12s %zu proxies, energy %.8f, %.2f s\n", name, r.proxies, r.energy, r.seconds);
  std::fflush(stdout);
}

int compare(int argc, char** argv) {
  const std::size_t count = std::strtoul(argv[2], nullptr, 10);
  const std::size_t iterations = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 30;
  const intarsia::Soup soup = intarsia::read_mesh(intarsia::Work(), argv[1]);
  SurfaceMesh mesh = surface_of(soup);
  const Run ours = run_ours(soup, mesh, count, 0), quick = run_ours(soup, mesh, count, iterations);
  print("ours", ours), print("one start", quick);
  const std::pair<Vsa::Seeding_method, const char*> methods[] = {{Vsa::HIERARCHICAL, "hierarchical"},
                                                                 {Vsa::INCREMENTAL, "incremental"}};
  Run best;
  best.proxies = 0;
  for (const auto& [seeding, name] : methods) {
    Run r = run(mesh, seeding, count, iterations);
    print(name, r);
    if (best.proxies == 0 || r.energy < best.energy) best = std::move(r);
  }
  std::printf("ours / best of CGAL: energy %.4f, seconds %.3f; one start: energy %.4f, seconds %.3f\n",
              ours.energy / best.energy, ours.seconds / best.seconds, quick.energy / best.energy,
              quick.seconds / best.seconds);
  if (argc > 4) {
    std::ofstream out(argv[4]);
    for (const std::size_t l : best.label) out << l << '\n';
    if (!out.flush()) throw std::runtime_error(std::string("cannot write ") + argv[4]);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_vsa MESH K [ITERATIONS = 30] [LABELS.seg]\n");
    return 2;
  }
  try {
    return compare(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cgal_vsa: %s\n", e.what());
    return 1;
  }
}
