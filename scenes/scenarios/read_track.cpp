// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/read_track.h"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "input/field_table.h"
#include "json/plain_text.h"
#include "scenarios/number_table.h"

namespace vericone::scenario {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using input::absent, input::alternative, input::Fields, input::list, input::number, input::positive;
using input::Value;
using simulation::Piecewise, simulation::Trajectory;

enum class Between { linear, hermite };
enum class Facing { fixed, level };

/// [x, y, z], or [x, y] in the plane.
Value<Vector3d> place(const char* unit) {
  return {[words = input::unit_words(unit)](const Json& value, const std::string& path) -> Vector3d {
            if (value.is_array() && value.size() == 2) {
              const Eigen::Vector2d flat = input::read_vector<2>(value, path, words.c_str());
              return {flat.x(), flat.y(), 0};
            }
            return input::read_vector<3>(value, path, words.c_str());
          },
          Json{{"$ref", "body.schema.json#/$defs/point"}, {"unit", unit}},
          {}};
}

Matrix3d rotation_of(double w, double x, double y, double z, const std::string& path) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1) <= 1e-3))
    throw InputError(path, "a quaternion of length " + to_text(q.norm()), "a unit quaternion, within 1e-3");
  return q.normalized().toRotationMatrix();
}

/// A unit quaternion [w, x, y, z].
Value<Matrix3d> quaternion() {
  return {[](const Json& value, const std::string& path) {
            const Eigen::Vector4d q = input::read_vector<4>(value, path, ", a unit quaternion [w, x, y, z]");
            return rotation_of(q(0), q(1), q(2), q(3), path);
          },
          Json{{"$ref", "body.schema.json#/$defs/vector4"}},
          {}};
}

struct TrackFields {
  std::string kind, file, times_file;
  double start = 0;
  std::vector<double> times;
  std::vector<std::vector<Vector3d>> pieces;
  std::vector<Vector3d> points, velocities;
  std::vector<Matrix3d> rotations;
  std::vector<double> knots, yaw;
  double interval = 0, yaw_interval = 0;
  int degree = 3;
  Between between = Between::linear;
  Facing orientation = Facing::fixed;
};

const Fields<TrackFields>& track_fields() {
  using T = TrackFields;
  static const Fields<T> fields =
      Fields<T>("track", "kind")
          .row("kind", &T::kind,
               input::choice<std::string>({{"powers", "powers"},
                                           {"bernstein", "bernstein"},
                                           {"spline", "spline"},
                                           {"poses", "poses"}}),
               "Polynomials by coefficients of powers or by control points, a B-spline, or poses at times.",
               input::required("powers, bernstein, spline or poses"))
          .row("start", &T::start, number("s"), "Is added to all times.")
          .row("file", &T::file, input::file_name(), "A table of numbers in place of the lists, below.",
               alternative())
          .row("times", &T::times, list("times", number("s")), "Of poses; of pieces their ends, one more.",
               alternative())
          .only_of({"powers", "bernstein", "poses"}, "powers, bernstein, poses")
          .row("pieces", &T::pieces, list("pieces", list("vectors", place("m"), 1), 1),
               "Of each its coefficients of 1, s, s², ... (s since the piece began), or its control points.",
               alternative())
          .only_of({"powers", "bernstein"}, "powers, bernstein")
          .row("degree", &T::degree, input::count(1, 9), "Of the spline.")
          .only_of({"spline"}, "spline")
          .row(
              "knots", &T::knots, list("knots", number("s")),
              "Not descending, as many as points and degree and 1 more; clamped or not. The track lasts from "
              "knot number degree (from 0) to the one as far from the end.",
              alternative())
          .only_of({"spline"}, "spline")
          .row("interval", &T::interval, positive("s"),
               "In place of `knots`, or of the times of a file of poses that has none (KITTI): they are so "
               "far "
               "apart, and the track begins at 0.",
               alternative())
          .only_of({"spline", "poses"}, "spline, poses")
          .row("times_file", &T::times_file, input::file_name(),
               "In place of `interval`: a file with a time a line, as KITTI's `times.txt`.", alternative())
          .only_of({"poses"}, "poses")
          .row("points", &T::points, list("points", place("m")), "Control points, or places at the times.",
               alternative())
          .only_of({"spline", "poses"}, "spline, poses")
          .row("yaw", &T::yaw, list("angles", number("rad")),
               "Control points of a spline of the same degree about z; of a body that does not turn none.",
               absent("not turned"))
          .only_of({"spline"}, "spline")
          .row("yaw_interval", &T::yaw_interval, positive("s"), "Between the knots of `yaw`.",
               absent("those of points"))
          .only_of({"spline"}, "spline")
          .row("velocities", &T::velocities, list("velocities", place("m/s")), "At the times, for hermite.",
               absent("from neighbours (Catmull and Rom)"))
          .only_of({"poses"}, "poses")
          .row("rotations", &T::rotations, list("quaternions", quaternion()),
               "Unit quaternions [w, x, y, z] at the times; in between slerp.", absent("not turned"))
          .only_of({"poses"}, "poses")
          .row("between", &T::between,
               input::choice<Between>({{"linear", Between::linear}, {"hermite", Between::hermite}}),
               "Straight from place to place, or cubics with velocities.")
          .only_of({"poses"}, "poses")
          .row("orientation", &T::orientation,
               input::choice<Facing>({{"fixed", Facing::fixed}, {"level", Facing::level}}),
               "`level`: its x axis along its velocity, which is never zero or vertical and does not turn at "
               "once; its y axis level. Not of a track that says how it turns.");
  return fields;
}

