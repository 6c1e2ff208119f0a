// SPDX-License-Identifier: BSD-3-Clause
//
// A UAS that follows vehicles by what its camera sees, from pixels to thrust (source, chapters 3 and 4).
#pragma once

#include <vericone/guidance/pursuit/pursuit_law.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/simulation/run.h>
#include <vericone/vision/pursuit/perception.h>
#include <vericone/vision/scene/scene.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::vision {

/// A vehicle on the ground. Those that are not followed are decoys.
struct Car {
  std::string name;
  std::shared_ptr<const simulation::Road> road;
  VehicleLook look;
  bool followed = true;
};

/// Bars that hide what they cover, and stand again ahead of the UAS once they have left its picture
/// (errata 4.3).
struct FlyingBars {
  int count = 0;
  Eigen::Vector2d size = Eigen::Vector2d(15, 0);  // m, along x and y; 0 along y: all of the picture
  double height = 0;                              // m above the ground
  double from = 0;                                // s, when they begin
};

/// A camera, how it is carried, and what its pictures are like.
struct View {
  Camera camera;
  MountOptions mount;
  SceneOptions scene;  // its vehicles are those of the pursuit
  FlyingBars bars;
  double height = 0;   // m, of the middle of a vehicle, as the perception takes it
  double latency = 0;  // s, so old is a picture when it is seen
};

enum class Eyes : std::uint8_t {
  exact,        // no pictures: positions, velocities and accelerations as they are
  source,       // the source's camera: straight down, north up, whatever the attitude; clean; flat vehicles
  perspective,  // a real one
};
[[nodiscard]] const char* to_string(Eyes eyes);
enum class Whose : std::uint8_t { source, ours };
[[nodiscard]] const char* to_string(Whose whose);

/// What the source flies by: (3.7)-(3.8) of one vehicle, or (4.14)-(4.16) of the foci of all.
enum class SourceLaw : std::uint8_t { rendezvous, focal };

struct Pursuit {
  std::string name;
  double duration = 60;        // s
  double step = 0.01;          // s, between two commands
  double picture_step = 0.04;  // s, between two pictures; a whole number of steps
  simulation::Motion start;    // of the UAS
  double radius = 0.3;         // m, of the ball about it that proofs take for it
  /// A point mass that turns with its heading, at a constant altitude, where there is none.
  std::shared_ptr<const simulation::VehicleModel> vehicle;
  /// A point mass steps as the source's simulator does: the new velocity moves it for the whole step.
  bool source_steps = false;
  std::vector<Car> cars;
  View source_view, perspective_view;
  Eyes eyes = Eyes::perspective;
  Whose tracker = Whose::ours, law = Whose::ours;
  SourceLaw source_law = SourceLaw::focal;
  guidance::FocalForm form = guidance::FocalForm::source;
  guidance::RendezvousGains rendezvous;
  guidance::FocalGains focal;
  guidance::PursuitGains ours;
  std::optional<guidance::VerticalGains> vertical;  // none: the altitude is kept
  guidance::SingerOptions source_filter;
  double noise = 1, hidden_noise = 10;  // m^2, of the source's filters
  guidance::SingerOptions our_filter{.alpha = 0.2, .variance = {0.5, 0.5}};
  double own_noise = 0.03;  // m, of ours: PerceptionOptions::own_noise
  double side = 8;          // m, of the square around every vehicle
  double give_up = 10;      // s that a vehicle is hidden, until it is left out of the ellipse
  std::uint64_t seed = 1;
};

/// Of one vehicle, when a picture was taken (with exact eyes: every picture_step).
struct CarSample {
  simulation::RoadPoint truth;
  guidance::Belief<6> belief;               // of the time of the picture
  std::optional<Eigen::Vector2d> measured;  // m
  Sighting sighting;
  VehicleTruth seen;  // in the picture
  Box other;          // the true box of another car that the sighting's box meets best
};

struct PursuitSample {
  double t = 0;  // s
  simulation::Motion uas;
  Pose camera;                                             // of the picture perceived last ...
  double camera_time = 0;                                  // s, taken then
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // commanded, m/s^2
  double lateral = 0, longitudinal = 0;                    // m/s^2
  guidance::EnclosingEllipse ellipse, true_ellipse;        // believed and true
  double y1 = 0, y2 = 0, true_y1 = 0, true_y2 = 0;         // y_2 m^2/s^2, y_1 in the unit of its law
  double probability = 0, y_low = 0, y_high = 0;           // ours: probability of the cone; y as y_1
  double m = 0;                                            // ours, m
  double size = 0, off_centre = 0;                         // x_S, x_C, px
  guidance::VerticalMode mode = guidance::VerticalMode::size;
  bool layer = false;           // the source's law had no command of its own
  std::vector<CarSample> cars;  // those followed
  // Seconds that the work took: controller, ellipse, filter, tracker.
  double controller = 0, ellipse_seconds = 0, filter = 0, tracker = 0;
};

/// From one picture to the next while a vehicle is hidden.
struct HiddenTime {
  std::size_t car = 0;
  double from = 0, to = 0;         // s: nothing of it could be seen
  std::optional<double> said;      // s, from then until `total` was said
  std::optional<double> regained;  // s, from when it was seen again until its box met it
};

struct PursuitRun {
  std::vector<PursuitSample> samples;
  std::vector<std::vector<double>> vehicle;  // channels of the vehicle, in their units, one a sample
  std::vector<Box> boxes;                    // given to the tracker with the first picture
  std::vector<HiddenTime> hidden;
  double layer_share = 0;  // of the commands, by the boundary layer's law
  double end = 0;          // s
  bool interrupted = false;
};

struct PursuitOptions {
  /// Called with every picture and what was seen in it; sample.cars has the boxes.
  std::function<void(const Image&, const PursuitSample&, const std::vector<Followed>&)> picture;
  /// Called at the end with the whole flight, logged and proved: the UAS, and all cars as boxes, each a body.
  /// Not of `source_steps`.
  std::function<void(const simulation::Scenario&, const simulation::Run&)> flown;
  /// Called with the seconds flown; false ends the run there, `interrupted`.
  std::function<bool(double t)> progress;
};

/// The perception of the pursuit's eyes and tracker.
[[nodiscard]] PerceptionOptions perception_of(const Pursuit& pursuit);

/// Deterministic. Throws InputError naming "picture_step", "cars", "cars[1]" (not in the first picture), ...
[[nodiscard]] PursuitRun pursue(const Pursuit& pursuit, const PursuitOptions& options = {});

/// What an author of a run wants to know of it.
struct CarSummary {
  std::string name;
  double pixels_rms = 0;         // of the box's centre against the true one's, where it says it sees the car
  double error_rms = 0;          // m, of the estimate, where it says so
  std::size_t swaps = 0;         // pictures in which its box met another car and not its own
  std::size_t false_claims = 0;  // pictures in which a measured box met nothing of its car
  bool in_view = false;          // at the end: the middle of its true box is in the picture, hidden or not
  bool followed = false;         // when it was seen last: measured, and its box meets it
};
struct PursuitSummary {
  double mean_distance = 0, most_distance = 0;  // m, to the centre of the true ellipse, last two thirds
  double mean_speed_error = 0;                  // m/s, against the centre's velocity, last two thirds
  double layer_share = 0;                       // part of the commands
  std::vector<CarSummary> cars;
};
[[nodiscard]] PursuitSummary summarise(const Pursuit& pursuit, const PursuitRun& run);

}  // namespace vericone::vision
