// SPDX-License-Identifier: BSD-3-Clause
//
// What the environment asks of the tests: VERICONE_CAMPAIGN=long makes of a test its long campaign, and the
// numbers VERICONE_SEED and VERICONE_CASES replace a test's own.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace vericone::testing {

inline bool long_campaign() {
  const char* given = std::getenv("VERICONE_CAMPAIGN");
  return given && std::string_view(given) == "long";
}

/// The size of the long campaign there, else the usual one.
template <typename Size>
Size campaign_size(Size usual, Size in_campaign) {
  return long_campaign() ? in_campaign : usual;
}

/// What ./check runs of n cases: a quarter. The long campaign runs them all.
constexpr int kShare = 4;
inline int share(int n) { return campaign_size((n + kShare - 1) / kShare, n); }

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given ? std::strtoull(given, nullptr, 10) : otherwise;
}

}  // namespace vericone::testing
