#include "engine/base/error.h"

namespace intarsia {

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_argument: return "bad_argument";
    case ErrorCode::bad_file: return "bad_file";
    case ErrorCode::rejected: return "rejected";
    case ErrorCode::too_large: return "too_large";
    case ErrorCode::numeric: return "numeric";
    case ErrorCode::no_memory: return "no_memory";
    case ErrorCode::out_of_time: return "out_of_time";
    case ErrorCode::write_failed: return "write_failed";
    case ErrorCode::cancelled: return "cancelled";
    case ErrorCode::internal: return "internal";
  }
  return "internal";
}

}  // namespace intarsia
