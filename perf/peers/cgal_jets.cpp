// Per-vertex feature fields beside the CGAL library: our stages surface, scale and curvature (six-ring voting, scale
// selection, normal refinement, cubic fit) against jets of degree 3 over a fixed number of rings, with its own SVD
// solver and with QR. One thread, CPU seconds, same process.
//
//     cgal_jets MESH [STRIDE = 1]      STRIDE: the library fits every STRIDE-th vertex only; its times are scaled up
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <vector>

#include <CGAL/Eigen_svd.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include "engine/data/k_ring.h"
#include "engine/io/read_mesh.h"
#include "engine/run/context.h"
#include "graph/stages.h"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;

struct Qr {
  using FT = double;
  using Vector = CGAL::Eigen_vector<FT>;
  using Matrix = CGAL::Eigen_matrix<FT>;
  static FT solve(const Matrix& m, Vector& b) {
    b.eigen_object() = m.eigen_object().colPivHouseholderQr().solve(Vector::EigenType(b.eigen_object()));
    return 1;
  }
};

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Jets of every stride-th vertex over `rings` rings; the walk is ours, which is faster than one over half-edges.
template <class Solver>
double jets(const intarsia::MeshView& mesh, int rings, std::size_t stride, double& check) {
  using Fitting = CGAL::Monge_via_jet_fitting<Kernel, Kernel, Solver>;
  intarsia::RingWalker walker(mesh);
  std::vector<Kernel::Point_3> points;
  const double start = cpu_seconds();
  std::size_t fitted = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); v += stride) {
    walker.walk(static_cast<intarsia::Index>(v), rings);
    points.clear();
    const auto add = [&](intarsia::Index q) {
      const intarsia::Vec3 p = mesh.point(q);
      points.emplace_back(p.x(), p.y(), p.z());
    };
    add(static_cast<intarsia::Index>(v));
    for (const intarsia::Index q : walker.vertices(rings)) add(q);
    if (points.size() < 10) continue;
    Fitting fitting;
    const auto form = fitting(points.begin(), points.end(), 3, 3);
    check += form.principal_curvatures(0);
    ++fitted;
  }
  const double seconds = cpu_seconds() - start;
  return fitted > 0 ? seconds * static_cast<double>(mesh.vertex_count()) / static_cast<double>(fitted) : 0;
}

void print(const char* name, double seconds, double vertices, double ours) {
  std::printf("%-44s %9.3f s  %9.0f vertices/s  %6.1f\n", name, seconds, vertices / seconds, seconds / ours);
  std::fflush(stdout);
}

int compare(int argc, char** argv) {
  using namespace intarsia;
  const std::size_t stride = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
  const Soup soup = read_mesh(Work(), argv[1]);
  const graph::LayoutOptions options = graph::robust_options();
  RunSettings settings;
  settings.threads = 1;
  RunContext context(settings);
  const Work work = context.work();
  double stage[3];
  double at = cpu_seconds();
  const auto lap = [&](int i) {
    const double now = cpu_seconds();
    stage[i] = now - at;
    at = now;
  };
  graph::Surface surface;
  context.execute([&] {
    at = cpu_seconds();
    surface = graph::mesh_to_surface(work, soup);
    lap(0);
    const graph::Sharp sharp = graph::surface_to_sharp(work, surface, options);
    at = cpu_seconds();
    const graph::Scale scale = graph::surface_to_scale(work, surface, sharp, options);
    lap(1);
    const graph::Curvature curvature = graph::scale_to_curvature(work, surface, scale, sharp, options);
    lap(2);
  });
  const MeshView mesh = surface.mesh;
  const double n = static_cast<double>(mesh.vertex_count()), ours = stage[0] + stage[1] + stage[2];
  std::printf("%s: %.0f vertices; one thread, CPU seconds; last column: times ours\n", argv[1], n);
  print("ours: surface", stage[0], n, ours);
  print("ours: scale", stage[1], n, ours);
  print("ours: curvature", stage[2], n, ours);
  print("ours: all three", ours, n, ours);
  double check = 0;
  print("CGAL jets, degree 3, 3 rings, QR", jets<Qr>(mesh, 3, stride, check), n, ours);
  print("CGAL jets, degree 3, 3 rings, SVD", jets<CGAL::Eigen_svd>(mesh, 3, stride, check), n, ours);
  print("CGAL jets, degree 3, 6 rings, SVD", jets<CGAL::Eigen_svd>(mesh, 6, stride, check), n, ours);
  std::printf("(sum of curvatures, so that nothing is left out: %g)\n", check);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: cgal_jets MESH [STRIDE]\n");
    return 2;
  }
  try {
    return compare(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cgal_jets: %s\n", e.what());
    return 1;
  }
}
