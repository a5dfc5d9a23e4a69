#include "engine/io/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <new>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/io/file_error.h"
#include "engine/parallel/for_each.h"

namespace intarsia {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

std::string reason(int errno_value) { return std::generic_category().message(errno_value); }

// 0, an errno, or -1 if the file ends early.
int read_range(int fd, char* to, std::size_t begin, std::size_t end) {
  while (begin < end) {
    const ssize_t got = ::pread(fd, to + begin, end - begin, static_cast<off_t>(begin));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got < 0 ? errno : -1;
    begin += static_cast<std::size_t>(got);
  }
  return 0;
}

}  // namespace

FileBytes::FileBytes(const Work& work, const std::filesystem::path& path) {
  // O_NONBLOCK: opening a pipe without a writer must not hang; it means nothing for regular files.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0)
    throw_bad_file(path, "cannot be opened (" + reason(errno) + ")", "check the name and the permissions");
  struct stat status {};
  if (::fstat(file.get(), &status) != 0)
    throw_bad_file(path, "cannot be inspected (" + reason(errno) + ")", "copy it to a local disk");
  if (!S_ISREG(status.st_mode))
    throw_bad_file(path, S_ISDIR(status.st_mode) ? "is a folder" : "is not a regular file",
                   "give the name of a mesh file on disk");
  size_ = static_cast<std::size_t>(status.st_size);
  try {
    bytes_ = std::make_unique_for_overwrite<char[]>(std::max<std::size_t>(size_, 1));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::no_memory, path.string() + ": its " + std::to_string(size_) +
                                          " bytes do not fit in memory; simplify the mesh or use a larger machine");
  }
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  std::atomic<int> failure{0};  // which of several reasons is shown does not matter
  for_each(work, Cost::single, (size_ + kPiece - 1) / kPiece, [&](std::size_t piece) {
    const int e = read_range(file.get(), bytes_.get(), piece * kPiece, std::min(size_, (piece + 1) * kPiece));
    if (e != 0) failure = e;
  });
  if (failure > 0) throw_bad_file(path, "cannot be read (" + reason(failure) + ")", "copy it to a local disk");
  if (failure < 0) throw_bad_file(path, "became shorter while it was read", "wait until it is written, then run again");
}

}  // namespace intarsia
