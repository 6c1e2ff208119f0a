// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>

namespace vericone::guidance {

struct Minimum {
  double x = 0, value = 0;
};

/// Brent's minimisation (1973, chapter 5) of a function with one minimum in [low, high], from a point within
/// of known value: parabolas through the three best points, golden sections where these do not help. To
/// `tolerance` in x, in some 6 to 10 evaluations; the best point seen is returned whatever the function.
/// Without parabolas for functions that jump.
template <typename Function>
Minimum minimise(const Function& f, double low, double high, Minimum best, double tolerance,
                 bool parabolas = true) {
  constexpr double kGolden = 0.3819660112501051;
  Minimum second = best, third = best;
  double step = 0, before = 0;
  for (int evaluation = 0; evaluation < 60; ++evaluation) {
    const double middle = 0.5 * (low + high);
    if (std::abs(best.x - middle) <= 2 * tolerance - 0.5 * (high - low)) break;
    bool golden = true;
    if (parabolas && std::abs(before) > tolerance) {
      const double r = (best.x - second.x) * (best.value - third.value);
      double q = (best.x - third.x) * (best.value - second.value);
      double p = (best.x - third.x) * q - (best.x - second.x) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = std::abs(q);
      if (std::abs(p) < std::abs(0.5 * q * before) && p > q * (low - best.x) && p < q * (high - best.x)) {
        before = step;
        step = p / q;
        const double x = best.x + step;
        if (x - low < 2 * tolerance || high - x < 2 * tolerance)
          step = std::copysign(tolerance, middle - best.x);
        golden = false;
      }
    }
    if (golden) {
      before = (best.x < middle ? high : low) - best.x;
      step = kGolden * before;
    }
    if (std::abs(step) < tolerance) step = std::copysign(tolerance, step);
    const Minimum next{best.x + step, f(best.x + step)};
    if (next.value <= best.value) {
      (next.x < best.x ? high : low) = best.x;
      third = std::exchange(second, std::exchange(best, next));
    } else {
      (next.x < best.x ? low : high) = next.x;
      if (next.value <= second.value || second.x == best.x) {
        third = std::exchange(second, next);
      } else if (next.value <= third.value || third.x == best.x || third.x == second.x) {
        third = next;
      }
    }
  }
  return best;
}

}  // namespace vericone::guidance
