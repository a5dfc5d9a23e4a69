#include "tools/make/temporary_file.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "engine/base/error.h"

namespace intarsia::tools {

TemporaryFile::TemporaryFile(const std::filesystem::path& path) : final_(path), temporary_(path) {
  temporary_ += ".part-" + std::to_string(::getpid());
  handle_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (handle_ < 0) fail("create");
}

TemporaryFile::~TemporaryFile() {
  if (handle_ >= 0) ::close(handle_);
  if (!finished_) ::unlink(temporary_.c_str());
}

void TemporaryFile::write_at(std::uint64_t offset, const char* data, std::size_t size) const {
  while (size > 0) {
    const ssize_t n = ::pwrite(handle_, data, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("write");
    data += n, offset += static_cast<std::uint64_t>(n), size -= static_cast<std::size_t>(n);
  }
}

void TemporaryFile::finish() {
  const int handle = handle_;
  handle_ = -1;
  if (::close(handle) != 0) fail("write");
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail("rename");
  finished_ = true;
}

void TemporaryFile::fail(const char* what) const {
  const std::string reason = std::generic_category().message(errno);
  // A constructor that throws runs no destructor: nothing exists then. Later the destructor cleans up.
  throw Error(ErrorCode::write_failed, std::string("cannot ") + what + " " + temporary_.string() + ": " + reason);
}

}  // namespace intarsia::tools
