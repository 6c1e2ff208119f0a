// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone::guidance {

/// Counts what the gate refuses. A filter that refuses this many measurements one after another has lost what
/// it follows, and starts again from the last.
class Gate {
 public:
  explicit Gate(double most_nis, int patience = 5) : most_(most_nis), patience_(patience) {}
  [[nodiscard]] double most() const { return most_; }  // standard deviations, squared
  /// Whether to start again.
  bool lost(bool accepted) {
    refused_ = accepted ? 0 : refused_ + 1;
    if (refused_ < patience_) return false;
    refused_ = 0;
    return true;
  }

 private:
  double most_;
  int patience_, refused_ = 0;
};

}  // namespace vericone::guidance
