// A model in OpenCASCADE: built, checked, triangulated, written. The only door to that library; none of its types pass.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/mesh.h"
#include "tools/step/cad_model.h"

namespace intarsia::tools {

struct CadCheck {
  bool valid = false;               // all that BRepCheck_Analyzer looks at
  std::vector<Index> invalid_face;  // positions in the model's faces
  std::string trouble;              // names of what it found, each once
  Index faces = 0, edges = 0, vertices = 0, shells = 0, solids = 0;
  Index free_edges = 0;        // with one face only, and a length
  Index degenerate_edges = 0;  // points that are edges: readers fill gaps in a face's border with such
  Real area = 0, volume = 0;   // volume of the solids
  Real largest_tolerance = 0;
};

struct CadTriangles {
  std::vector<Real> x, y, z;
  std::vector<Index> corner;  // 3 per triangle
  std::vector<Index> face;    // per triangle: position in the model's faces
  std::vector<Index> empty;   // faces that could not be triangulated
};

enum class CadUnit { millimetre, centimetre, metre, inch };

// Lengths are millimetres, as everywhere in that library.
class CadShape {
 public:
  // Positions become centre + scale * position, parameters and tolerances scale * theirs. Faces that share edges make
  // a shell, closed shells a solid; shells that are turned inwards are walls of cavities of the solid around them.
  CadShape(const CadModel& model, const Vec3& centre, Real scale);
  // By the library's own reader, with its repairs. Errors: bad_file.
  static CadShape read_step(const std::filesystem::path& path);
  static CadShape read_step_text(const std::string& text);
  ~CadShape();
  CadShape(CadShape&&) noexcept;
  CadShape& operator=(CadShape&&) noexcept;

  CadCheck check() const;
  // No edge of a triangle is farther than about `deflection` from the face or edge it stands for.
  CadTriangles triangulate(Real deflection) const;
  // The text of a STEP file (AP214) with lengths in that unit. No date: the time stamp is always the same. Not
  // thread-safe (the library's settings are global). Errors: internal.
  std::string step_text(const std::string& name, CadUnit unit, const std::string& version) const;

 private:
  struct Impl;
  CadShape();
  std::unique_ptr<Impl> impl_;
};

}  // namespace intarsia::tools
