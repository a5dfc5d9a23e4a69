// Runs the program and keeps what it prints.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace intarsia::test {

// A folder of its own, removed at the end.
class ProgramFolder {
 public:
  explicit ProgramFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("intarsia-" + name + "-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ProgramFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ProgramFolder(const ProgramFolder&) = delete;
  ProgramFolder& operator=(const ProgramFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct ProgramResult {
  int status = 0;
  std::string out, err;
};

// Starts the program and returns its process; what it prints goes to two files.
inline pid_t start_program(const char* program, const std::vector<std::string>& arguments, const std::string& out,
                           const std::string& err) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  std::vector<char*> argv{const_cast<char*>(program)};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  if (!std::freopen(out.c_str(), "w", stdout) || !std::freopen(err.c_str(), "w", stderr)) _exit(99);
  execv(program, argv.data());
  _exit(98);
}

// Its exit status, or minus the signal that ended it.
inline int finish_program(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline ProgramResult run_program(const char* program, const std::vector<std::string>& arguments,
                                 const ProgramFolder& folder) {
  const std::string out = folder / "stdout.txt", err = folder / "stderr.txt";
  const int status = finish_program(start_program(program, arguments, out, err));
  return {status, file_text(out), file_text(err)};
}

}  // namespace intarsia::test
