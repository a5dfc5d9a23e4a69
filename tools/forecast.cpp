#include "tools/forecast.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/io/extension.h"
namespace intarsia::tools {
namespace {

constexpr std::size_t kHead = 1 << 16;  // bytes of a file that are looked at

std::string head_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return head;
}

std::uint64_t vertices_of_ply(const std::string& head) {
  const std::string key = "element vertex ";
  const std::size_t at = head.find(key);
  return at == std::string::npos ? 0 : std::strtoull(head.c_str() + at + key.size(), nullptr, 10);
}

std::uint64_t vertices_of_off(const std::string& head) {
  std::istringstream lines(head);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t digit = line.find_first_of("0123456789");
    if (digit == std::string::npos || line.find('#') < digit) continue;
    return std::strtoull(line.c_str() + digit, nullptr, 10);
  }
  return 0;
}

// Binary: 84 bytes, then 50 a triangle. Text: about 250 a triangle. A closed surface has half as many vertices.
std::uint64_t vertices_of_stl(const std::string& head, std::uint64_t bytes) {
  if (bytes < 84 || head.size() < 84) return 0;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, head.data() + 80, 4);
  if (bytes == 84 + 50 * std::uint64_t{triangles}) return triangles / 2;
  return bytes / 250 / 2;
}

// By the share of lines that begin with "v " among the first bytes.
std::uint64_t vertices_of_obj(const std::string& head, std::uint64_t bytes) {
  std::size_t lines = 0, vertices = 0, faces = 0;
  for (std::size_t at = 0; at < head.size();
       at = head.find('\n', at) == std::string::npos ? head.size() : head.find('\n', at) + 1) {
    ++lines;
    if (head.compare(at, 2, "v ") == 0) ++vertices;
    if (head.compare(at, 2, "f ") == 0) ++faces;
  }
  if (vertices == 0) return 0;
  const double per_line = static_cast<double>(head.size()) / static_cast<double>(lines);
  const double all = static_cast<double>(bytes) / per_line;
  // Files list the vertices first: with none of the faces in sight, two faces a vertex follow, a little shorter.
  if (faces == 0)
    return static_cast<std::uint64_t>(all * static_cast<double>(vertices) / static_cast<double>(lines) / 2.6);
  return static_cast<std::uint64_t>(all * static_cast<double>(vertices) / static_cast<double>(lines));
}

std::int64_t number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::int64_t n = -1;
  return in >> n ? n : -1;
}

}  // namespace

std::uint64_t vertices_in(const std::filesystem::path& file) {
  std::error_code failed;
  const std::uint64_t bytes = std::filesystem::file_size(file, failed);
  if (failed) return 0;
  const std::string head = head_of(file);
  const std::string ending = lower_extension(file);
  // A header may promise more than there is: no vertex takes less than two bytes of text or twelve of numbers.
  const std::uint64_t most = bytes / 2;
  if (head.compare(0, 3, "ply") == 0) return std::min(vertices_of_ply(head), most);
  if (ending == ".stl") return vertices_of_stl(head, bytes);
  if (ending == ".obj") return vertices_of_obj(head, bytes);
  if (head.find("OFF") < 8) return std::min(vertices_of_off(head), most);
  return 0;
}

std::uint64_t available_memory() {
  std::int64_t available = std::int64_t{1} << 62;
  std::ifstream info("/proc/meminfo");
  std::string word;
  while (info >> word)
    if (word == "MemAvailable:") {
      std::int64_t kilobytes = 0;
      if (info >> kilobytes) available = kilobytes * 1024;
      break;
    }
  const std::int64_t most = number_in("/sys/fs/cgroup/memory.max"), now = number_in("/sys/fs/cgroup/memory.current");
  if (most > 0) available = std::min(available, std::max<std::int64_t>(most - std::max<std::int64_t>(now, 0), 0));
  return static_cast<std::uint64_t>(available);
}

std::string memory_text(std::uint64_t bytes) {
  const double b = static_cast<double>(bytes);
  return b >= 1e9 ? fmt::format("{:.2f} GB", b / 1e9) : fmt::format("{:.0f} MB", b / 1e6);
}

void check_memory(const Forecast& forecast, std::uint64_t most) {
  if (most == 0 || forecast.peak_memory <= most) return;
  throw Error(ErrorCode::no_memory,
              "this mesh needs about " + memory_text(forecast.peak_memory) + ", more than the " + memory_text(most) +
                  " that --max-memory allows; nothing was begun. Allow more, or take a smaller mesh: simplified, or in "
                  "parts");
}

}  // namespace intarsia::tools
