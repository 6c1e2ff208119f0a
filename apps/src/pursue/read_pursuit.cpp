// SPDX-License-Identifier: BSD-3-Clause
#include "pursue/read_pursuit.h"

#include <vericone/geometry/error.h>
#include <vericone/vision/footage/footage.h>
#include <cmath>
#include <numbers>
#include <set>

#include "json/json_value.h"
#include "scenarios/parts.h"
#include "scenarios/scenario_fields.h"

namespace vericone::pursuit {
namespace {

using input::at, input::quoted, input::require_field, input::require_known, input::require_object;
using scenario::if_given, scenario::join, scenario::read_choice, scenario::read_count, scenario::read_flag,
    scenario::read_not_negative, scenario::read_positive, scenario::read_text;
using namespace vision;

constexpr double kDegree = std::numbers::pi / 180;

/// Reads the fields that are given into the numbers named; complains about others.
struct Numbers {
  const Json& value;
  const std::string& path;
  std::vector<std::string> known;

  Numbers(const Json& v, const std::string& p) : value(v), path(p) { require_object(v, p); }
  Numbers& positive(const char* field, double& target, const char* unit) {
    known.emplace_back(field);
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { target = read_positive(v, p, unit); });
    return *this;
  }
  Numbers& not_negative(const char* field, double& target, const char* unit) {
    known.emplace_back(field);
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { target = read_not_negative(v, p, unit); });
    return *this;
  }
  Numbers& any(const char* field, double& target, const char* unit) {
    known.emplace_back(field);
    if_given(value, path, field,
             [&](const Json& v, const std::string& p) { target = input::read_number(v, p, unit); });
    return *this;
  }
  void only(std::initializer_list<const char*> others) {
    for (const char* other : others) known.emplace_back(other);
    require_known(value, path, known);
  }
};

template <int N>
Eigen::Matrix<double, N, 1> positive_vector(const Json& value, const std::string& path, const char* unit) {
  const Eigen::Matrix<double, N, 1> v = input::read_vector<N>(value, path, unit);
  if (!(v.minCoeff() > 0)) throw InputError(path, quoted(value), std::string("positive numbers") + unit);
  return v;
}

Camera read_camera(const Json& value, const std::string& path) {
  constexpr int kLeast = 64, kMost = 8192;
  const int width = read_count(require_field(value, path, "width", "a number of pixels"), join(path, "width"),
                               kLeast, kMost);
  const int height = read_count(require_field(value, path, "height", "a number of pixels"),
                                join(path, "height"), kLeast, kMost);
  if (value.contains("focal")) {  // as recorded: no rounding on the way
    if (value.contains("field_of_view_deg"))
      throw InputError(join(path, "focal"), quoted(value["focal"]), "given without field_of_view_deg");
    const double focal = read_positive(value["focal"], join(path, "focal"), " (px)");
    return {width, height, focal, {0.5 * (width - 1), 0.5 * (height - 1)}};
  }
  const std::string field = join(path, "field_of_view_deg");
  const Json& given = require_field(value, path, "field_of_view_deg", "degrees across the width");
  const double degrees = input::read_number(given, field, " (degrees)");
  if (!(degrees >= 1 && degrees <= 170)) throw InputError(field, quoted(given), "between 1 and 170 degrees");
  return Camera::of_field_of_view(width, height, degrees * kDegree);
}

