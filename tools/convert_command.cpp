#include <filesystem>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "engine/io/output_folder.h"
#include "engine/run/context.h"
#include "tools/commands.h"
#include "tools/exit_code.h"
#include "tools/export/formats.h"
#include "tools/interrupt.h"
#include "tools/layout_handover.h"
#include "tools/usual_flags.h"
#include "tools/view/write_page.h"

namespace intarsia::tools {
namespace {

struct ConvertFlags {
  std::string input, output;
  std::vector<std::string> list;
  int threads = 0;
  bool quiet = false;
};

// What only the run itself knows is left out, with a word if it was named.
FileSet files_of(const ConvertFlags& flags) {
  FileSet files = export_files(flags.list);
  for (const std::string& item : flags.list)
    if (item == "features.vtp")
      throw Error(ErrorCode::bad_argument,
                  "features.vtp needs the lines of the run itself: intarsia run MESH -o DIR --write features.vtp");
  files.erase("features.vtp");
  if (files.empty()) throw Error(ErrorCode::bad_argument, "--write names no file that can be made from a result");
  return files;
}

int convert(const ConvertFlags& flags) {
  const FileSet files = files_of(flags);
  RunSettings settings;
  settings.threads = flags.threads;
  RunContext context(settings, &interrupt_flag());
  const Work work = context.work();
  if (!is_result_folder(flags.input)) read_result_folder(work, flags.input);  // says what is missing
  OutputFolder folder(flags.output.empty() ? flags.input : flags.output, {files.begin(), files.end()});
  context.execute([&] {
    const auto result = LayoutHandover::read(work, flags.input);
    if (files.contains("view.html")) {
      PageOptions page;
      page.earlier = read_page_parts(std::filesystem::path(flags.input) / "view.html");
      write_page(work, folder.file("view.html"), result->handover(), page);
    }
    write_exports(work, result->handover(), files, [&](const std::string& name) { return folder.file(name); });
  });
  folder.commit();
  if (!flags.quiet) fmt::print("written to {}: {}\n", (folder.target() / "").string(), fmt::join(files, " "));
  return kExitDone;
}

}  // namespace

void add_convert_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* command = app.add_subcommand("convert", "write a result in the forms that other programs read");
  command->add_option("input", flags->input, "folder written by intarsia run")->required();
  command->add_option("-o,--output", flags->output,
                      "folder for the files; default: the input, to which they are added");
  command->add_option("--write", flags->list, export_help())->delimiter(',')->required();
  add_threads_flag(*command, flags->threads);
  add_quiet_flag(*command, flags->quiet);
  command->callback([flags, &exit_code] { exit_code = convert(*flags); });
}

}  // namespace intarsia::tools