void require_none(bool given, const std::string& path, const char* field, const char* beside) {
  if (given) throw InputError(input::join(path, field), "given", std::string("left out beside ") + beside);
}

template <typename List>
void require_list(const List& given, const std::string& path, const char* field) {
  if (given.empty())
    throw InputError(input::join(path, field), "nothing", "a list of them, or the track's `file`");
}

[[noreturn]] void refuse_columns(const NumberTable& table, const std::string& file, const char* requirement) {
  throw InputError(plain_text(file), table.header(), requirement);
}

Vector3d place_of(const NumberTable& table, const std::vector<double>& row, const char* x, const char* tx,
                  const char* y, const char* ty, const char* z, const char* tz) {
  const auto of = [&](const char* name, const char* other) {
    const auto column = table.find({name, other});
    return column ? row[*column] : 0.0;
  };
  return {of(x, tx), of(y, ty), of(z, tz)};
}

// Tables.

/// duration or to, then x^0, x^1, ..., y^0, ..., z^0, ..., yaw^0, ...: a row a piece.
struct PowerPieces {
  std::vector<double> times;
  std::vector<std::vector<Vector3d>> position, turned;
};

PowerPieces power_pieces(const std::string& file) {
  const NumberTable table(file);
  const char* requirement =
      "columns named duration (or Duration), x^0, x^1, ..., y^0, ..., z^0, ..., and yaw^0, ... if it turns";
  const auto duration = table.find({"duration", "Duration"});
  if (!duration || !table.find({"x^0"}) || !table.find({"y^0"})) refuse_columns(table, file, requirement);
  PowerPieces found{{0}, {}, {}};
  const bool yaw = table.find({"yaw^0"}).has_value();
  const auto coefficient = [&](const std::vector<double>& row, const char* of, int power) {
    const auto column = table.find({(std::string(of) + "^" + std::to_string(power)).c_str()});
    return column ? row[*column] : 0.0;
  };
  int degree = 0;
  for (int power = 0; power < 64; ++power)
    for (const char* of : {"x", "y", "z", "yaw"})
      if (table.find({(std::string(of) + "^" + std::to_string(power)).c_str()})) degree = power;
  if (degree > 9) refuse_columns(table, file, "powers up to 9");
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    const std::vector<double>& row = table.rows()[i];
    if (!(row[*duration] > 0))
      throw InputError(table.where(i) + ", duration", to_text(row[*duration]), "a positive number (s)");
    found.times.push_back(found.times.back() + row[*duration]);
    std::vector<Vector3d> place, turn;
    for (int power = 0; power <= degree; ++power) {
      place.emplace_back(coefficient(row, "x", power), coefficient(row, "y", power),
                         coefficient(row, "z", power));
      turn.emplace_back(0, 0, coefficient(row, "yaw", power));
    }
    // Whole turns between two pieces are none.
    if (yaw && !found.turned.empty()) {
      const std::vector<Vector3d>& before = found.turned.back();
      const double h = found.times[i] - found.times[i - 1];
      double end = 0;
      for (std::size_t k = before.size(); k-- > 0;) end = end * h + before[k].z();
      turn[0].z() += 2 * std::numbers::pi * std::round((end - turn[0].z()) / (2 * std::numbers::pi));
    }
    found.position.push_back(std::move(place));
    if (yaw) found.turned.push_back(std::move(turn));
  }
  return found;
}

