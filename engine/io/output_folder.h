// A folder of results that is exchanged as a whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace intarsia {

// Results are written into a new folder beside the target. commit() puts it in the target's place in one step
// (renameat2 with RENAME_EXCHANGE; where the file system cannot, two renames, the first of which is undone by the next
// run if the process is killed between them). So there is the old result or the new one, each whole.
//
// Ours are the files whose names the caller lists. Everything else that an existing target folder holds - files of
// other names, and folders of any name - is moved into the new folder and never removed.
//
// All members throw write_failed naming the folder. One process at a time may write to a target; of several, the last
// one wins.
class OutputFolder {
 public:
  // `our_names`: of files, all that any run may ever write; NAME or FOLDER/NAME. A folder of results is exchanged like
  // a file as long as it holds nothing else. Cleans up after killed runs. Errors: the target is a file, the current
  // folder or one above it; its parent is missing or cannot be written.
  OutputFolder(const std::filesystem::path& target, std::vector<std::string> our_names);
  ~OutputFolder();  // without commit(): the new folder is removed, the target is as it was
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Where to write the file of that name until commit(); its folder is there. Requires: one of our_names.
  std::filesystem::path file(const std::string& name) const;
  // The target, absolute.
  const std::filesystem::path& target() const { return target_; }

  void commit();

 private:
  bool is_ours(const std::filesystem::directory_entry& entry) const;
  void recover();
  void exchange();
  void remove_ours(const std::filesystem::path& folder) const;

  std::filesystem::path target_, parent_, fresh_;
  std::vector<std::string> our_names_;
};

}  // namespace intarsia
