#include "engine/io/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/io/file_error.h"
#include "engine/io/temporary_name.h"

namespace intarsia {
namespace {

namespace fs = std::filesystem;

// Links are not followed.
fs::file_type type_of(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}
bool is_there(const fs::path& path) { return type_of(path) != fs::file_type::not_found; }
bool is_folder(const fs::path& path) { return type_of(path) == fs::file_type::directory; }

// 0 or the reason why not.
int sync(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return errno;
  const int reason = ::fsync(file) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
  ::close(file);
  return reason;
}

void make_durable(const fs::path& path) {
  if (const int reason = sync(path); reason != 0) throw_write_failed(path, "cannot be written", reason);
}

std::vector<fs::directory_entry> list(const fs::path& folder, std::error_code& error) {
  std::vector<fs::directory_entry> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) entries.push_back(*it);
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
  std::error_code error;
  auto entries = list(folder, error);
  if (error) throw_write_failed(folder, "cannot be listed: " + error.message(), 0);
  return entries;
}

// False if the file system has no such operation.
bool swap_folders(const fs::path& a, const fs::path& b) {
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP) return false;
  throw_write_failed(b, "cannot be replaced", errno);
}

// Undoes a rename that has just worked.
void rename_back(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0)
    throw_write_failed(to, "could not be put back and is now " + from.string(), errno);
}

// A name that is free in `folder`: `name` itself or NAME.recovered-N.
fs::path free_name(const fs::path& folder, const fs::path& name) {
  fs::path candidate = folder / name;
  for (int n = 1; is_there(candidate); ++n) {
    candidate = folder / name;
    candidate += ".recovered-" + std::to_string(n);
  }
  return candidate;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target, std::vector<std::string> our_names)
    : our_names_(std::move(our_names)) {
  std::error_code error;
  target_ = fs::absolute(target, error);
  if (!error) target_ = fs::weakly_canonical(target_, error);
  if (error) throw_write_failed(target, "is no usable name for a folder: " + error.message(), 0);
  if (!target_.has_filename()) target_ = target_.parent_path();  // written with a slash at the end
  parent_ = target_.parent_path();
  if (is_there(target_) && !is_folder(target_)) throw_write_failed(target, "is a file; name a folder", 0);
  if (is_there(target_) && ::access(target_.c_str(), R_OK | W_OK | X_OK) != 0)
    throw_write_failed(target, "cannot be written", errno);
  const fs::path here = fs::current_path(error);
  if (!error && std::mismatch(target_.begin(), target_.end(), here.begin(), here.end()).first == target_.end())
    throw_write_failed(target,
                       "is the current folder or one above it, which cannot be exchanged; name a folder of its own", 0);
  if (!fs::is_directory(parent_, error))
    throw_write_failed(target, "cannot be written: there is no folder " + parent_.string() + "; create it first", 0);
  recover();
  int failure = 0;
  do {
    fresh_ = parent_ / temporary_name(Temporary::new_result, target_);
    failure = ::mkdir(fresh_.c_str(), 0777) == 0 ? 0 : errno;
  } while (failure == EEXIST);
  if (failure != 0) {
    fresh_.clear();
    throw_write_failed(target, "cannot be written: no folder can be made in " + parent_.string(), failure);
  }
  struct stat earlier {};
  if (::stat(target_.c_str(), &earlier) == 0 && ::chmod(fresh_.c_str(), (earlier.st_mode & 07777) | 0700) != 0)
    errno = 0;  // some file systems have no permissions
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!fresh_.empty()) fs::remove_all(fresh_, ignored);
}

fs::path OutputFolder::file(const std::string& name) const {
  if (std::find(our_names_.begin(), our_names_.end(), name) == our_names_.end())
    throw Error(ErrorCode::internal, "'" + name + "' is not in the list of result files");
  fs::path path = fresh_ / name;
  if (path.parent_path() != fresh_ && ::mkdir(path.parent_path().c_str(), 0777) != 0 && errno != EEXIST)
    throw_write_failed(target_ / name, "cannot be written: no folder can be made for it", errno);
  return path;
}

// A folder of results is ours if all that it holds is; then a user has put nothing into it.
bool OutputFolder::is_ours(const fs::directory_entry& entry) const {
  const auto is_listed = [&](const std::string& name) {
    return std::find(our_names_.begin(), our_names_.end(), name) != our_names_.end();
  };
  const std::string name = entry.path().filename().string();
  if (!is_folder(entry.path())) return is_listed(name) || is_temporary_name(name);
  const auto is_inside = [&](const std::string& ours) { return ours.starts_with(name + "/"); };
  if (std::none_of(our_names_.begin(), our_names_.end(), is_inside)) return false;
  std::error_code error;
  const auto inside = list(entry.path(), error);
  return !error && std::all_of(inside.begin(), inside.end(), [&](const fs::directory_entry& e) {
    const std::string file = e.path().filename().string();
    return !is_folder(e.path()) && (is_listed(name + "/" + file) || is_temporary_name(file));
  });
}

