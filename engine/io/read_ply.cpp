#include "engine/io/read_ply.h"

#include "engine/io/file_error.h"
#include "engine/io/ply_body.h"

namespace intarsia {
namespace {

PlyTask task_for(const std::filesystem::path& path, const PlyElement& element) {
  PlyTask task;
  const auto fail = [&](const std::string& what) { throw_bad_file(path, what, kCureExportAgain); };
  if (element.name == "vertex") {
    task.kind = PlyTask::Kind::vertices;
    constexpr const char* kName[3] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      task.coordinate[i] = element.find(kName[i]);
      if (task.coordinate[i] < 0 || element.property[static_cast<std::size_t>(task.coordinate[i])].is_list)
        fail(std::string("its vertices have no property ") + kName[i]);
    }
  } else if (element.name == "face" || element.name == "tristrips") {
    task.kind = element.name == "face" ? PlyTask::Kind::polygons : PlyTask::Kind::strips;
    task.list = element.find("vertex_indices");
    if (task.list < 0) task.list = element.find("vertex_index");
    if (task.list < 0) {
      if (element.count == 0) return PlyTask{};
      fail("its element '" + element.name + "' has no list 'vertex_indices'");
    }
    const PlyProperty& list = element.property[static_cast<std::size_t>(task.list)];
    if (!list.is_list || !is_integer(list.type)) fail("its list '" + list.name + "' is no list of integers");
  }
  return task;
}

}  // namespace

Soup read_ply(const Work& work, const std::filesystem::path& path, std::string_view file) {
  const PlyHeader header = parse_ply_header(path, file);
  const PlyElement* vertices = header.find("vertex");
  if (!vertices || vertices->count == 0) throw_bad_file(path, "has no vertices", kCureExportAgain);
  check_vertex_count(path, vertices->count);
  std::vector<PlyTask> task;
  for (const PlyElement& e : header.element) task.push_back(task_for(path, e));

  Soup soup;
  FaceCollector faces(path, vertices->count, soup);
  const std::string_view body = file.substr(header.data_begin);
  if (header.format != PlyFormat::ascii)
    read_ply_binary(work, path, header, task, body, soup, faces);
  else if (!read_ply_lines(work, header, task, body, soup, faces))
    read_ply_ascii(work, path, header, task, body, soup, faces);
  return soup;
}

}  // namespace intarsia
