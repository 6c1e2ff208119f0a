// SPDX-License-Identifier: BSD-3-Clause
#include "swim.h"
#include <vericone/internal/vehicles/fish_water.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <utility>

namespace vericone::vehicles {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using simulation::Curve;
using simulation::Jet;

// The gas is counted in cm^3: its errors are then of the size of the others.
constexpr double kGas = 1e6;

using Numbers = std::array<double, 9>;

Numbers numbers(const FishState& s) {
  return {s.position.x(), s.position.y(), s.position.z(), s.heading, s.u, s.v, s.r, s.w, s.gas * kGas};
}

FishState state_of(const Numbers& x) {
  return {{x[0], x[1], x[2]}, x[3], x[4], x[5], x[6], x[7], x[8] / kGas};
}

struct Equations {
  const FishParameters& fish;
  const TailDrive& tail;
  double gas_rate;
  const Surroundings& around;

  FishState at(const FishState& state, double t) const {
    return fish_rates(fish, state, tail.at(t), gas_rate, around.surface, around.water, t);
  }
  void operator()(const Numbers& x, Numbers& rate, double t) const { rate = numbers(at(state_of(x), t)); }

  Jet position(const FishState& state, double t) const {
    const FishState rate = at(state, t);
    const double c = std::cos(state.heading), s = std::sin(state.heading);
    const double ahead = rate.u - state.r * state.v, left = rate.v + state.r * state.u;
    const Vector3d water = around.water.acceleration(t) + rate.position.z() * around.water.gradient();
    return {state.position, rate.position,
            Vector3d(ahead * c - left * s, ahead * s + left * c, rate.w) + water};
  }
  Jet turned(const FishState& state, double t) const {
    return {{0, 0, state.heading}, {0, 0, state.r}, {0, 0, at(state, t).r}};
  }
};

}  // namespace

void swim(const FishParameters& fish, FishState& state, const TailDrive& tail, double gas_rate,
          const Surroundings& around, double from, double to, double longest,
          const std::function<void(const FishState&, const Curve&)>& seen) {
  using namespace boost::numeric::odeint;
  // A shorter step is taken as it comes: the error there is that of a kink of |v_t|, some 1e-9.
  constexpr double kShortest = 1e-4;
  auto controlled = make_controlled<runge_kutta_dopri5<Numbers>>(1e-11, 1e-11);
  runge_kutta_dopri5<Numbers> plain;
  double t = from, wanted = longest;
  while (t < to) {
    const bool last = to - t <= wanted * (1 + 1e-9);
    const double h = last ? to - t : wanted;
    // The valve lets out no more than there is.
    const Equations equations{fish, tail, std::max(gas_rate, -state.gas / h), around};
    Numbers x = numbers(state);
    if (h <= 1.5 * kShortest) {
      plain.do_step(equations, x, t, h);
    } else {
      double time = t, step = h;
      controlled.reset();  // the rate of gas, and so the derivative, may be another
      const bool done = controlled.try_step(equations, x, time, step) == success;
      wanted = std::clamp(step, kShortest, longest);
      if (!done) continue;
    }
    const FishState before = state;
    const double begin = std::exchange(t, last ? to : t + h);
    state = state_of(x);
    state.gas = std::clamp(state.gas, 0.0, most_gas(fish, depth_of(state, around.surface)));
    const Curve curve(
        simulation::quintic(equations.position(before, begin), equations.position(state, t), t - begin),
        simulation::quintic(equations.turned(before, begin), equations.turned(state, t), t - begin),
        Matrix3d::Identity(), begin, t);
    seen(state, curve);
  }
}

void foresee(const FishParameters& fish, FishState& state, const TailDrive& tail, double from, double to,
             double step, const std::function<void(const FishState&, double t)>& seen) {
  const Surroundings still{state.position.z(), {}};
  boost::numeric::odeint::runge_kutta4<Numbers> stepper;
  const Equations equations{fish, tail, 0, still};
  Numbers x = numbers(state);
  const long steps = std::max(1L, std::lround((to - from) / step));
  for (long k = 0; k < steps; ++k) {
    const double t = from + (to - from) * double(k) / double(steps);
    stepper.do_step(equations, x, t, (to - from) / double(steps));
    state = state_of(x);
    seen(state, from + (to - from) * double(k + 1) / double(steps));
  }
}

}  // namespace vericone::vehicles
