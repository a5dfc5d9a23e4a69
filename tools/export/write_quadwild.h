// quadwild/layout.obj and what QuadWild (Pietroni et al. 2021) reads beside a mesh of that name.
#pragma once

#include <functional>

#include "tools/export/handover.h"

namespace intarsia::tools {

// All numbers count from 0 and are those of layout.obj, which has the vertices and faces of layout.ply. An edge is a
// face and the number of its first corner there.
//   .sharp      count, then kind,face,edge: ridges, valleys and sharp edges; kind 0 concave, 1 convex
//   .feature    count, then face,edge: the same edges
//   .c_feature  count, then vertex: where other than two of them meet
//   .patch      count, then the patch of each face
//   .corners    count, then for each patch the number of its corners and these, in the order of its border: nodes where
//               the border turns by more than 30 degrees, or all its nodes if less than three do
// Errors of all: write_failed naming the file; cancelled.
std::vector<std::string> quadwild_names();
// path_of: name -> where to write.
void write_quadwild(const Work& work, const Handover& handover,
                    const std::function<std::filesystem::path(const std::string&)>& path_of);

}  // namespace intarsia::tools
