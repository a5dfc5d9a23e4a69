#include "engine/io/write_file.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/io/file_error.h"
#include "engine/io/temporary_name.h"

namespace intarsia {
namespace {

namespace fs = std::filesystem;

void remove_abandoned(const fs::path& target) {
  std::error_code ignored;  // housekeeping: no reason to fail
  for (fs::directory_iterator it(target.parent_path(), ignored), end; it != end; it.increment(ignored)) {
    if (ignored) return;
    if (is_abandoned(it->path().filename().string(), Temporary::new_result, target) &&
        it->symlink_status(ignored).type() == fs::file_type::regular)
      fs::remove(it->path(), ignored);
  }
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) {
  std::error_code error;
  path_ = fs::absolute(path, error);
  if (!error) path_ = fs::weakly_canonical(path_, error);
  if (error) throw_write_failed(path, "is no usable name for a file: " + error.message(), 0);
  const fs::file_type type = fs::status(path_, error).type();
  if (type == fs::file_type::directory) throw_write_failed(path, "is a folder; name a file", 0);
  if (type != fs::file_type::not_found && type != fs::file_type::regular)
    throw_write_failed(path, "is not a regular file and will not be replaced", 0);
  if (!path_.has_filename()) throw_write_failed(path, "names no file", 0);
  const fs::path folder = path_.parent_path();
  if (!fs::is_directory(folder, error))
    throw_write_failed(path, "cannot be written: there is no folder " + folder.string() + "; create it first", 0);
  remove_abandoned(path_);
  do {
    temporary_ = folder / temporary_name(Temporary::new_result, path_);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (file_ < 0 && errno == EEXIST);
  if (file_ < 0) throw_write_failed(path, "cannot be written in the folder " + folder.string(), errno);
  struct stat earlier {};
  if (type == fs::file_type::regular && ::stat(path_.c_str(), &earlier) == 0 &&
      ::fchmod(file_, earlier.st_mode & 07777) != 0)
    errno = 0;  // some file systems have no permissions
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(file_, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw_write_failed(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void AtomicFile::write_at(std::uint64_t offset, const char* bytes, std::size_t size) const {
  while (size > 0) {
    const ssize_t done = ::pwrite(file_, bytes, size, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw_write_failed(path_, "cannot be written", errno);
    offset += static_cast<std::uint64_t>(done), bytes += done, size -= static_cast<std::size_t>(done);
  }
}

void AtomicFile::commit(bool durable) {
  if (durable && ::fsync(file_) != 0 && errno != EINVAL && errno != EROFS)
    throw_write_failed(path_, "cannot be written", errno);
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) throw_write_failed(path_, "cannot be written", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) throw_write_failed(path_, "cannot be replaced", errno);
  temporary_.clear();
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace intarsia
