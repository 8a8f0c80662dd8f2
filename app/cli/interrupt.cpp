#include "interrupt.h"

#include <csignal>

namespace etendue::cli {
namespace {

std::atomic<bool> interrupt_requested{false};

void on_interrupt(int signal) {
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& watch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return interrupt_requested;
}

}  // namespace etendue::cli
