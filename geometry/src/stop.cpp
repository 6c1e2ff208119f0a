// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>

namespace vericone {
namespace {

constinit thread_local const Stop* innermost = nullptr;

}  // namespace

StopScope::StopScope(const Stop* stop) noexcept : outer_(innermost) { innermost = stop; }
StopScope::~StopScope() { innermost = outer_; }

const Stop* stop_of_this_thread() noexcept { return innermost; }
bool stop_requested() noexcept { return innermost && innermost->requested(); }

void checkpoint() {
  if (stop_requested()) throw Interrupted{};
}

}  // namespace vericone
