// SPDX-License-Identifier: BSD-3-Clause
#include "work/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "work/abandon.h"

namespace vericone {
namespace {

volatile std::sig_atomic_t flag = 0;
std::atomic<bool> ends_itself{false};
std::array<int, 2> wake = {-1, -1};

extern "C" void set_flag(int signal) {
  if (flag) std::_Exit(128 + signal);
  flag = 1;
  // A full pipe wakes as well.
  if (wake[1] >= 0) [[maybe_unused]]
    const ssize_t written = write(wake[1], "x", 1);
}

void end_when_interrupted() {
  char got = 0;
  while (read(wake[0], &got, 1) < 0) {
  }
  constexpr auto kGrace = std::chrono::milliseconds(300);
  std::this_thread::sleep_for(kGrace);
  if (ends_itself) return;
  const std::lock_guard guard(work::appearing());
  work::abandon_output();
  std::_Exit(kExitInterrupted);
}

}  // namespace

void catch_interrupts() {
  if (pipe2(wake.data(), O_CLOEXEC) == 0) std::thread(end_when_interrupted).detach();
  std::signal(SIGINT, set_flag);
  std::signal(SIGTERM, set_flag);
}

bool interrupted() { return flag != 0; }

void end_by_ourselves() { ends_itself = true; }

}  // namespace vericone
