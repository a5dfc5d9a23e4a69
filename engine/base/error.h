// The one exception type of the library. The library never prints and never exits: it throws this.
#pragma once

#include <stdexcept>
#include <string>

#include "engine/base/types.h"

namespace intarsia {

// By cause. tools/exit_code.h maps each code to a documented exit status.
enum class ErrorCode {
  bad_argument,   // an option or parameter out of range
  bad_file,       // the file cannot be read as what it claims to be
  rejected,       // readable, but not a surface that the method can take
  too_large,      // a documented size limit is exceeded
  numeric,        // a computation left its domain
  no_memory,      // allocation failed or was refused in advance
  out_of_time,    // the time limit came before there was a result
  write_failed,   // an output could not be written
  cancelled,      // the run was asked to stop
  internal,       // a broken promise of the program itself
};

const char* name_of(ErrorCode code);

// What went wrong, where (stage, element) and, in the message, what the user can do about it.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, Index element = kNone)
      : std::runtime_error(message), code_(code), element_(element) {}

  ErrorCode code() const { return code_; }
  Index element() const { return element_; }  // id in the user's numbering, or kNone
  const std::string& stage() const { return stage_; }
  void set_stage(const std::string& stage) {
    if (stage_.empty()) stage_ = stage;
  }

 private:
  ErrorCode code_;
  Index element_;
  std::string stage_;
};

}  // namespace intarsia
