#include <chrono>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/io/output_folder.h"
#include "engine/io/read_labels.h"
#include "engine/io/read_mesh.h"
#include "engine/io/write_file.h"
#include "engine/io/write_ply.h"
#include "engine/parallel/for_each.h"
#include "engine/run/context.h"
#include "kernels/quality/surface_distance.h"
#include "kernels/surface/normalise_box.h"
#include "tools/commands.h"
#include "tools/deviation.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/picture/best_view.h"
#include "tools/picture/png_file.h"
#include "tools/report.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

using nlohmann::json;

struct DistanceFlags {
  std::string a, b, output, save_samples;
  std::uint64_t samples = kernels::DistanceOptions{}.samples;
  int threads = 0;
  bool json = false, patches = false, quiet = false;
};

struct Input {
  Soup soup;
  Vec3Array unit;  // in A's normalised frame

  TrianglesView triangles() const { return {unit, soup.corner}; }
};

struct Measured {
  Input a, b;
  kernels::BoxTransform box;  // of A
  kernels::SurfaceDistance distance;
  std::vector<Index> label;     // per triangle of A; empty unless asked for
  std::vector<int> label_name;  // label -> as in the file
  std::vector<kernels::PartDistance> part;
  double seconds = 0;  // without reading and writing
};

Vec3Array in_frame(const Work& work, const Soup& soup, const kernels::BoxTransform& box) {
  Vec3Array unit(soup.vertex_count());
  for_each(work, Cost::light, unit.size(), [&](std::size_t v) {
    unit.set(v, box.to_unit({soup.x[v], soup.y[v], soup.z[v]}));
  });
  return unit;
}

Measured measure(const Work& work, const DistanceFlags& flags) {
  Measured m;
  m.a.soup = read_mesh(work, flags.a), m.b.soup = read_mesh(work, flags.b);
  if (flags.patches) {
    const std::vector<int> label = labels_of_triangles(flags.a, read_face_labels(work, flags.a, "patch"),
                                                       m.a.soup.source_face, m.a.soup.face_count());
    const Index count = number_labels(label, m.label);
    m.label_name.resize(count);
    for (std::size_t f = 0; f < label.size(); ++f) m.label_name[m.label[f]] = label[f];
  }
  const auto start = std::chrono::steady_clock::now();
  m.box = kernels::normalise_box(work, m.a.soup);
  m.a.unit = in_frame(work, m.a.soup, m.box), m.b.unit = in_frame(work, m.b.soup, m.box);
  kernels::DistanceOptions options;
  options.samples = flags.samples;
  options.per_sample = !flags.save_samples.empty();
  m.distance = kernels::surface_distance(work, m.a.triangles(), m.b.triangles(), options);
  if (flags.patches) m.part = kernels::distance_per_label(m.distance, m.label, static_cast<Index>(m.label_name.size()));
  m.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return m;
}

json numbers(Real max, Real mean, Real rms, Real unit) {
  return {{"hausdorff", unit * max}, {"mean", unit * mean}, {"rms", unit * rms}};
}

json side_json(const kernels::OneSided& side, const kernels::BoxTransform& box) {
  const Vec3 worst = box.to_input(side.worst);
  json row = {{"max", side.max * box.diagonal},
              {"bound", side.bound * box.diagonal},
              {"mean", side.mean * box.diagonal},
              {"rms", side.rms * box.diagonal},
              {"area", side.area * box.diagonal * box.diagonal},
              {"samples", side.samples},
              {"worst", {worst.x(), worst.y(), worst.z()}}};
  row["relative"] = {{"max", side.max}, {"bound", side.bound}, {"mean", side.mean}, {"rms", side.rms}};
  return row;
}

json report_of(const DistanceFlags& flags, const Measured& m) {
  json report = {{"schema", "intarsia-distance"}, {"schema_version", 1}};
  report.update(version_json());
  const auto input = [](const std::string& path, const Soup& soup) {
    return json{{"path", path}, {"vertices", soup.vertex_count()}, {"triangles", soup.face_count()}};
  };
  report["a"] = input(flags.a, m.a.soup), report["b"] = input(flags.b, m.b.soup);
  report["diagonal"] = m.box.diagonal;
  const kernels::SurfaceDistance& d = m.distance;
  report.update(numbers(d.hausdorff(), d.mean(), d.rms(), m.box.diagonal));
  report["relative"] = numbers(d.hausdorff(), d.mean(), d.rms(), 1);
  report["forward"] = side_json(d.forward, m.box), report["backward"] = side_json(d.backward, m.box);
  if (flags.patches) {
    json rows = json::array();
    const Real unit = m.box.diagonal;
    for (std::size_t p = 0; p < m.part.size(); ++p)
      rows.push_back({{"patch", m.label_name[p]},
                      {"area", m.part[p].area * unit * unit},
                      {"max", m.part[p].max * unit},
                      {"mean", m.part[p].mean * unit},
                      {"rms", m.part[p].rms * unit}});
    report["patches"] = std::move(rows);
  }
  report["seconds"] = m.seconds;
  return report;
}

