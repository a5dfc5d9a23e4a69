#include "engine/io/write_file.h"

#include <csignal>

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "engine/io/temporary_name.h"
#include "tests/engine/io/io_support.h"

using namespace intarsia;
using namespace intarsia::test;
namespace fs = std::filesystem;

namespace {

// Runs f in a child process that then dies without cleaning up; returns the child's id.
template <class F>
pid_t in_killed_process(const F& f) {
  const pid_t child = ::fork();
  if (child == 0) {
    f();
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return child;
}

}  // namespace

TEST_CASE("a file is replaced whole and keeps its permissions") {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.json", "one");
  CHECK(get_file(folder / "a.json") == "one");
  fs::permissions(folder / "a.json", fs::perms::owner_read | fs::perms::owner_write);
  const std::string long_text(1 << 20, 'x');
  write_file_atomically(folder / "a.json", long_text);
  CHECK(get_file(folder / "a.json") == long_text);
  CHECK(fs::status(folder / "a.json").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("without commit the earlier file stays and nothing else remains") {
  const TemporaryFolder folder;
  put_file(folder / "a", "earlier");
  {
    AtomicFile file(folder / "a");
    file.write("half");
    CHECK(get_file(folder / "a") == "earlier");
    CHECK(folder.entry_count() == 2);
  }
  CHECK(get_file(folder / "a") == "earlier");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a link stays a link") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "far");
  put_file(folder / "far" / "a", "earlier");
  fs::create_symlink("far/a", folder / "link");
  write_file_atomically(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(get_file(folder / "far" / "a") == "new");
}

TEST_CASE("a failing write is an error that names the file") {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {  // with a limit on the size of files, which only the child must have
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto error = error_of([&] { write_file_atomically(folder / "big", std::string(5000, 'x')); });
    ::_exit(error && error->code() == ErrorCode::write_failed && mentions(error, "big") ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("what a killed process left is removed by the next one, other files are not") {
  const TemporaryFolder folder;
  put_file(folder / ".intarsia-notes", "mine");
  put_file(folder / (".intarsia-new-" + std::string(16, '0') + "-" + std::string(8, '0') + "-1-0"), "elsewhere");
  in_killed_process([&] { (new AtomicFile(folder / "a"))->write("half"); });
  in_killed_process([&] { (new AtomicFile(folder / "b"))->write("half"); });
  CHECK(folder.entry_count() == 4);
  write_file_atomically(folder / "a", "whole");
  CHECK(folder.entry_count() == 4);  // the leftover of "b" waits for the next "b"
  CHECK(get_file(folder / "a") == "whole");
  CHECK(get_file(folder / ".intarsia-notes") == "mine");
}

TEST_CASE("names of temporaries tell owner and target") {
  const fs::path target = "/some/where/out";
  const std::string own = temporary_name(Temporary::new_result, target);
  CHECK(own != temporary_name(Temporary::new_result, target));
  CHECK(is_temporary_name(own));
  CHECK_FALSE(is_temporary_name(".intarsia-notes"));
  CHECK_FALSE(is_abandoned(own, Temporary::new_result, target));  // this process lives
  std::string dead = own;
  const pid_t gone = in_killed_process([] {});
  dead.replace(dead.find(std::to_string(::getpid()), 40), std::to_string(::getpid()).size(), std::to_string(gone));
  CHECK(is_abandoned(dead, Temporary::new_result, target));
  CHECK_FALSE(is_abandoned(dead, Temporary::old_result, target));
  CHECK_FALSE(is_abandoned(dead, Temporary::new_result, "/some/where/else"));
  CHECK_FALSE(is_abandoned(own.substr(0, 44), Temporary::new_result, target));
  CHECK(own.size() < 80);
}
