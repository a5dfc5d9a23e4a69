#include "engine/io/output_folder.h"

#include <csignal>
#include <cstdio>
#include <functional>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/io/temporary_name.h"
#include "engine/io/write_file.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kNames = {"report.json", "patches.ply", "layout.ply"};

void write_results(const fs::path& target, const std::string& text) {
  OutputFolder out(target, kNames);
  write_file_atomically(out.file("report.json"), text);
  write_file_atomically(out.file("patches.ply"), text);
  out.commit();
}

// Runs f in a process that is killed at its end; returns its id.
pid_t in_killed_process(const std::function<void()>& f) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      f();
    } catch (...) {
      ::_exit(1);
    }
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  return child;
}

// Runs f without the powers of the superuser, to whom nothing is read-only; returns what it returns.
bool as_ordinary_user(const TemporaryFolder& folder, const std::function<bool()>& f) {
  constexpr uid_t kNobody = 65534;
  const bool powerful = ::geteuid() == 0;
  if (powerful) REQUIRE(::chown(folder.path().c_str(), kNobody, kNobody) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    bool good = !powerful || (::setgid(kNobody) == 0 && ::setuid(kNobody) == 0);
    try {
      good = good && f();
    } catch (...) {
      good = false;
    }
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

constexpr fs::perms kReadOnly = fs::perms::owner_read | fs::perms::owner_exec;

// The name that process `owner` would have used beside `target`.
std::string name_by(pid_t owner, Temporary kind, const fs::path& target) {
  std::string name = temporary_name(kind, target);
  const std::string own = std::to_string(::getpid());
  return name.replace(name.find(own, 39), own.size(), std::to_string(owner));
}

}  // namespace

TEST_CASE("results appear at commit and not before") {
  const TemporaryFolder folder;
  {
    OutputFolder out(folder / "out", kNames);
    put_file(out.file("report.json"), "new");
    CHECK_FALSE(fs::exists(folder / "out"));
    out.commit();
    CHECK(get_file(folder / "out" / "report.json") == "new");
  }
  CHECK(get_file(folder / "out" / "report.json") == "new");
  CHECK(folder.entry_count() == 1);
  // A slash at the end and a way around mean the same folder.
  write_results((folder / "out").string() + "/", "newer");
  write_results(folder / "out" / ".." / "out", "newest");
  CHECK(get_file(folder / "out" / "report.json") == "newest");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("without commit the earlier result stays and nothing else remains") {
  const TemporaryFolder folder;
  {
    OutputFolder out(folder / "out", kNames);
    put_file(out.file("report.json"), "new");
  }
  CHECK(folder.entry_count() == 0);
  write_results(folder / "out", "earlier");
  {
    OutputFolder out(folder / "out", kNames);
    put_file(out.file("report.json"), "half");
    put_file(out.file("layout.ply"), "half");
  }
  CHECK(folder.entry_count() == 1);
  CHECK(get_file(folder / "out" / "report.json") == "earlier");
  CHECK_FALSE(fs::exists(folder / "out" / "layout.ply"));
}

TEST_CASE("an earlier result is exchanged as a whole; what is not ours stays in the folder") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directories(out / "photos" / "deep");
  put_file(out / "photos" / "deep" / "a.jpg", "picture");
  put_file(out / "notes.txt", "notes");
  put_file(out / ".hidden", "hidden");
  put_file(out / "layout.ply", "of an earlier run with other options");
  put_file(out / "report.json", "old");
  fs::create_symlink("notes.txt", out / "link");
  fs::permissions(out, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec);
  write_results(out, "new");
  CHECK(get_file(out / "report.json") == "new");
  CHECK(get_file(out / "patches.ply") == "new");
  CHECK_FALSE(fs::exists(out / "layout.ply"));
  CHECK(get_file(out / "photos" / "deep" / "a.jpg") == "picture");
  CHECK(get_file(out / "notes.txt") == "notes");
  CHECK(get_file(out / ".hidden") == "hidden");
  CHECK(fs::is_symlink(out / "link"));
  CHECK(fs::status(out).permissions() == (fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("the exchange has no moment without a whole result") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  fs::create_directory(folder / "b");
  if (::renameat2(AT_FDCWD, (folder / "a").c_str(), AT_FDCWD, (folder / "b").c_str(), RENAME_EXCHANGE) != 0) {
    MESSAGE("this file system cannot exchange folders in one step");
    return;
  }
  const fs::path out = folder / "out";
  write_results(out, "0");
  const pid_t watcher = ::fork();
  if (watcher == 0) {
    ::alarm(60);
    // A file that is opened while its folder is exchanged may be gone when the look into the old folder comes: look
    // again.
    const auto read = [&](const char* name) {
      const std::string text = get_file(out / name);
      return text.empty() ? get_file(out / name) : text;
    };
    for (std::string report; report != "end";) {
      report = read("report.json");
      if (report.empty() || read("patches.ply").empty()) ::_exit(1);
    }
    ::_exit(0);
  }
  for (int i = 1; i <= 30; ++i) write_results(out, std::to_string(i));
  write_results(out, "end");
  int status = 0;
  ::waitpid(watcher, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("through a link the folder behind it is exchanged") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "disk" / "real");
  put_file(folder / "disk" / "real" / "notes.txt", "notes");
  fs::create_directory_symlink("disk/real", folder / "out");
  write_results(folder / "out", "new");
  CHECK(fs::is_symlink(folder / "out"));
  CHECK(get_file(folder / "disk" / "real" / "report.json") == "new");
  CHECK(get_file(folder / "disk" / "real" / "notes.txt") == "notes");
  CHECK(std::distance(fs::directory_iterator(folder / "disk"), fs::directory_iterator{}) == 1);
}

TEST_CASE("targets that cannot work are refused by name") {
  const TemporaryFolder folder;
  put_file(folder / "file", "mine");
  const auto refused = [&](const fs::path& target, const std::string& reason) {
    const auto error = error_of([&] { OutputFolder out(target, kNames); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::write_failed);
    CHECK_MESSAGE(mentions(error, reason), error->what());
    CHECK(mentions(error, target.string()));
  };
  refused(folder / "file", "is a file");
  refused(folder / "no" / "out", "create it first");
  refused(folder / "file" / "out", "create it first");
  refused("/", "");
  refused("", "");
  refused(fs::current_path(), "current folder");
  refused(".", "current folder");
  refused(fs::current_path().parent_path(), "current folder");
  CHECK(get_file(folder / "file") == "mine");
}

TEST_CASE("folders that may not be written are refused by name") {
  const TemporaryFolder folder;
  CHECK(as_ordinary_user(folder, [&] {
    const auto refused = [&](const fs::path& target) {
      const auto error = error_of([&] { OutputFolder out(target, kNames); });
      return error && error->code() == ErrorCode::write_failed && mentions(error, target.string()) &&
             mentions(error, "ermission");
    };
    fs::create_directories(folder / "open" / "out");
    fs::permissions(folder / "open" / "out", kReadOnly);
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", kReadOnly);
    const bool good = refused(folder / "locked" / "new") && refused(folder / "open" / "out");
    fs::permissions(folder / "open" / "out", fs::perms::owner_all);
    fs::permissions(folder / "locked", fs::perms::owner_all);
    return good;
  }));
}

TEST_CASE("if a user's folder cannot be moved, all is as it was") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  CHECK(as_ordinary_user(folder, [&] {
    fs::create_directories(out / "locked");
    put_file(out / "a.txt", "before it");
    put_file(out / "z.txt", "behind it");
    put_file(out / "report.json", "old");
    fs::permissions(out / "locked", kReadOnly);  // its link to the folder above cannot be changed
    const auto error = error_of([&] { write_results(out, "new"); });
    const bool good = error && error->code() == ErrorCode::write_failed && mentions(error, "locked") &&
                      get_file(out / "report.json") == "old" && !fs::exists(out / "patches.ply") &&
                      get_file(out / "a.txt") == "before it" && get_file(out / "z.txt") == "behind it" &&
                      fs::exists(out / "locked") && folder.entry_count() == 1;
    fs::permissions(out / "locked", fs::perms::owner_all);
    return good;
  }));
}

TEST_CASE("a folder of results is exchanged like a file while nothing else is in it") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  std::vector<std::string> names = kNames;
  names.insert(names.end(), {"quads/mesh.obj", "quads/mesh.patch"});
  const auto write = [&](std::initializer_list<const char*> files) {
    OutputFolder results(out, names);
    for (const char* name : files) put_file(results.file(name), "new");
    results.commit();
  };
  write({"report.json", "quads/mesh.obj", "quads/mesh.patch"});
  CHECK(get_file(out / "quads" / "mesh.patch") == "new");
  write({"report.json", "quads/mesh.obj"});
  CHECK_FALSE(fs::exists(out / "quads" / "mesh.patch"));
  write({"report.json"});
  CHECK_FALSE(fs::exists(out / "quads"));
  CHECK(folder.entry_count() == 1);
  write({"quads/mesh.obj"});
  put_file(out / "quads" / "mine.txt", "mine");
  CHECK(error_of([&] { write({"quads/mesh.obj"}); })->code() == ErrorCode::write_failed);
  write({"report.json"});  // a user's folder now, and kept whole
  CHECK(get_file(out / "quads" / "mine.txt") == "mine");
  CHECK(get_file(out / "quads" / "mesh.obj") == "new");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("names outside the list are a mistake of the program") {
  const TemporaryFolder folder;
  OutputFolder out(folder / "out", kNames);
  CHECK(error_of([&] { (void)out.file("other.ply"); })->code() == ErrorCode::internal);
  put_file(out.file("report.json").parent_path() / "stray", "");
  CHECK(error_of([&] { out.commit(); })->code() == ErrorCode::internal);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a user's folder in the place of a result stops the exchange, all stays") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "out" / "report.json");
  put_file(folder / "out" / "report.json" / "precious", "precious");
  put_file(folder / "out" / "patches.ply", "old");
  const auto error = error_of([&] { write_results(folder / "out", "new"); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::write_failed);
  CHECK(get_file(folder / "out" / "report.json" / "precious") == "precious");
  CHECK(get_file(folder / "out" / "patches.ply") == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a run killed before its commit leaves nothing after the next run") {
  const TemporaryFolder folder;
  write_results(folder / "out", "old");
  put_file(folder / ".intarsia-notes", "mine");
  in_killed_process([&] {
    auto* out = new OutputFolder(folder / "out", kNames);
    put_file(out->file("report.json"), "half");
    (new AtomicFile(out->file("patches.ply")))->write("half");
  });
  CHECK(folder.entry_count() == 3);
  CHECK(get_file(folder / "out" / "report.json") == "old");
  { OutputFolder another(folder / "other", kNames); }
  CHECK(folder.entry_count() == 3);  // other targets are not its business
  write_results(folder / "out", "new");
  CHECK(folder.entry_count() == 2);
  CHECK(get_file(folder / "out" / "report.json") == "new");
}

TEST_CASE("a run killed right after the exchange loses nothing that is not ours") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const pid_t dead = in_killed_process([] {});
  // As it stands then: the new result in place, the old folder under the temporary name.
  write_results(out, "new");
  put_file(out / "plan.txt", "a later file of the same name");
  const fs::path old = folder / name_by(dead, Temporary::new_result, out);
  fs::create_directories(old / "photos");
  put_file(old / "photos" / "a.jpg", "picture");
  put_file(old / "plan.txt", "the earlier file");
  put_file(old / "report.json", "old");
  { OutputFolder next(out, kNames); }
  CHECK(folder.entry_count() == 1);
  CHECK(get_file(out / "report.json") == "new");
  CHECK(get_file(out / "photos" / "a.jpg") == "picture");
  CHECK(get_file(out / "plan.txt") == "a later file of the same name");
  CHECK(get_file(out / "plan.txt.recovered-1") == "the earlier file");
}

TEST_CASE("foreign files in a leftover wait until there is a folder to take them") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const fs::path old = folder / name_by(in_killed_process([] {}), Temporary::new_result, out);
  fs::create_directory(old);
  put_file(old / "notes.txt", "notes");
  put_file(old / "report.json", "old");
  { OutputFolder given_up(out, kNames); }
  CHECK(get_file(old / "notes.txt") == "notes");
  write_results(out, "new");
  CHECK(get_file(out / "notes.txt") == "notes");
  CHECK(get_file(out / "report.json") == "new");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a run killed between the two renames of the fallback is undone") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const pid_t dead = in_killed_process([] {});
  const fs::path old = folder / name_by(dead, Temporary::old_result, out);
  const fs::path fresh = folder / name_by(dead, Temporary::new_result, out);
  fs::create_directory(old);
  put_file(old / "report.json", "old");
  put_file(old / "notes.txt", "notes");
  fs::create_directory(fresh);
  put_file(fresh / "report.json", "new");
  { OutputFolder given_up(out, kNames); }
  CHECK(get_file(out / "report.json") == "old");
  CHECK(get_file(out / "notes.txt") == "notes");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("folders of living runs are left alone") {
  const TemporaryFolder folder;
  OutputFolder first(folder / "out", kNames);
  put_file(first.file("report.json"), "first");
  write_results(folder / "out", "second");
  CHECK(folder.entry_count() == 2);
  first.commit();
  CHECK(get_file(folder / "out" / "report.json") == "first");
  CHECK(folder.entry_count() == 1);
}