/// x, y, z and, of others than splines, a time: by names, or three columns.
void read_points(const std::string& file, TrackFields& to) {
  const NumberTable table(file);
  const bool named = table.find({"x"}) && table.find({"y"});
  if (!named && (table.named() || table.columns() != 3))
    refuse_columns(table, file, "columns named x, y and z, or three without names");
  for (const std::vector<double>& row : table.rows()) {
    to.points.push_back(named ? place_of(table, row, "x", "x", "y", "y", "z", "z")
                              : Vector3d(row[0], row[1], row[2]));
    if (const auto yaw = table.find({"yaw"})) to.yaw.push_back(row[*yaw]);
  }
}

/// The rows of a 3x4 matrix [R | t], as KITTI writes poses: 12 numbers, no time.
void read_kitti(const NumberTable& table, TrackFields& to) {
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    const std::vector<double>& row = table.rows()[i];
    Matrix3d turn;
    turn << row[0], row[1], row[2], row[4], row[5], row[6], row[8], row[9], row[10];
    const double off = (turn * turn.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= 1e-3) || turn.determinant() < 0)
      throw InputError(table.where(i), "a matrix that turns to within " + to_text(off),
                       "r11 r12 r13 x r21 r22 r23 y r31 r32 r33 z with a rotation, within 1e-3");
    to.rotations.push_back(Eigen::Quaterniond(turn).normalized().toRotationMatrix());
    to.points.emplace_back(row[3], row[7], row[11]);
  }
}

/// When the poses of a file without times are.
void read_times(const std::string& file, const std::string& times_file, const std::string& path,
                TrackFields& to) {
  if (times_file.empty() == (to.interval == 0))
    throw InputError(input::join(path, "interval"),
                     times_file.empty() ? "nothing" : "given beside times_file",
                     "either interval (s) or times_file: " + plain_text(file) + " has poses without times");
  if (times_file.empty()) {
    for (std::size_t i = 0; i < to.points.size(); ++i)
      to.times.push_back(to.interval * static_cast<double>(i));
    return;
  }
  const NumberTable table(times_file);
  if (table.columns() != 1 || table.rows().size() != to.points.size())
    throw InputError(input::join(path, "times_file"),
                     std::to_string(table.rows().size()) + " lines of " + std::to_string(table.columns()),
                     "a time for each of the " + std::to_string(to.points.size()) + " poses, one a line");
  for (const std::vector<double>& row : table.rows()) to.times.push_back(row[0]);
}

