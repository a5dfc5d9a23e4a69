#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/write_ply.h"
#include "graph/input_numbers.h"
#include "graph/layout_graph.h"
#include "tools/commands.h"
#include "tools/config_file.h"
#include "tools/exit_code.h"
#include "tools/features_picture.h"
#include "tools/picture/png_file.h"
#include "tools/stage_command.h"
#include "tools/usual_flags.h"
#include "tools/view_flag.h"
#include "tools/write_result.h"

namespace intarsia::tools {
namespace {

struct FeaturesFlags {
  std::string input, output, picture;
  std::vector<Index> vertices;
  std::vector<double> view;
  CommonFlags common;
  OptionFlags method;
};

// The fields in the input's numbering and units. Vertices that no face uses are invalid, their fields zero.
Written write_fields(const Work& work, const std::filesystem::path& path, const Soup& soup,
                     const graph::Surface& surface, const graph::Scale& scale, const graph::Curvature& curvature) {
  const std::vector<Index> mesh_vertex = graph::surface_vertices(work, soup, surface);
  const CurvatureFields& k = curvature.fields;
  const Real one = 1, per_length = 1 / surface.box.diagonal, per_area = per_length * per_length;
  const auto real = [&](const std::vector<Real>& values, Real unit) {
    return [&mesh_vertex, data = values.data(), unit](std::size_t v) {
      return mesh_vertex[v] == kNone ? 0.0 : unit * data[mesh_vertex[v]];
    };
  };
  PlyFile ply;
  ply.comment("intarsia features: curvature is positive where the surface is convex, in the units of the input");
  auto& vertex = ply.element("vertex", soup.vertex_count());
  vertex.xyz<double>(soup.x, soup.y, soup.z);
  vertex.column<double>("nx", real(k.normal.x, one)).column<double>("ny", real(k.normal.y, one));
  vertex.column<double>("nz", real(k.normal.z, one));
  for (std::size_t i = 0; i < scale.fields.omega.size(); ++i)
    vertex.column<double>("omega_" + std::to_string(i + 1), real(scale.fields.omega[i], one));
  vertex.column<double>("kmax", real(k.kmax, per_length)).column<double>("kmin", real(k.kmin, per_length));
  vertex.column<double>("tmax_x", real(k.tmax.x, one)).column<double>("tmax_y", real(k.tmax.y, one));
  vertex.column<double>("tmax_z", real(k.tmax.z, one)).column<double>("tmin_x", real(k.tmin.x, one));
  vertex.column<double>("tmin_y", real(k.tmin.y, one)).column<double>("tmin_z", real(k.tmin.z, one));
  vertex.column<double>("emax", real(k.emax, per_area)).column<double>("emin", real(k.emin, per_area));
  const auto number = [&](const auto& values, int missing) {
    return [&mesh_vertex, data = values.data(), missing](std::size_t v) {
      return mesh_vertex[v] == kNone ? missing : static_cast<int>(data[mesh_vertex[v]]);
    };
  };
  vertex.column<std::int32_t>("scale", number(scale.fields.scale, 0));
  vertex.column<std::int32_t>("fit_ring", number(k.ring, 0));
  vertex.column<std::int32_t>("status", number(k.status, static_cast<int>(FitStatus::invalid)));
  auto& face = ply.element("face", soup.face_count());
  face.triangles(soup.corner);
  if (!soup.source_face.empty()) face.column<std::int32_t>("source_face", soup.source_face);
  write_ply(work, path, ply);
  return {1, std::filesystem::file_size(path)};
}

int features(const FeaturesFlags& flags, const CLI::App& app) {
  graph::LayoutOptions options = flags.method.options(flags.common);
  if (flags.common.print_config) {
    fmt::print("{}", config_text(app, flags.method, options));
    return kExitDone;
  }
  options.scale.keep_variation = true;
  StageCommand command("features", flags.input, flags.common);
  const graph::FeaturePorts ports = graph::add_feature_stages(command.flow(), command.soup(), options);
  const auto write = [&flags](const Work& work, const Soup& s, const graph::Surface& surface, const graph::Scale& scale,
                              const graph::Curvature& curvature) {
    if (!flags.picture.empty())
      write_png(flags.picture, draw_scales(work, surface, scale, flags.vertices, chosen_view(flags.view)));
    return write_fields(work, flags.output, s, surface, scale, curvature);
  };
  using WriteStage = Stage<Written, Soup, graph::Surface, graph::Scale, graph::Curvature>;
  add_stage(command.flow(), WriteStage{"write", 1, 0, write, {}, 0.5}, command.soup(), ports.surface, ports.scale,
            ports.curvature);
  command.write_records(command.run(flags.method.to_json(options)));
  if (!flags.common.quiet) fmt::print("written to {}\n", flags.output);
  return kExitDone;
}

}  // namespace

void add_features_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<FeaturesFlags>();
  CLI::App* command = app.add_subcommand("features", "per-vertex fields: surface variation, curvature, extremality");
  command->add_option("input", flags->input, "mesh: .ply .obj .stl .off")->required();
  command->add_option("-o,--output", flags->output, "fields as a binary PLY file")
      ->required()
      ->check(file_ending(".ply"));
  command->add_option("--picture", flags->picture, "also draw the chosen rings into this PNG file")
      ->check(file_ending(".png"));
  command->add_option("--vertices", flags->vertices, "vertices to mark there, with A, B, C ...")->delimiter(',');
  add_view_flag(*command, flags->view);
  add_common_flags(*command, flags->common);
  add_checkpoint_flag(*command, flags->common);
  flags->method.add_to(*command);
  command->callback([flags, command, &exit_code] {
    apply_config(*command, flags->common.config);
    exit_code = features(*flags, *command);
  });
}

}  // namespace intarsia::tools
