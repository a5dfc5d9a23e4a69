#include "tools/interrupt.h"

#include <csignal>

#include <unistd.h>

#include "tools/exit_code.h"

namespace intarsia::tools {
namespace {

std::atomic<bool> interrupted{false};

void on_signal(int) {
  if (interrupted.exchange(true)) _exit(kExitInterrupted);
}

}  // namespace

std::atomic<bool>& interrupt_flag() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

}  // namespace intarsia::tools
