// The bytes of a regular file in memory. Read, not mapped: a mapped file that another program cuts kills the process.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "engine/parallel/work.h"

namespace intarsia {

class FileBytes {
 public:
  // Errors: bad_file if there is no such regular file, or it cannot be read; no_memory.
  FileBytes(const Work& work, const std::filesystem::path& path);

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace intarsia
