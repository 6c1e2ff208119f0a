// SPDX-License-Identifier: BSD-3-Clause
#include "interrupt.h"

#include <csignal>
#include <cstdlib>

namespace vericone {
namespace {

volatile std::sig_atomic_t flag = 0;

extern "C" void set_flag(int signal) {
  if (flag) std::_Exit(128 + signal);
  flag = 1;
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, set_flag);
  std::signal(SIGTERM, set_flag);
}

bool interrupted() { return flag != 0; }

}  // namespace vericone
