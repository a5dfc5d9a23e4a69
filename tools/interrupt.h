// Ctrl-C and polite termination set a flag that every stage polls; a second one ends the process at once.
#pragma once

#include <atomic>

namespace intarsia::tools {

// Installs the handlers for SIGINT and SIGTERM and returns the flag they set.
std::atomic<bool>& interrupt_flag();

}  // namespace intarsia::tools
