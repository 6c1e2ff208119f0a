// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/vision/pursuit/pursuit.h>
#include <algorithm>
#include <cmath>
#include <string>

namespace vericone::vision {

PursuitSummary summarise(const Pursuit& pursuit, const PursuitRun& run) {
  const auto followed = static_cast<std::size_t>(std::ranges::count_if(pursuit.cars, &Car::followed));
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    if (run.samples[i].cars.size() < followed)
      throw InputError("run.samples[" + std::to_string(i) + "].cars",
                       std::to_string(run.samples[i].cars.size()),
                       "those that are followed, " + std::to_string(followed));
  PursuitSummary summary;
  const View& view = pursuit.eyes == Eyes::source ? pursuit.source_view : pursuit.perspective_view;
  summary.layer_share = run.layer_share;
  double count = 0;
  for (const PursuitSample& sample : run.samples) {
    if (sample.t < run.end / 3) continue;
    const double r = (sample.true_ellipse.centre - sample.uas.position.head<2>()).norm();
    summary.mean_distance += r;
    summary.most_distance = std::max(summary.most_distance, r);
    summary.mean_speed_error += (sample.true_ellipse.centre_rate - sample.uas.velocity.head<2>()).norm();
    ++count;
  }
  if (count > 0) {
    summary.mean_distance /= count;
    summary.mean_speed_error /= count;
  }
  std::size_t k = 0;
  for (const Car& car : pursuit.cars) {
    if (!car.followed) continue;
    CarSummary one{car.name};
    double pixels = 0, metres = 0, measured = 0;
    for (const PursuitSample& sample : run.samples) {
      const CarSample& c = sample.cars[k];
      const Eigen::Vector2d believed(c.belief.mean[0], c.belief.mean[3]);
      one.in_view = view.camera.sees(c.seen.box.centre());
      constexpr double kEnough = 0.9;  // visible part: a vehicle that is hidden is not lost yet
      if (c.seen.visible >= kEnough)
        one.followed = c.sighting.measured && overlap(c.sighting.box, c.seen.box) > 0;
      if (!c.sighting.measured) continue;
      ++measured;
      pixels += (c.sighting.box.centre() - c.seen.box.centre()).squaredNorm();
      metres += (believed - c.truth.position).squaredNorm();
      const bool own = overlap(c.sighting.box, c.seen.box) > 0;
      one.false_claims += !own;
      one.swaps += !own && overlap(c.sighting.box, c.other) > 0;
    }
    if (measured > 0) {
      one.pixels_rms = std::sqrt(pixels / measured);
      one.error_rms = std::sqrt(metres / measured);
    }
    summary.cars.push_back(one);
    ++k;
  }
  return summary;
}

}  // namespace vericone::vision
