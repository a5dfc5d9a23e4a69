#include "tools/batch/item.h"

#include <chrono>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "engine/io/write_file.h"

namespace intarsia::tools {
namespace {

std::filesystem::path record_file(const std::filesystem::path& results, const std::string& name) {
  return results / ".batch" / (name + ".json");
}

// An object, or null if there is no such file or it is damaged.
nlohmann::json json_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  nlohmann::json json = nlohmann::json::parse(text.str(), nullptr, false);
  return json.is_object() ? json : nlohmann::json();
}

}  // namespace

ItemState state_of(const std::filesystem::path& input) {
  std::error_code failed;
  ItemState state;
  state.bytes = std::filesystem::file_size(input, failed);
  if (failed) return {};
  const auto time = std::filesystem::last_write_time(input, failed);
  if (!failed) state.modified = std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  return state;
}

ItemRecord read_record(const std::filesystem::path& results, const std::string& name) {
  const nlohmann::json j = json_in(record_file(results, name));
  ItemRecord r;
  try {
    if (j.is_null()) return r;
    r.state = {j.at("input_bytes"), j.at("input_modified")};
    r.options = j.at("options"), r.message = j.at("message"), r.hash = j.at("hash");
    r.triangles = j.at("triangles"), r.patches = j.at("patches");
    r.seconds = j.at("seconds"), r.cpu_seconds = j.at("cpu_seconds"), r.peak_memory = j.at("peak_memory_bytes");
    r.exit = j.at("exit");
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return r;
}

nlohmann::json record_json(const ItemRecord& r) {
  return {{"exit", r.exit},
          {"message", r.message},
          {"triangles", r.triangles},
          {"patches", r.patches},
          {"seconds", r.seconds},
          {"cpu_seconds", r.cpu_seconds},
          {"peak_memory_bytes", r.peak_memory},
          {"options", r.options},
          {"hash", r.hash}};
}

void write_record(const std::filesystem::path& results, const std::string& name, const ItemRecord& r) {
  nlohmann::json j = record_json(r);
  j["input_bytes"] = r.state.bytes, j["input_modified"] = r.state.modified;
  write_file_atomically(record_file(results, name),
                        j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::filesystem::path log_file(const std::filesystem::path& results, const std::string& name) {
  return results / ".batch" / (name + ".log");
}

void add_report(const std::filesystem::path& folder, ItemRecord& record) {
  const nlohmann::json report = json_in(folder / "report.json");
  try {
    if (report.is_null()) return;
    record.triangles = report.at("input").at("triangles");
    record.patches = report.at("counts").at("patches");
    record.seconds = report.at("seconds"), record.cpu_seconds = report.at("cpu_seconds");
    record.peak_memory = report.at("peak_memory_bytes");
    record.hash = report.at("hash");
  } catch (const nlohmann::json::exception&) {
  }
}

}  // namespace intarsia::tools
