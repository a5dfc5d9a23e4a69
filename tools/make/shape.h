// Sample surfaces of any size: scan-like triangle meshes of shapes in closed form, with what is known about them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"
#include "tools/make/mesh_source.h"

namespace intarsia::tools {

struct ShapeParameter {
  std::string name, help;
  Real value = 0;            // default
  Real least = 0, most = 0;  // allowed range, both included
};

struct ShapeInfo {
  std::string name, help;
  std::vector<ShapeParameter> parameters;
  int euler = 2;           // Euler characteristic of the surface
  int boundary_loops = 0;  // 0: closed
  bool has_truth = false;  // true_features() gives curves or corners
};

// Every shape, in the order of the help text.
const std::vector<ShapeInfo>& shapes();

// Errors: bad_argument if there is no such shape; the message lists the names.
const ShapeInfo& shape_info(const std::string& name);

struct MakeOptions {
  std::string shape = "part";
  std::uint64_t triangles = 100'000;  // wanted; met within 3 % (small meshes: within the steps of a grid)
  Real irregularity = 0;              // 0 even .. 1: random steps along the surface, in half distances to the nearest
                                      // neighbour; vertices stay on the surface
  Real noise_diagonal = 0;            // Gaussian noise along the normal: standard deviation / diagonal of the shape
  Real noise_edges = 0;               // the same in mean edge lengths (within 2 %); the two add as independent noise
  std::uint64_t seed = 1;             // of the sampling, the irregularity and the noise
  bool double_coordinates = false;    // files: 8 bytes a coordinate, not 4
  std::map<std::string, Real> parameters;  // of the shape, by name; missing ones take their defaults
};

// Checks the options; one place for the command line and the library.
// Errors: bad_argument (unknown shape or parameter, value out of range), too_large (more than 2^31 - 1 vertices).
void check(const MakeOptions& options);

// The mesh as pieces that can be made in any order.
std::unique_ptr<MeshSource> plan_shape(const Work& work, const MakeOptions& options);

// In memory. Ensures: oriented outward (open shapes: see their help), manifold, no triangle without area; the same bits
// for any number of threads.
Soup make_shape(const Work& work, const MakeOptions& options);

// Binary little-endian PLY, the same vertices and triangles in the same order, written piece by piece under a temporary
// name in the same folder and renamed at the end. Memory: about 15 bytes per triangle.
// Errors: as make_shape, and write_failed; nothing is left behind then.
void make_to_file(const Work& work, const MakeOptions& options, const std::filesystem::path& path);

// Distance from a point to the exact shape, to first order (exact in the limit of small distances; open shapes: to the
// surface continued over its border). Bound to one set of options, callable from many threads.
class ShapeDistance {
 public:
  explicit ShapeDistance(const MakeOptions& options);
  ~ShapeDistance();
  Real operator()(const Vec3& p) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace intarsia::tools
