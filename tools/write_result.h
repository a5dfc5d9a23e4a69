// The "write" stage: the files of a run's output folder, and what remains of the run for its report.
#pragma once

#include "engine/io/output_folder.h"
#include "graph/artefacts.h"
#include "tools/export/formats.h"
#include "tools/view_flag.h"

namespace intarsia::tools {

// Every file name that a run may write into its output folder.
std::vector<std::string> result_names();

// What --write asks for.
struct Exports {
  FileSet files;
  bool is_default = true;  // files were not named by the user
  std::string name;        // of the input, for titles
};

struct Written {
  std::uint64_t files = 0, bytes = 0;
};

inline std::uint64_t hash_of(const Written& w) { return w.bytes; }
inline std::size_t bytes_of(const Written&) { return 0; }
inline std::size_t items_of(const Written& w) { return w.files; }

Written write_result(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                     const graph::Ridges& ridges, const graph::Ridges& valleys, const graph::Sharp& sharp,
                     const graph::Network& network, const graph::Layout& layout, const Pictures& pictures,
                     const Exports& exports);

// The same files of a method without curves. method: its name, over the picture of its labels.
Written write_baseline(const Work& work, const OutputFolder& folder, const Soup& soup, const graph::Surface& surface,
                       const graph::Patches& patches, const graph::Layout& layout, const std::string& method,
                       const Pictures& pictures, const Exports& exports);

}  // namespace intarsia::tools
