#include "tools/guide_flags.h"

#include "engine/base/checksum.h"
#include "engine/io/file_bytes.h"
#include "engine/io/read_labels.h"
#include "engine/io/read_polylines.h"

namespace intarsia::tools {

void add_guide_flags(CLI::App& app, GuideFlags& flags) {
  app.add_option("--curves", flags.curves,
                 "curves that become borders as they are: .obj with lines ('l'), or .polylines.txt; in the mesh's "
                 "coordinates, on it or near it");
  app.add_option("--pin", flags.pin,
                 "regions that stay patches as they are: .seg (one number a line, negative: free) or .ply with a face "
                 "property 'patch'; every connected piece of a number becomes one patch");
}

graph::GuideSource guide_source(const Work& work, const GuideFlags& flags) {
  graph::GuideSource source;
  if (flags.curves.empty() && flags.pin.empty()) return source;
  Hash hash;
  graph::GivenGuides given;
  if (!flags.curves.empty()) {
    const FileBytes file(work, flags.curves);
    hash.add(checksum(file.view().data(), file.view().size()));
    given.curve = read_polylines(work, flags.curves, file.view());
  }
  std::vector<int> pin;
  if (!flags.pin.empty()) {
    const FileBytes file(work, flags.pin);
    hash.add(checksum(file.view().data(), file.view().size()));
    pin = read_face_labels(work, flags.pin, file.view(), "patch");
  }
  source.hash = hash.value();
  source.read = [given, pin, path = flags.pin](const Soup& soup) {
    graph::GivenGuides all = given;
    if (!pin.empty()) all.pin = labels_of_triangles(path, pin, soup.source_face, soup.face_count());
    return all;
  };
  return source;
}

}  // namespace intarsia::tools
