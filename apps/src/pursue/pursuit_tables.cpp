// SPDX-License-Identifier: BSD-3-Clause
#include "pursue/pursuit_tables.h"

#include <vericone/guidance/kinematics.h>
#include <cmath>
#include <limits>

#include "simulate/csv_row.h"

namespace vericone::pursuit {
namespace {

using Eigen::Vector2d;
using scenario::CsvRow;
using namespace vision;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

CsvRow& vector(CsvRow& row, const Vector2d& v) { return row.number(v.x()).number(v.y()); }
CsvRow& box(CsvRow& row, const vision::Box& b) { return row.number(b.x).number(b.y).number(b.w).number(b.h); }

/// r, theta, V_r and V_theta of a point against the UAS.
void engagement(CsvRow& row, const simulation::Motion& own, const Vector2d& position,
                const Vector2d& velocity) {
  const Vector2d from = position - own.position.head<2>();
  const double r = from.norm();
  row.number(r);
  if (!(r > 0)) {
    row.empty(3);
    return;
  }
  const Vector2d along = from / r, relative = velocity - own.velocity.head<2>();
  row.number(std::atan2(from.y(), from.x()))
      .number(relative.dot(along))
      .number(relative.dot(Vector2d(-along.y(), along.x())));
}

}  // namespace

std::string uas_csv(const PursuitRun& run) {
  std::string table =
      "t [s],x [m],y [m],z [m],v_x [m/s],v_y [m/s],v_z [m/s],speed [m/s],heading [rad],a_lat [m/s^2],a_long "
      "[m/s^2],"
      "a_z [m/s^2],y_1,y_1_true,y_2,y_2_true,layer,P [1],y_low,y_high,m [m],x_S [px],x_C [px],mode,"
      "a [m],b [m],angle [rad],c_x [m],c_y [m],F1_x [m],F1_y [m],F2_x [m],F2_y [m],F1_speed [m/s],F1_heading "
      "[rad],"
      "F2_speed [m/s],F2_heading [rad],r_c [m],a_true [m],b_true [m]\n";
  for (const PursuitSample& s : run.samples) {
    CsvRow row(table);
    const Vector2d v = s.uas.velocity.head<2>();
    row.number(s.t)
        .vector(s.uas.position)
        .vector(s.uas.velocity)
        .number(v.norm())
        .number(std::atan2(v.y(), v.x()));
    row.number(s.lateral).number(s.longitudinal).number(s.acceleration.z());
    row.number(s.y1).number(s.true_y1).number(s.y2).number(s.true_y2).number(s.layer);
    row.number(s.probability)
        .number(s.y_low)
        .number(s.y_high)
        .number(s.m)
        .number(s.size)
        .number(s.off_centre);
    row.text(guidance::to_string(s.mode));
    row.number(s.ellipse.a).number(s.ellipse.b).number(s.ellipse.angle);
    vector(row, s.ellipse.centre);
    for (const Vector2d& focus : s.ellipse.foci) vector(row, focus);
    for (const Vector2d& rate : s.ellipse.foci_rates)
      row.number(rate.norm()).number(std::atan2(rate.y(), rate.x()));
    row.number((s.true_ellipse.centre - s.uas.position.head<2>()).norm());
    row.number(s.true_ellipse.a).number(s.true_ellipse.b);
  }
  return table;
}

std::string cars_csv(const Pursuit& pursuit, const PursuitRun& run) {
  std::string table =
      "t [s],body,x [m],y [m],v_x [m/s],v_y [m/s],r [m],theta [rad],V_r [m/s],V_theta [m/s],"
      "x_est [m],y_est [m],v_x_est [m/s],v_y_est [m/s],a_x_est [m/s^2],a_y_est [m/s^2],sigma [m],"
      "r_est [m],theta_est [rad],V_r_est [m/s],V_theta_est [m/s],x_meas [m],y_meas [m],r_meas [m],theta_meas "
      "[rad],"
      "status,occlusion,visible,confidence,box_x [px],box_y [px],box_w [px],box_h [px],"
      "true_x [px],true_y [px],true_w [px],true_h [px]\n";
  std::vector<std::string> names;
  for (const Car& car : pursuit.cars)
    if (car.followed) names.push_back(car.name);
  for (const PursuitSample& s : run.samples)
    for (std::size_t k = 0; k < s.cars.size(); ++k) {
      const CarSample& car = s.cars[k];
      const auto& x = car.belief.mean;
      const Vector2d place(x[0], x[3]), velocity(x[1], x[4]);
      CsvRow row(table);
      row.number(s.t).text(names[k]);
      vector(row, car.truth.position);
      vector(row, car.truth.velocity);
      engagement(row, s.uas, car.truth.position, car.truth.velocity);
      vector(row, place);
      vector(row, velocity);
      row.number(x[2]).number(x[5]);
      row.number(std::sqrt(std::max(car.belief.covariance(0, 0), car.belief.covariance(3, 3))));
      engagement(row, s.uas, place, velocity);
      if (car.measured) {
        vector(row, *car.measured);
        const Vector2d from = *car.measured - s.uas.position.head<2>();
        row.number(from.norm()).number(std::atan2(from.y(), from.x()));
      } else {
        row.empty(4);
      }
      if (pursuit.eyes == Eyes::exact) {
        row.empty(12);
        continue;
      }
      row.text(to_string(car.sighting.sight)).number(double(car.sighting.sight)).number(car.seen.visible);
      row.number(car.sighting.confidence);
      box(row, car.sighting.box);
      box(row, car.seen.box);
    }
  return table;
}

std::string own_csv(const PursuitRun& run) {
  std::string table = "frame,t [s],x [m],y [m],z [m],r_11,r_12,r_13,r_21,r_22,r_23,r_31,r_32,r_33\n";
  std::size_t frame = 0;
  for (const PursuitSample& s : run.samples) {
    CsvRow row(table);
    row.number(double(frame++)).number(s.camera_time).vector(s.camera.position);
    for (int i = 0; i < 3; ++i) row.vector(s.camera.rotation.row(i).transpose());
  }
  return table;
}

std::string estimates_header() {
  return "frame,t [s],target,status,confidence,x [m],v_x [m/s],a_x [m/s^2],y [m],v_y [m/s],a_y "
         "[m/s^2],sigma_x [m],"
         "sigma_y [m],sigma_v_x [m/s],sigma_v_y [m/s]\n";
}

std::string estimates_csv(std::size_t frame, double t, const std::vector<Followed>& vehicles) {
  std::string table;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    const Followed& one = vehicles[i];
    const guidance::Belief<6>& belief = one.filter.belief();
    CsvRow row(table);
    row.number(double(frame)).number(t).number(double(i)).text(to_string(one.sighting.sight));
    row.number(one.sighting.confidence);
    for (int j = 0; j < 6; ++j) row.number(belief.mean[j]);
    for (const int j : {0, 3, 1, 4}) row.number(std::sqrt(belief.covariance(j, j)));
  }
  return table;
}

