// SPDX-License-Identifier: BSD-3-Clause
//
// A quadrotor in moving air. Level, with its thrust equal to its weight, m v' = D (w - v) along each of its
// axes.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <vericone/simulation/vehicle.h>
#include <vericone/vehicles/quadrotor.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace vericone::vehicles::wind_test {
namespace {

using Eigen::Vector3d;
using simulation::Current, simulation::Curve, simulation::Gusts, simulation::Motion, simulation::Shear;

QuadrotorOptions with_drag() {
  QuadrotorOptions options;
  options.drag = {0.9, 1.7, 0.4};
  return options;
}

std::vector<Curve> drift(const QuadrotorOptions& options, const Motion& start, const Current& air,
                         double seconds) {
  const auto model = quadrotor(options);
  const auto vehicle = model->launch(start, 0, air);
  std::vector<Curve> way;
  vehicle->advance({}, 0, seconds, way);
  return way;
}

TEST(Quadrotor, WindCarriesIt) {
  const QuadrotorOptions options = with_drag();
  const Vector3d wind(5, -3, 0.7);
  for (const double yaw : {0.0, 0.8}) {
    Motion start;
    start.rotation = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d w = start.rotation.transpose() * wind;
    // Between the ends of the curves too, on which proofs stand.
    for (const Curve& curve : drift(options, start, Current(wind), 8))
      for (const double part : {0.0, 0.3, 0.5, 1.0}) {
        const double t = curve.from() + part * (curve.to() - curve.from());
        const Motion now = curve.at(t);
        const Vector3d rate = options.drag / options.mass, gone = (-t * rate).array().exp();
        const Vector3d v = w.cwiseProduct(Vector3d::Ones() - gone), x = t * w - v.cwiseQuotient(rate);
        ASSERT_NEAR((now.velocity - start.rotation * v).norm(), 0, 1e-9) << t;
        ASSERT_NEAR((now.position - start.rotation * x).norm(), 0, 1e-9) << t;
        ASSERT_NEAR((now.rotation - start.rotation).norm(), 0, 1e-12) << t;
      }
  }
}

/// v(T) is the integral of k exp(-k (T - t)) w(t), here by Simpson's rule.
TEST(Quadrotor, GustsCarryIt) {
  const QuadrotorOptions options = with_drag();
  const Current air({1, 0, 0}, {}, {.most = 6, .shortest = 0.5, .longest = 4, .seed = 7});
  const Vector3d rate = options.drag / options.mass;
  const double seconds = 6;
  const Vector3d v = drift(options, {}, air, seconds).back().at(seconds).velocity;
  const int pieces = 200'000;
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i <= pieces; ++i) {
    const double t = seconds * i / pieces, weight = i == 0 || i == pieces ? 1 : i % 2 ? 4 : 2;
    const Vector3d kept = ((t - seconds) * rate).array().exp();
    sum += weight * rate.cwiseProduct(kept).cwiseProduct(air.velocity(0, t));
  }
  EXPECT_NEAR((v - seconds / (3 * pieces) * sum).norm(), 0, 1e-8);
  EXPECT_GT(v.norm(), 0.5);
}

/// The proof is of the flight in the wind, between the commands too.
TEST(Quadrotor, WindIsProvedToCarryItIntoABall) {
  const double wind = 4, radius = 0.5, reach = 0.3, place = 6;
  for (const double speed : {0.0, wind}) {
    simulation::Scenario scenario;
    scenario.duration = 12;
    scenario.step = 0.5;
    scenario.water = Current({speed, 0, 0});
    const auto ball = [](const char* name, double r, const Vector3d& at) {
      simulation::Body body;
      body.name = name;
      body.shape =
          simulation::RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {r, r, r}))};
      body.start.position = at;
      return body;
    };
    scenario.bodies = {ball("D", reach, {0, 0, 0}), ball("B", radius, {place, 0, 0})};
    scenario.bodies[0].vehicle = quadrotor(with_drag());
    scenario.bodies[1].start.velocity = {0, 1e-9, 0};
    const simulation::Run run = simulate(scenario);
    ASSERT_EQ(run.proofs.size(), 1u);
    const simulation::PairProof& proof = run.proofs[0].proof;
    if (speed == 0) {
      EXPECT_EQ(proof.verdict, simulation::ProofVerdict::avoided);
      EXPECT_NEAR(proof.least_distance, place - radius - reach, 0.06);
      continue;
    }
    ASSERT_EQ(proof.verdict, simulation::ProofVerdict::touched);
    const double k = with_drag().drag.x() / with_drag().mass;
    const auto gone = [&](double t) { return wind * (t + std::expm1(-k * t) / k); };
    EXPECT_NEAR(gone(proof.to), place - radius - reach, 1e-5);
    EXPECT_LE(gone(proof.from), place - radius - reach);
  }
}

TEST(Quadrotor, NoWindWithoutDrag) {
  const auto refused = [](const QuadrotorOptions& options, const Current& air) -> std::string {
    try {
      static_cast<void>(quadrotor(options)->launch({}, 0, air));
    } catch (const InputError& e) {
      return e.field() + ": " + e.value();
    }
    return "";
  };
  EXPECT_EQ(refused({}, {}), "");
  for (const Current& air :
       {Current({0, 1, 0}), Current({}, Shear{{0, 0.1}, 0}), Current({}, {}, Gusts{.most = 1})})
    EXPECT_EQ(refused({}, air), "vehicle: a quadrotor without drag, which no current moves");
  EXPECT_EQ(refused(with_drag(), Current({}, {}, {.most = 1, .shortest = 0.05})),
            "vehicle: a period of 0.01 s");
  QuadrotorOptions options;
  options.drag.y() = -1;
  EXPECT_THROW(check(options), InputError);
  EXPECT_FALSE(quadrotor({})->carried());
  EXPECT_TRUE(quadrotor(with_drag())->carried());
}

}  // namespace
}  // namespace vericone::vehicles::wind_test