/// Poses by names, or t x y z, or as TUM writes them: t x y z qx qy qz qw; or as KITTI does.
void read_poses(const std::string& file, const std::string& times_file, const std::string& path,
                TrackFields& to) {
  const NumberTable table(file);
  if (!table.named() && table.columns() == 12) {
    read_kitti(table, to);
    read_times(file, times_file, path, to);
    return;
  }
  for (const char* field : {"interval", "times_file"})
    if (field[0] == 'i' ? to.interval > 0 : !times_file.empty())
      throw InputError(input::join(path, field), "given",
                       "left out: the poses of " + plain_text(file) + " have times");
  const auto t = table.find({"t", "time", "timestamp"});
  const bool named = t && table.find({"x", "tx"}) && table.find({"y", "ty"});
  const bool tum = !table.named() && table.columns() == 8, places = !table.named() && table.columns() == 4;
  if (!named && !tum && !places)
    refuse_columns(
        table, file,
        "columns named t, x, y, z (and qx, qy, qz, qw or yaw, and vx, vy, vz), or t x y z, or t x y "
        "z qx qy qz qw (TUM), or the 12 numbers of 3x4 matrices (KITTI) without names");
  const auto turn = table.find({"qw"}), yaw = table.find({"yaw"});
  const auto x = table.find({"qx"}), y = table.find({"qy"}), z = table.find({"qz"});
  if (turn && (!x || !y || !z)) refuse_columns(table, file, "all of qx, qy, qz, qw");
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    const std::vector<double>& row = table.rows()[i];
    to.times.push_back(named ? row[*t] : row[0]);
    to.points.push_back(named ? place_of(table, row, "x", "tx", "y", "ty", "z", "tz")
                              : Vector3d(row[1], row[2], row[3]));
    if (tum) to.rotations.push_back(rotation_of(row[7], row[4], row[5], row[6], table.where(i)));
    if (turn) to.rotations.push_back(rotation_of(row[*turn], row[*x], row[*y], row[*z], table.where(i)));
    if (!turn && yaw)
      to.rotations.emplace_back(Eigen::AngleAxisd(row[*yaw], Vector3d::UnitZ()).toRotationMatrix());
    if (table.find({"vx"}) && table.find({"vy"}))
      to.velocities.push_back(place_of(table, row, "vx", "vx", "vy", "vy", "vz", "vz"));
  }
}

// Trajectories.

void shift(std::vector<double>& times, double by) {
  for (double& t : times) t += by;
}

Trajectory of_powers(TrackFields track, const std::string& path, const std::string& file) {
  if (file.empty()) {
    require_list(track.times, path, "times");
    require_list(track.pieces, path, "pieces");
    shift(track.times, track.start);
    return {simulation::piecewise_of_powers(track.times, track.pieces), {}};
  }
  PowerPieces pieces = power_pieces(file);
  shift(pieces.times, track.start);
  Trajectory made{simulation::piecewise_of_powers(pieces.times, pieces.position), {}};
  if (!pieces.turned.empty()) made.turned = simulation::piecewise_of_powers(pieces.times, pieces.turned);
  return made;
}

Trajectory of_bernstein(TrackFields track, const std::string& path) {
  require_list(track.times, path, "times");
  require_list(track.pieces, path, "pieces");
  shift(track.times, track.start);
  return {{track.times, track.pieces, 0}, {}};
}

std::vector<double> uniform_knots(int degree, std::size_t points, double interval) {
  std::vector<double> knots;
  for (std::size_t i = 0; i < points + static_cast<std::size_t>(degree) + 1; ++i)
    knots.push_back(interval * (static_cast<double>(i) - degree));
  return knots;
}

