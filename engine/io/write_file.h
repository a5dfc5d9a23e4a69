// Files that are whole or not there: written under another name beside the target, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace intarsia {

class AtomicFile {
 public:
  // Opens a temporary file beside `path` (a link is followed to what it points to) and removes abandoned ones.
  // Errors (of all members): write_failed naming the file.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  // without commit(): nothing remains, an earlier file stays as it was
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  // Makes the bytes durable and gives the file its name. An earlier file's permissions are kept.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  int file_ = -1;
};

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace intarsia
