// Files that are whole or not there: written under another name beside the target, then renamed.
#pragma once

#include <cstdint>
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
  // At a place of its own, from any thread; not mixed with write().
  void write_at(std::uint64_t offset, const char* bytes, std::size_t size) const;
  // Makes the bytes durable, unless a power cut may take them, and gives the file its name. An earlier file's
  // permissions are kept.
  void commit(bool durable = true);

 private:
  std::filesystem::path path_, temporary_;
  int file_ = -1;
};

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace intarsia