Ground read_ground(const Json& value, const std::string& path, const std::filesystem::path& folder) {
  Ground ground;
  Numbers(value, path)
      .positive("metres_per_pixel", ground.metres_per_pixel, " (m)")
      .not_negative("marks", ground.marks, " (in a square kilometre)")
      .only({"picture", "seed", "plain"});
  if_given(value, path, "picture", [&](const Json& v, const std::string& p) {
    ground.picture = read_picture(folder / read_text(v, p, "a picture file"), 1, p);
  });
  if_given(value, path, "seed", [&](const Json& v, const std::string& p) {
    ground.seed = std::uint64_t(read_count(v, p, 0, 2'000'000'000));
  });
  if_given(value, path, "plain",
           [&](const Json& v, const std::string& p) { ground.plain = read_flag(v, p); });
  return ground;
}

FlyingBars read_bars(const Json& value, const std::string& path) {
  FlyingBars bars;
  Numbers(value, path)
      .not_negative("height", bars.height, " (m)")
      .not_negative("from", bars.from, " (s)")
      .only({"count", "size"});
  bars.count = read_count(require_field(value, path, "count", "a whole number"), join(path, "count"), 0, 100);
  if_given(value, path, "size", [&](const Json& v, const std::string& p) {
    bars.size = input::read_vector<2>(v, p, " (m)");
    if (!(bars.size.x() > 0 && bars.size.y() >= 0))
      throw InputError(p, quoted(v), "a positive number and one that is 0 or more (m)");
  });
  return bars;
}

Occluder read_occluder(const Json& value, const std::string& path) {
  Occluder occluder;
  Numbers(value, path)
      .not_negative("bottom", occluder.bottom, " (m)")
      .not_negative("top", occluder.top, " (m)")
      .any("from", occluder.from, " (s)")
      .any("to", occluder.to, " (s)")
      .not_negative("texture", occluder.texture, " (1: as rough as the ground)")
      .only({"center", "size"});
  occluder.centre =
      input::read_vector<2>(require_field(value, path, "center", "[x, y] (m)"), join(path, "center"), " (m)");
  occluder.size =
      positive_vector<2>(require_field(value, path, "size", "[x, y] (m)"), join(path, "size"), " (m)");
  if (!(occluder.top >= occluder.bottom))
    throw InputError(join(path, "top"), to_text(occluder.top), "not below bottom");
  return occluder;
}

MountOptions read_mount(const Json& value, const std::string& path) {
  MountOptions mount;
  double rate_deg = mount.rate / kDegree;
  Numbers(value, path)
      .positive("rate_deg", rate_deg, " (degrees/s)")
      .not_negative("lag", mount.latency, " (s)")
      .only({"kind"});
  mount.rate = rate_deg * kDegree;
  mount.kind = read_choice<MountKind>(require_field(value, path, "kind", "north_up, strapdown or gimbal"),
                                      join(path, "kind"),
                                      {{"north_up", MountKind::north_up},
                                       {"strapdown", MountKind::strapdown},
                                       {"gimbal", MountKind::gimbal}});
  return mount;
}

View read_view(const Json& value, const std::string& path, const std::filesystem::path& folder, bool source) {
  View view;
  require_object(value, path);
  view.camera = read_camera(value, path);
  view.mount.kind = MountKind::north_up;
  SceneOptions& scene = view.scene;
  std::vector<std::string> known{"width", "height", "field_of_view_deg", "ground", "bars"};
  if_given(value, path, "ground",
           [&](const Json& v, const std::string& p) { scene.ground = read_ground(v, p, folder); });
  if_given(value, path, "bars", [&](const Json& v, const std::string& p) { view.bars = read_bars(v, p); });
  if (source) {  // clean, straight down
    require_known(value, path, known);
    return view;
  }
  Numbers(value, path)
      .not_negative("noise", scene.noise, " (grey levels)")
      .not_negative("blur", scene.blur, " (px)")
      .not_negative("exposure", scene.exposure, " (s)")
      .positive("light", scene.light, " (1: full sun)")
      .not_negative("vehicle_height", view.height, " (m)")
      .not_negative("latency", view.latency, " (s)")
      .only({"width", "height", "field_of_view_deg", "ground", "bars", "mount", "occluders", "shadows"});
  if_given(value, path, "shadows",
           [&](const Json& v, const std::string& p) { scene.shadows = read_flag(v, p); });
  if_given(value, path, "mount", [&](const Json& v, const std::string& p) { view.mount = read_mount(v, p); });
  if_given(value, path, "occluders", [&](const Json& v, const std::string& p) {
    if (!v.is_array()) throw InputError(p, quoted(v), "a list of occluders");
    for (std::size_t i = 0; i < v.size(); ++i) scene.occluders.push_back(read_occluder(v[i], at(p, i)));
  });
  return view;
}

Car read_car(const Json& value, const std::string& path, bool followed) {
  require_object(value, path);
  require_known(value, path, {"name", "position", "road", "size", "look"});
  Car car;
  car.followed = followed;
  car.name = read_text(require_field(value, path, "name", "a name, as text"), join(path, "name"), "a name");
  const Eigen::Vector2d start = input::read_vector<2>(require_field(value, path, "position", "[x, y] (m)"),
                                                      join(path, "position"), " (m)");
  car.road = scenario::read_road(require_field(value, path, "road", "a mapping with kind"),
                                 join(path, "road"), start);
  if_given(value, path, "size", [&](const Json& v, const std::string& p) {
    car.look.size = input::read_vector<3>(v, p, " (m)");
    if (!(car.look.size.head<2>().minCoeff() > 0 && car.look.size.z() >= 0))
      throw InputError(p, quoted(v), "length and width above 0, height 0 or more (m)");
  });
  if_given(value, path, "look", [&](const Json& v, const std::string& p) {
    car.look.seed = std::uint32_t(read_count(v, p, 0, 1'000'000));
  });
  return car;
}

void read_gains(const Json& value, const std::string& path, Pursuit& pursuit) {
  require_object(value, path);
  require_known(value, path, {"source", "ours", "vertical"});
  if_given(value, path, "source", [&](const Json& v, const std::string& p) {
    pursuit.source_law =
        read_choice<SourceLaw>(require_field(v, p, "kind", "rendezvous or focal"), join(p, "kind"),
                               {{"rendezvous", SourceLaw::rendezvous}, {"focal", SourceLaw::focal}});
    if (pursuit.source_law == SourceLaw::rendezvous) {
      guidance::RendezvousGains& gains = pursuit.rendezvous;
      Numbers(v, p)
          .positive("K_1", gains.cone, " (1/s)")
          .positive("K_2", gains.speed, " (1/s)")
          .any("y_1d", gains.reference, " (m^4/s^2)")
          .positive("R", gains.radius, " (m)")
          .positive("most", gains.most, " (m/s^2)")
          .not_negative("singular", gains.singular, "")
          .only({"kind", "closing"});
      if_given(v, p, "closing",
               [&](const Json& w, const std::string& q) { gains.closing = read_flag(w, q); });
      return;
    }
    guidance::FocalGains& gains = pursuit.focal;
    Numbers(v, p)
        .positive("K_1", gains.cone, " (1/s)")
        .positive("K_2", gains.speed, " (1/s)")
        .any("y_1d", gains.reference, "")
        .positive("most", gains.most, " (m/s^2)")
        .not_negative("singular", gains.singular, "")
        .not_negative("stay", gains.stay, " (s)")
        .not_negative("K_h", gains.heading, "")
        .not_negative("K_theta", gains.sight, "")
        .not_negative("K_sp", gains.speed_error, " (1/s)")
        .not_negative("K_r", gains.distance, " (1/s^2)")
        .not_negative("near", gains.near, " (m)")
        .only({"kind", "form"});
    if_given(v, p, "form", [&](const Json& w, const std::string& q) {
      pursuit.form = read_choice<guidance::FocalForm>(
          w, q, {{"source", guidance::FocalForm::source}, {"polynomial", guidance::FocalForm::polynomial}});
    });
  });
  if_given(value, path, "ours", [&](const Json& v, const std::string& p) {
    Numbers(v, p)
        .positive("distance", pursuit.ours.distance, " (1/s)")
        .positive("speed", pursuit.ours.speed, " (1/s)")
        .positive("most", pursuit.ours.most, " (m/s^2)")
        .only({});
  });
  if_given(value, path, "vertical", [&](const Json& v, const std::string& p) {
    guidance::VerticalGains gains;
    Numbers(v, p)
        .positive("size", gains.size, " (px)")
        .positive("size_band", gains.size_band, " (px)")
        .positive("size_near", gains.size_near, " (px)")
        .positive("altitude", gains.altitude, " (m)")
        .positive("altitude_band", gains.altitude_band, " (m)")
        .positive("K_pS", gains.size_p, "")
        .not_negative("K_dS", gains.size_d, "")
        .positive("K_pz", gains.altitude_p, " (1/s^2)")
        .not_negative("K_dz", gains.altitude_d, " (1/s)")
        .positive("K_p_lock", gains.lock_p, " (1/s^2)")
        .not_negative("K_d_lock", gains.lock_d, " (1/s)")
        .positive("most", gains.most, " (m/s^2)")
        .only({});
    pursuit.vertical = gains;
  });
}

void read_uas(const Json& value, const std::string& path, Pursuit& pursuit) {
  require_object(value, path);
  require_known(value, path, {"position", "velocity", "vehicle", "source_steps"});
  pursuit.start.position = input::read_vector<3>(require_field(value, path, "position", "[x, y, z] (m)"),
                                                 join(path, "position"), " (m)");
  if (!(pursuit.start.position.z() > 0))
    throw InputError(join(path, "position") + "[2]", quoted(value["position"][2]), "above the ground (m)");
  if_given(value, path, "velocity", [&](const Json& v, const std::string& p) {
    pursuit.start.velocity = input::read_vector<3>(v, p, " (m/s)");
  });
  if_given(value, path, "source_steps",
           [&](const Json& v, const std::string& p) { pursuit.source_steps = read_flag(v, p); });
  if_given(value, path, "vehicle", [&](const Json& v, const std::string& p) {
    pursuit.vehicle = scenario::read_vehicle(v, p, true).model;
  });
  if (!pursuit.vehicle && pursuit.start.velocity.z() != 0)
    throw InputError(join(path, "velocity") + "[2]", to_text(pursuit.start.velocity.z()),
                     "0 without a vehicle: a point mass keeps its altitude");
}

void read_filters(const Json& value, const std::string& path, Pursuit& pursuit) {
  require_object(value, path);
  require_known(value, path, {"source", "ours"});
  const auto variance = [](const Json& v, const std::string& p, guidance::SingerOptions& filter) {
    if_given(v, p, "variance", [&](const Json& w, const std::string& q) {
      filter.variance = positive_vector<2>(w, q, " (m^2/s^4)");
    });
  };
  if_given(value, path, "source", [&](const Json& v, const std::string& p) {
    Numbers(v, p)
        .not_negative("alpha", pursuit.source_filter.alpha, " (1/s)")
        .positive("noise", pursuit.noise, " (m^2)")
        .positive("hidden_noise", pursuit.hidden_noise, " (m^2)")
        .only({"variance"});
    variance(v, p, pursuit.source_filter);
  });
  if_given(value, path, "ours", [&](const Json& v, const std::string& p) {
    Numbers(v, p)
        .not_negative("alpha", pursuit.our_filter.alpha, " (1/s)")
        .positive("own_noise", pursuit.own_noise, " (m)")
        .only({"variance"});
    variance(v, p, pursuit.our_filter);
  });
}

}  // namespace

Pursuit read_pursuit(const Json& fields, const std::string& name, const std::filesystem::path& folder,
                     Eyes eyes) {
  if (!fields.is_object())
    throw InputError("pursuit", quoted(fields), "a mapping with uas, cars and cameras");
  Pursuit pursuit;
  pursuit.name = name;
  pursuit.eyes = eyes;
  Numbers(fields, "")
      .positive("duration", pursuit.duration, " (s)")
      .positive("step", pursuit.step, " (s)")
      .positive("picture_step", pursuit.picture_step, " (s)")
      .positive("side", pursuit.side, " (m)")
      .positive("give_up", pursuit.give_up, " (s)")
      .only({"name", "uas", "cars", "decoys", "cameras", "laws", "filters", "seed"});
  if_given(fields, "", "name",
           [&](const Json& v, const std::string& p) { pursuit.name = read_text(v, p, "a name"); });
  if_given(fields, "", "seed", [&](const Json& v, const std::string& p) {
    pursuit.seed = std::uint64_t(read_count(v, p, 0, 2'000'000'000));
  });
  read_uas(require_field(fields, "", "uas", "a mapping with position"), "uas", pursuit);
  std::set<std::string> names;
  const auto read_cars = [&](const char* field, bool followed) {
    const Json& list = fields[field];
    if (!list.is_array() || (followed && list.empty()))
      throw InputError(field, quoted(list), "a list of vehicles");
    for (std::size_t i = 0; i < list.size(); ++i) {
      pursuit.cars.push_back(read_car(list[i], at(field, i), followed));
      if (!names.insert(pursuit.cars.back().name).second)
        throw InputError(at(field, i) + ".name", pursuit.cars.back().name, "a name of its own");
    }
  };
  require_field(fields, "", "cars", "a list of vehicles");
  read_cars("cars", true);
  if (fields.contains("decoys")) read_cars("decoys", false);
  const Json& cameras = require_field(fields, "", "cameras", "a mapping with source and perspective");
  require_object(cameras, "cameras");
  require_known(cameras, "cameras", {"source", "perspective"});
  if_given(cameras, "cameras", "source", [&](const Json& v, const std::string& p) {
    pursuit.source_view = read_view(v, p, folder, true);
    if (eyes == Eyes::exact) pursuit.perspective_view = pursuit.source_view;
  });
  if_given(cameras, "cameras", "perspective", [&](const Json& v, const std::string& p) {
    pursuit.perspective_view = read_view(v, p, folder, false);
  });
  const bool source = eyes == Eyes::source || (eyes == Eyes::exact && !cameras.contains("perspective"));
  require_field(cameras, "cameras", source ? "source" : "perspective", "a camera, that of --camera");
  if_given(fields, "", "laws", [&](const Json& v, const std::string& p) { read_gains(v, p, pursuit); });
  if_given(fields, "", "filters", [&](const Json& v, const std::string& p) { read_filters(v, p, pursuit); });
  std::size_t followed = 0;
  for (const Car& car : pursuit.cars) followed += car.followed;
  if (pursuit.source_law == SourceLaw::rendezvous && followed != 1)
    throw InputError("laws.source.kind", "rendezvous", "focal: rendezvous is for one car");
  const double ratio = pursuit.picture_step / pursuit.step;
  if (!(ratio > 0.5) || std::abs(ratio - std::round(ratio)) > 1e-6)
    throw InputError("picture_step", to_text(pursuit.picture_step), "a whole number of steps (s)");
  return pursuit;
}

SeenBy read_perception(const Json& fields) {
  const std::string none;
  SeenBy seen{{}, 0.04};
  PerceptionOptions& options = seen.perception;
  if (!fields.is_object()) throw InputError("camera", quoted(fields), "a mapping with width, height, ...");
  options.camera = read_camera(fields, "");
  Numbers(fields, none)
      .not_negative("vehicle_height", options.height, " (m)")
      .not_negative("alpha", options.filter.alpha, " (1/s)")
      .positive("noise", options.noise, " (m^2)")
      .positive("hidden_noise", options.hidden_noise, " (m^2)")
      .positive("own_noise", options.own_noise, " (m)")
      .positive("picture_step", seen.picture_step, " (s)")
      .only({"width", "height", "field_of_view_deg", "focal", "variance", "filters"});
  if_given(fields, "", "filters", [&](const Json& v, const std::string& p) {
    options.source = read_choice<bool>(v, p, {{"source", true}, {"ours", false}});
  });
  if_given(fields, "", "variance", [&](const Json& v, const std::string& p) {
    options.filter.variance = positive_vector<2>(v, p, " (m^2/s^4)");
  });
  return seen;
}

Json perception_json(const SeenBy& seen) {
  const PerceptionOptions& options = seen.perception;
  return {{"width", options.camera.width},
          {"height", options.camera.height},
          {"focal", options.camera.focal},
          {"vehicle_height", options.height},
          {"alpha", options.filter.alpha},
          {"variance", {options.filter.variance.x(), options.filter.variance.y()}},
          {"noise", options.noise},
          {"hidden_noise", options.hidden_noise},
          {"own_noise", options.own_noise},
          {"picture_step", seen.picture_step},
          {"filters", options.source ? "source" : "ours"}};
}

}  // namespace vericone::pursuit