void print_text(const DistanceFlags& flags, const Measured& m) {
  const Real unit = m.box.diagonal;
  fmt::print("{:<10}{:>14}{:>14}{:>14}{:>12}{:>12}{:>12}{:>10}\n", "", "largest", "mean", "RMS", "largest %", "mean %",
             "RMS %", "samples");
  const auto row = [&](const char* name, Real max, Real mean, Real rms, std::uint64_t samples) {
    fmt::print("{:<10}{:>14.6g}{:>14.6g}{:>14.6g}{:>12.4g}{:>12.4g}{:>12.4g}", name, unit * max, unit * mean,
               unit * rms, 100 * max, 100 * mean, 100 * rms);
    fmt::print("{:>10}\n", samples > 0 ? std::to_string(samples) : "");
  };
  const kernels::SurfaceDistance& d = m.distance;
  row("A to B", d.forward.max, d.forward.mean, d.forward.rms, d.forward.samples);
  row("B to A", d.backward.max, d.backward.mean, d.backward.rms, d.backward.samples);
  row("larger", d.hausdorff(), d.mean(), d.rms(), 0);
  const Real bound = std::max(d.forward.bound, d.backward.bound);
  fmt::print("% of A's bounding-box diagonal, {:.6g}. No point is farther than {:.6g} ({:.4g} %). {:.2f} s\n", unit,
             unit * bound, 100 * bound, m.seconds);
  if (!flags.patches) return;
  fmt::print("\n{:>8}{:>14}{:>14}{:>14}{:>14}{:>12}\n", "patch", "area", "largest", "mean", "RMS", "RMS %");
  for (std::size_t p = 0; p < m.part.size(); ++p)
    fmt::print("{:>8}{:>14.6g}{:>14.6g}{:>14.6g}{:>14.6g}{:>12.4g}\n", m.label_name[p], m.part[p].area * unit * unit,
               unit * m.part[p].max, unit * m.part[p].mean, unit * m.part[p].rms, 100 * m.part[p].rms);
}

void write_samples(const Work& work, const std::filesystem::path& path, const kernels::DistanceSamples& samples,
                   const kernels::BoxTransform& box, bool csv) {
  const auto position = [&](std::size_t i) { return box.to_input(samples.point[i]); };
  const auto distance = [&](std::size_t i) { return box.diagonal * samples.distance[i]; };
  if (csv) {
    AtomicFile file(path);
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "x,y,z,distance,triangle\n");
    for (std::size_t i = 0; i < samples.distance.size(); ++i) {
      const Vec3 p = position(i);
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", p.x(), p.y(), p.z(), distance(i),
                     samples.triangle[i]);
      if (text.size() < (1u << 20)) continue;
      work.check();
      file.write({text.data(), text.size()});
      text.clear();
    }
    file.write({text.data(), text.size()});
    file.commit();
    return;
  }
  PlyFile ply;
  auto& vertex = ply.element("vertex", samples.distance.size());
  vertex.column<double>("x", [&](std::size_t i) { return position(i).x(); });
  vertex.column<double>("y", [&](std::size_t i) { return position(i).y(); });
  vertex.column<double>("z", [&](std::size_t i) { return position(i).z(); });
  vertex.column<double>("distance", distance);
  vertex.column<std::int32_t>("triangle", samples.triangle);
  write_ply(work, path, ply);
}

std::vector<std::string> result_files() {
  return {"distance.json", "deviation.ply", "deviation.png", "samples-a.ply",
          "samples-b.ply", "samples-a.csv", "samples-b.csv"};
}

void write_results(const Work& work, const OutputFolder& folder, const DistanceFlags& flags, const Measured& m,
                   const std::string& report) {
  write_file_atomically(folder.file("distance.json"), report);
  const Deviation deviation{m.a.soup, m.distance, m.box.diagonal};
  const ColourScale scale = deviation_scale(deviation);
  write_deviation_ply(work, folder.file("deviation.ply"), deviation, scale);
  Shape shape;
  shape.x = m.a.soup.x, shape.y = m.a.soup.y, shape.z = m.a.soup.z, shape.corner = m.a.soup.corner;
  write_png(folder.file("deviation.png"), draw_deviation(work, deviation, scale, best_view(work, shape)));
  if (flags.save_samples.empty()) return;
  const bool csv = flags.save_samples == "csv";
  write_samples(work, folder.file("samples-a." + flags.save_samples), m.distance.forward_sample, m.box, csv);
  write_samples(work, folder.file("samples-b." + flags.save_samples), m.distance.backward_sample, m.box, csv);
}

int distance(const DistanceFlags& flags) {
  if (!flags.save_samples.empty() && flags.output.empty())
    throw Error(ErrorCode::bad_argument, "--save-samples needs a folder: -o DIR");
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  std::optional<OutputFolder> folder;
  if (!flags.output.empty()) folder.emplace(flags.output, result_files());
  Measured m;
  context.execute([&] { m = measure(work, flags); });
  const std::string report = report_of(flags, m).dump(1) + "\n";
  if (folder) {
    context.execute([&] { write_results(work, *folder, flags, m, report); });
    folder->commit();
  }
  if (flags.json)
    fmt::print("{}", report);
  else if (!flags.quiet)
    print_text(flags, m);
  return kExitDone;
}

}  // namespace

void add_distance_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<DistanceFlags>();
  CLI::App* command = app.add_subcommand("distance", "how far two meshes are apart: largest, mean, RMS, both ways");
  command->add_option("a", flags->a, "mesh: .ply .obj .stl .off; relative numbers are in its diagonals")->required();
  command->add_option("b", flags->b, "mesh to compare with")->required();
  command->add_option("-o,--output", flags->output, "folder for deviation.ply, deviation.png and distance.json");
  command->add_option("--samples", flags->samples, "on both surfaces together; every triangle gets at least one")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 31))
      ->capture_default_str();
  command->add_flag("--patches", flags->patches, "also per patch: A's int face property patch");
  command->add_option("--save-samples", flags->save_samples, "write all samples into the folder: ply or csv")
      ->check(CLI::IsMember({"ply", "csv"}));
  command->add_flag("--json", flags->json, "print the report as JSON");
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = distance(*flags); });
}

}  // namespace intarsia::tools