Trajectory of_spline(TrackFields track, const std::string& path, const std::string& file) {
  if (!file.empty()) read_points(file, track);
  require_list(track.points, path, "points");
  if (track.knots.empty() == (track.interval == 0))
    throw InputError(input::join(path, "knots"), track.knots.empty() ? "nothing" : "given beside interval",
                     "either knots or interval");
  const auto knots_for = [&](std::size_t count, double interval) {
    std::vector<double> knots = interval > 0 ? uniform_knots(track.degree, count, interval) : track.knots;
    shift(knots, track.start);
    return knots;
  };
  Trajectory made{simulation::piecewise_of_spline(
                      track.degree, knots_for(track.points.size(), track.interval), track.points),
                  {}};
  if (track.yaw.empty()) return made;
  std::vector<Vector3d> turned;
  for (const double angle : track.yaw) turned.emplace_back(0, 0, angle);
  const double interval = track.yaw_interval > 0 ? track.yaw_interval : track.interval;
  try {
    made.turned = simulation::piecewise_of_spline(track.degree, knots_for(turned.size(), interval), turned);
  } catch (const InputError& e) {
    throw InputError(input::join(path, "yaw"), e.field() + ": " + e.value(), e.requirement());
  }
  // Planners give the yaw a knot more than it needs; it may last longer than the way.
  Piecewise& yaw = *made.turned;
  if (yaw.to() < made.position.to() || yaw.from() != made.position.from())
    throw InputError(input::join(path, "yaw"),
                     "from " + to_text(yaw.from()) + " to " + to_text(yaw.to()) + " s",
                     "all the time of points, to " + to_text(made.position.to()) + " s");
  return made;
}

Trajectory of_poses(TrackFields track, const std::string& path, const std::string& file,
                    const std::string& times_file) {
  if (!file.empty()) read_poses(file, times_file, path, track);
  require_list(track.times, path, "times");
  require_list(track.points, path, "points");
  shift(track.times, track.start);
  Trajectory made{track.between == Between::linear
                      ? simulation::piecewise_through(track.times, track.points)
                      : simulation::piecewise_through(track.times, track.points, track.velocities),
                  {}};
  if (track.rotations.empty()) return made;
  return simulation::turned_through(std::move(made), track.times, track.rotations);
}

}  // namespace

Trajectory read_track(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  const TrackFields track = track_fields().read(value, path);
  const auto of_folder = [&](const std::string& name) {
    return name.empty() ? name : (folder / name).string();
  };
  const std::string file = of_folder(track.file), times_file = of_folder(track.times_file);
  if (!file.empty()) {
    require_none(!track.times.empty(), path, "times", "file");
    require_none(!track.pieces.empty(), path, "pieces", "file");
    require_none(!track.points.empty(), path, "points", "file");
    require_none(!track.rotations.empty(), path, "rotations", "file");
    require_none(!track.velocities.empty(), path, "velocities", "file");
    if (track.kind == "bernstein")
      throw InputError(input::join(path, "file"), input::quoted(value["file"]),
                       "left out: control points stand in `pieces`");
  }
  for (const char* field : {"interval", "times_file"})
    if (track.kind == "poses" && file.empty() && value.contains(field))
      throw InputError(input::join(path, field), input::quoted(value[field]),
                       "left out, or beside a `file` of poses without times");
  if (track.kind == "poses" && track.between == Between::linear && !track.velocities.empty())
    throw InputError(input::join(path, "velocities"), "given", "left out where between is linear");
  const auto made = [&] {
    if (track.kind == "powers") return of_powers(track, path, file);
    if (track.kind == "bernstein") return of_bernstein(track, path);
    if (track.kind == "spline") return of_spline(track, path, file);
    return of_poses(track, path, file, times_file);
  };
  try {
    Trajectory found = made();
    if (track.orientation == Facing::fixed) return found;
    if (found.turned)
      throw InputError(input::join(path, "orientation"), input::quoted(value["orientation"]),
                       "left out: the track says itself how it turns");
    return simulation::turned_along(std::move(found));
  } catch (const InputError& e) {
    const std::string& field = e.field();
    const auto names = [&](const std::string& one) {
      return !one.empty() && field.starts_with(plain_text(one));
    };
    const bool own = field.starts_with(path) || names(file) || names(times_file);
    if (own) throw;
    // The file's word for them.
    if (field.starts_with("powers"))
      throw InputError(input::join(path, ("pieces" + field.substr(6)).c_str()), e.value(), e.requirement());
    throw e.within(path);
  }
}

Json track_schemas() { return {{"track", track_fields().schema()}}; }

}  // namespace vericone::scenario
