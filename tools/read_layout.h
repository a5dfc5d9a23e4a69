// Layouts from files, for judging them: what `intarsia run` wrote, or any mesh with a label per face.
#pragma once

#include <filesystem>
#include <string>

#include "graph/given_layout.h"

namespace intarsia::tools {

using LayoutFromFile = graph::GivenLayout;

// True if the folder holds the files of a result: patches.ply, layout.ply, network.json.
bool is_result_folder(const std::filesystem::path& folder);

// Mesh and arcs as they were written. Errors: bad_file naming the file; rejected.
LayoutFromFile read_result_folder(const Work& work, const std::filesystem::path& folder);

struct LabelledMesh {
  std::filesystem::path mesh, labels;  // labels: .seg or .ply; empty: face property of the mesh file
  std::string property = "patch";
  bool smooth = false;  // borders smoothed as in a run; false: mesh edges as they come
};

// Every connected piece of equal labels is a patch.
// Errors: bad_file naming the file; rejected if the mesh is no surface.
LayoutFromFile read_labelled_mesh(const Work& work, const LabelledMesh& input);

}  // namespace intarsia::tools
