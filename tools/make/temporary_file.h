// A file that appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>

namespace intarsia::tools {

// Opens a temporary file beside `path`; the destructor removes it unless finish() was called.
// Errors: write_failed, from every member.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Safe from several threads at once.
  void write_at(std::uint64_t offset, const char* data, std::size_t size) const;
  void finish();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path final_, temporary_;
  int handle_ = -1;
  bool finished_ = false;
};

}  // namespace intarsia::tools