void OutputFolder::commit() {
  for (const auto& entry : entries_of(fresh_)) {
    const std::string name = entry.path().filename().string();
    if (is_temporary_name(name) || !is_ours(entry))
      throw Error(ErrorCode::internal, "'" + name + "' among the results is not in the list of result files");
    if (is_folder(entry.path()))
      for (const auto& inside : entries_of(entry.path())) make_durable(inside.path());
    make_durable(entry.path());
  }
  make_durable(fresh_);
  if (!is_there(target_)) {
    if (::rename(fresh_.c_str(), target_.c_str()) != 0) throw_write_failed(target_, "cannot be written", errno);
    fresh_.clear();
  } else {
    for (const auto& entry : entries_of(target_))
      if (!is_ours(entry) && is_there(fresh_ / entry.path().filename()))
        throw_write_failed(entry.path(), "is a folder, but a result of that name is to be written; move it away", 0);
    exchange();
  }
  sync(parent_);  // the results are in place, whether or not that worked
  recover();      // folders that could not be emptied while the target was missing
}

// Ensures: the results stand at target_, what was not ours has moved over, and the rest of what was there is gone; or,
// with an error, everything is as before.
void OutputFolder::exchange() {
  const bool swapped = swap_folders(fresh_, target_);
  fs::path old = fresh_;
  if (!swapped) {
    old = parent_ / temporary_name(Temporary::old_result, target_);
    if (::rename(target_.c_str(), old.c_str()) != 0) throw_write_failed(target_, "cannot be replaced", errno);
    if (::rename(fresh_.c_str(), target_.c_str()) != 0) {
      const int reason = errno;
      rename_back(old, target_);
      throw_write_failed(target_, "cannot be replaced", reason);
    }
  }
  const fs::path fresh = fresh_;
  fresh_.clear();  // until the end nothing may be removed unseen
  std::vector<fs::path> moved;
  for (const auto& entry : entries_of(old)) {
    if (is_ours(entry)) continue;
    const fs::path name = entry.path().filename();
    if (::rename((old / name).c_str(), (target_ / name).c_str()) == 0) {
      moved.push_back(name);
      continue;
    }
    const int reason = errno;
    for (const fs::path& back : moved) rename_back(target_ / back, old / back);
    if (!swapped || !swap_folders(old, target_)) {
      rename_back(target_, fresh);
      rename_back(old, target_);
    }
    fresh_ = fresh;
    throw_write_failed(target_ / name, "cannot be moved into the new folder; the earlier result stays", reason);
  }
  remove_ours(old);
}

void OutputFolder::remove_ours(const fs::path& folder) const {
  std::error_code ignored;
  for (const auto& entry : list(folder, ignored)) {
    if (!is_ours(entry)) continue;
    if (is_folder(entry.path()))
      for (const auto& inside : list(entry.path(), ignored)) fs::remove(inside.path(), ignored);
    fs::remove(entry.path(), ignored);
  }
  fs::remove(folder, ignored);  // succeeds only if empty
}

// What killed runs have left beside the target. Without a target, an earlier result on its way out is put back; folders
// that hold anything but our files wait until there is a target to take it.
void OutputFolder::recover() {
  std::error_code failed;  // what cannot be listed stays where it is
  std::vector<fs::path> abandoned;
  for (const Temporary kind : {Temporary::old_result, Temporary::new_result})
    for (const auto& entry : list(parent_, failed))
      if (is_folder(entry.path()) && is_abandoned(entry.path().filename().string(), kind, target_)) {
        if (kind == Temporary::old_result && !is_there(target_) && ::rename(entry.path().c_str(), target_.c_str()) == 0)
          continue;
        abandoned.push_back(entry.path());
      }
  for (const auto& folder : abandoned) {
    const auto entries = list(folder, failed);
    const auto ours = [&](const auto& entry) { return is_ours(entry); };
    if (failed) continue;
    if (!is_there(target_) && !std::all_of(entries.begin(), entries.end(), ours)) continue;
    for (const auto& entry : entries)
      if (!ours(entry) && ::rename(entry.path().c_str(), free_name(target_, entry.path().filename()).c_str()) != 0)
        continue;  // it stays where it is
    remove_ours(folder);
  }
}

}  // namespace intarsia
