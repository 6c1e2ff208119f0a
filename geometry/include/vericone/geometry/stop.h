// SPDX-License-Identifier: BSD-3-Clause
//
// Ending long work early. Whoever calls holds a Stop and says so with a StopScope; whatever the library then
// does on that thread, and on the threads that it starts for it, looks at checkpoints whether it was asked to
// end. Another thread, or a handler of signals, asks. Functions without long work have no checkpoints.
#pragma once

#include <atomic>

namespace vericone {

/// Thrown by work that was asked to end, by a Stop or by a `progress` that returned false. Like an InputError
/// it leaves nothing behind. It is no error, and so no std::exception: no handler of errors takes it for one.
struct Interrupted {};

/// A request to end. request() may be called from any thread and from a handler of signals.
class Stop {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_ = false;
};

/// While it lives, `stop` ends what this thread does in the library; null: nothing does. Scopes nest; the
/// innermost counts. `stop` must outlive the scope.
class StopScope {
 public:
  explicit StopScope(const Stop* stop) noexcept;
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const Stop* outer_;
};

/// That of the innermost scope of this thread, or null: what a thread that helps this one makes its own scope
/// of.
[[nodiscard]] const Stop* stop_of_this_thread() noexcept;

/// Whether this thread was asked to end. Two loads: long loops ask every hundred microseconds or so, and end
/// within 0.2 s of a request.
[[nodiscard]] bool stop_requested() noexcept;

/// Throws Interrupted where stop_requested().
void checkpoint();

}  // namespace vericone
