// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests of both predicates of order.h share.
#pragma once

#include <gtest/gtest.h>
#include <vericone/internal/cones/times/order.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <iostream>
#include <string>

namespace vericone::testing {

/// 80 digits.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>, boost::multiprecision::et_off>;

inline Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }
inline Sign as_sign(double x) { return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero; }

/// How many decisions fell on each rung; checks that all rungs that answer agree.
struct Rungs {
  int cases = 0, by[3] = {}, zeros = 0;

  Sign turn(const TangentRef& p, const TangentRef& q) {
    return ask(
        [](const TangentRef& x, const TangentRef& y, Rung* rung) { return vericone::turn(x, y, rung); },
        triage_turn(p, q), interval_turn(p, q), exact_turn(p, q), p, q);
  }
  Sign earlier(const Encounter& p, const Encounter& q) {
    return ask(
        [](const Encounter& x, const Encounter& y, Rung* rung) { return vericone::earlier(x, y, rung); },
        triage_earlier(p, q), interval_earlier(p, q), exact_earlier(p, q), p, q);
  }
  void print(const std::string& what) const {
    std::cout << "[ rungs    ] " << what << ": " << cases << " cases, triage " << by[0] << ", interval "
              << by[1] << ", exact " << by[2] << ", zeros " << zeros << "\n";
  }

 private:
  template <typename Climb, typename Item>
  Sign ask(const Climb& climb, const std::optional<Sign>& triage, const std::optional<Sign>& interval,
           Sign exact, const Item& p, const Item& q) {
    Rung rung = Rung::triage;
    const Sign s = climb(p, q, &rung);
    ++cases;
    ++by[static_cast<int>(rung)];
    zeros += s == Sign::zero;
    EXPECT_EQ(exact, s);
    EXPECT_EQ(triage.value_or(s), s);
    EXPECT_EQ(interval.value_or(s), s);
    EXPECT_EQ(rung == Rung::triage, triage.has_value());
    EXPECT_EQ(rung == Rung::interval, !triage && interval);
    EXPECT_EQ(climb(q, p, nullptr), -s) << "law (1)";
    return s;
  }
};

}  // namespace vericone::testing
