// One mesh of a batch, and what became of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace intarsia::tools {

struct BatchItem {
  std::filesystem::path input;  // absolute
  std::string name;             // of its folder among the results; no two are the same
};

struct ItemState {
  std::uintmax_t bytes = 0;   // of the input
  std::int64_t modified = 0;  // of the input, nanoseconds
  bool operator==(const ItemState&) const = default;
};

// Zeros where the input cannot be looked at.
ItemState state_of(const std::filesystem::path& input);

// What is kept of an item that has been run.
struct ItemRecord {
  ItemState state;
  std::string options;  // of the run
  int exit = -1;        // exit status; 128 + signal for a run that was killed; -1: not run yet
  std::string message;  // why, where it is not 0
  std::int64_t triangles = 0, patches = 0;
  double seconds = 0, cpu_seconds = 0;
  std::int64_t peak_memory = 0;  // bytes
  std::string hash;

  // 0 and 5 (valid, but the checks warn): there is a layout.
  bool has_layout() const { return exit == 0 || exit == 5; }
};

// Records live in a folder `.batch` among the results: a line of JSON for each item, whole or not there.
// Returns a record with exit -1 if there is none or it cannot be read.
ItemRecord read_record(const std::filesystem::path& results, const std::string& name);
void write_record(const std::filesystem::path& results, const std::string& name, const ItemRecord& record);
std::filesystem::path log_file(const std::filesystem::path& results, const std::string& name);

// What became of it, as records and summaries tell it.
nlohmann::json record_json(const ItemRecord& record);

// Adds what the run's own report says.
void add_report(const std::filesystem::path& folder, ItemRecord& record);

}  // namespace intarsia::tools