std::string times_csv(const PursuitRun& run) {
  std::string table = "t [s],controller [ms],ellipse [ms],filter [ms],tracker [ms],total [ms]\n";
  for (const PursuitSample& s : run.samples) {
    CsvRow row(table);
    row.number(s.t).number(1e3 * s.controller).number(1e3 * s.ellipse_seconds).number(1e3 * s.filter);
    row.number(1e3 * s.tracker).number(1e3 * (s.controller + s.ellipse_seconds + s.filter + s.tracker));
  }
  return table;
}

std::string truth_csv(const PursuitRun& run) {
  std::string table = "frame,id,x [px],y [px],w [px],h [px],visible [1]\n";
  for (std::size_t frame = 0; frame < run.samples.size(); ++frame)
    for (std::size_t k = 0; k < run.samples[frame].cars.size(); ++k) {
      const VehicleTruth& seen = run.samples[frame].cars[k].seen;
      CsvRow row(table);
      row.number(double(frame + 1)).number(double(k + 1));
      box(row, seen.box).number(seen.visible);
    }
  return table;
}

std::string hidden_csv(const Pursuit& pursuit, const PursuitRun& run) {
  std::string table = "body,from [s],to [s],said [s],regained [s]\n";
  std::vector<std::string> names;
  for (const Car& car : pursuit.cars)
    if (car.followed) names.push_back(car.name);
  for (const HiddenTime& hidden : run.hidden)
    CsvRow(table)
        .text(names[hidden.car])
        .number(hidden.from)
        .number(hidden.to < 0 ? kNothing : hidden.to)
        .number(hidden.said.value_or(kNothing))
        .number(hidden.regained.value_or(kNothing));
  return table;
}

}  // namespace vericone::pursuit
