// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vericone {

/// An input that no answer exists for. Beside it the library throws std::system_error where a file cannot be
/// written, and Interrupted where it was asked to stop.
///
/// `what()` is one line, "FIELD: got VALUE, must be REQUIREMENT", for example
/// "obstacle.semi_axes[1]: got -2, must be a positive finite number". Overlapping bodies, grazing
/// velocities and receding bodies are answers; only what has no value for them, as the edges of a cone,
/// throws.
class InputError : public std::invalid_argument {
 public:
  InputError(std::string field, std::string value, std::string requirement);

  [[nodiscard]] const std::string& field() const { return field_; }
  [[nodiscard]] const std::string& value() const { return value_; }
  [[nodiscard]] const std::string& requirement() const { return requirement_; }

  /// The same error with `prefix` before the field: "semi_axes[1]" becomes "obstacle.semi_axes[1]".
  [[nodiscard]] InputError within(std::string_view prefix) const;

 private:
  std::string field_, value_, requirement_;
};

/// Shortest decimal text that reads back as `x`; "nan", "inf", "-inf" otherwise.
[[nodiscard]] std::string to_text(double x);

// Ending long work early. Whoever calls holds a Stop and says so with a StopScope; whatever the library then
// does on that thread, and on the threads that it starts for it, looks at checkpoints whether it was asked to
// end. Another thread, or a handler of signals, asks. Functions without long work have no checkpoints.

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
