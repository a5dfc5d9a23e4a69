#include <fmt/format.h>

#include "engine/run/context.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/interrupt.h"
#include "tools/make/shape.h"
#include "tools/make/truth.h"
#include "tools/usual_flags.h"

namespace intarsia::tools {
namespace {

struct MakeFlags {
  MakeOptions options;
  std::string output, truth;
  std::vector<std::string> parameters;
  int threads = 0;
  bool quiet = false;
};

std::string shape_list() {
  std::string text = "Shapes and their parameters (--set name=value):\n";
  for (const ShapeInfo& s : shapes()) {
    text += fmt::format("  {:<12} {}\n", s.name, s.help);
    for (const ShapeParameter& p : s.parameters)
      text += fmt::format("    {:<10} {} (default {}, {} .. {})\n", p.name, p.help, p.value, p.least, p.most);
  }
  return text;
}

void read_parameters(MakeFlags& flags) {
  for (const std::string& text : flags.parameters) {
    const std::size_t at = text.find('=');
    std::size_t used = 0;
    Real value = 0;
    try {
      if (at != std::string::npos) value = std::stod(text.substr(at + 1), &used);
    } catch (const std::exception&) {
    }
    if (at == std::string::npos || used == 0 || used != text.size() - at - 1)
      throw Error(ErrorCode::bad_argument, "--set wants name=value with a number, not '" + text + "'");
    flags.options.parameters[text.substr(0, at)] = value;
  }
}

int make(MakeFlags& flags) {
  read_parameters(flags);
  check(flags.options);
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  context.execute([&] {
    make_to_file(context.work(), flags.options, flags.output);
    if (!flags.truth.empty()) write_truth(true_features(flags.options), flags.truth);
  });
  if (!flags.quiet) fmt::print("written to {}\n", flags.output);
  return kExitDone;
}

}  // namespace

void add_make_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<MakeFlags>();
  CLI::App* command = app.add_subcommand("make", "scan-like sample mesh of a known shape");
  command->footer(shape_list());
  command->add_option("shape", flags->options.shape, "name of the shape, see below")->required();
  command->add_option("-o,--output", flags->output, "PLY file to write")->required()->check(file_ending(".ply"));
  command->add_option("--triangles", flags->options.triangles, "wanted number of triangles")->capture_default_str();
  command->add_option("--irregularity", flags->options.irregularity, "0 even .. 1 very uneven triangles")
      ->capture_default_str();
  command->add_option("--noise", flags->options.noise_diagonal, "Gaussian noise along the normal, diagonals");
  command->add_option("--noise-edges", flags->options.noise_edges, "the same in mean edge lengths");
  command->add_option("--seed", flags->options.seed, "of sampling, irregularity and noise")->capture_default_str();
  command->add_flag("--double", flags->options.double_coordinates, "double coordinates");
  command->add_option("--set", flags->parameters, "parameter of the shape: name=value");
  command->add_option("--truth", flags->truth, "write the true feature curves to this OBJ file");
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = make(*flags); });
}

}  // namespace intarsia::tools
