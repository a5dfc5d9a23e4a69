// The files of an evaluation: rebuilt surfaces, deviation, numbers, picture.
#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "engine/io/output_folder.h"
#include "graph/evaluation_report.h"
#include "tools/picture/camera.h"
#include "tools/picture/image.h"
#include "tools/read_layout.h"

namespace intarsia::tools {

// Every file name that an evaluation may write.
std::vector<std::string> evaluation_names();

using graph::evaluation_json;

// recon-*.ply, deviation.ply (of the triangulated surface, or the first one that was made) and eval.png.
void write_evaluation(const Work& work, const OutputFolder& folder, const LayoutFromFile& layout,
                      const graph::Evaluation& evaluation, const std::optional<View>& view);

// The page of the result again, now with the distances of the surface that deviation.ply shows. earlier: the page
// there.
void write_evaluated_page(const Work& work, const std::filesystem::path& path, const std::filesystem::path& earlier,
                          const LayoutFromFile& layout, const graph::Evaluation& evaluation);

// Layout and rebuilt surfaces above, input and deviations below.
Image draw_evaluation(const Work& work, const LayoutFromFile& layout, const graph::Evaluation& evaluation,
                      const std::optional<View>& view);

}  // namespace intarsia::tools
