// Error codes to exit statuses, in one place (docs/formats.md lists them for users).
#pragma once

#include "engine/base/error.h"

namespace intarsia::tools {

enum ExitCode : int {
  kExitDone = 0,
  kExitInternal = 1,
  kExitUsage = 2,
  kExitUnreadable = 3,
  kExitRejected = 4,
  kExitDegraded = 5,
  kExitLimit = 6,
  kExitWrite = 7,
  kExitBatch = 8,
  kExitInterrupted = 130,
};

inline int exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_argument:
      return kExitUsage;
    case ErrorCode::bad_file:
      return kExitUnreadable;
    case ErrorCode::rejected:
      return kExitRejected;
    case ErrorCode::too_large:
    case ErrorCode::no_memory:
    case ErrorCode::out_of_time:
      return kExitLimit;
    case ErrorCode::write_failed:
      return kExitWrite;
    case ErrorCode::cancelled:
      return kExitInterrupted;
    case ErrorCode::numeric:
    case ErrorCode::internal:
      return kExitInternal;
  }
  return kExitInternal;
}

}  // namespace intarsia::tools
