// SPDX-License-Identifier: BSD-3-Clause
#include "pursuits/read_pursuit.h"

#include <vericone/pursuits/pursuit_files.h>
#include <vericone/vision/footage/footage.h>
#include <cmath>
#include <numbers>

#include "input/field_table.h"
#include "input/scene.h"
#include "json/plain_text.h"
#include "output/schemas.h"
#include "scenarios/parts.h"

namespace vericone::pursuit {
namespace {

using input::absent, input::alternative, input::at, input::checked, input::choice, input::count,
    input::Fields, input::flag, input::join, input::list, input::mapping, input::not_negative, input::number,
    input::positive, input::quoted, input::require_field, input::require_object, input::required, input::text,
    input::Value, input::vector, input::within_part;
using namespace vision;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kMostSeed = 2'000'000'000;

Json reference(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

struct CameraFields {
  int width = 0, height = 0;
  std::optional<double> field_of_view_deg, focal;  // degrees, px
};

/// `S` is a CameraFields.
template <typename S>
Fields<S> camera_rows(const char* title) {
  const auto side = count(64, 8192);
  return Fields<S>(title)
      .row("width", &CameraFields::width, side, "Of the picture, px.", required("a number of pixels"))
      .row("height", &CameraFields::height, side, "Of the picture, px.", required("a number of pixels"))
      .row("field_of_view_deg", &CameraFields::field_of_view_deg,
           input::shown_as(number("degrees"), {{"type", "number"}, {"minimum", 1}, {"maximum", 170}}),
           "Across the width, (4.17).");
}

Camera camera_of(const CameraFields& fields, const Json& value, const std::string& path) {
  if (fields.focal) {  // as recorded: no rounding on the way
    if (fields.field_of_view_deg)
      throw InputError(join(path, "focal"), quoted(value["focal"]), "given without field_of_view_deg");
    return {
        fields.width, fields.height, *fields.focal, {0.5 * (fields.width - 1), 0.5 * (fields.height - 1)}};
  }
  const Json& given = require_field(value, path, "field_of_view_deg", "degrees across the width");
  const double degrees = *fields.field_of_view_deg;
  if (!(degrees >= 1 && degrees <= 170))
    throw InputError(join(path, "field_of_view_deg"), quoted(given), "between 1 and 170 degrees");
  return Camera::of_field_of_view(fields.width, fields.height, degrees * kDegree);
}

/// What is read with names of files in it.
template <typename Read>
struct InFolder : Read {
  std::filesystem::path folder;
};

const Fields<InFolder<Ground>>& ground_fields() {
  using G = InFolder<Ground>;
  const auto picture = [](const Json& v, const std::string& p, G& ground) {
    ground.picture = read_picture(ground.folder / text("a picture file").read(v, p), 1, p);
  };
  static const Fields<G> fields =
      Fields<G>("ground")
          .row("plain", &G::plain, flag(),
               "One colour with marks, as the source's; otherwise fields, roads and marks.")
          .row("marks", &G::marks, not_negative("in a square kilometre"), "Of a plain ground.")
          .special("picture", text("").schema, picture,
                   "A picture file, laid on the ground again and again, relative to this file.",
                   absent("made from `seed`"))
          .row("metres_per_pixel", &G::metres_per_pixel, positive("m"), "Of the picture.")
          .row("seed", &G::seed, count(0, kMostSeed), "Of a ground that is made.");
  return fields;
}

const Fields<FlyingBars>& bar_fields() {
  using B = FlyingBars;
  const auto holds = [](const Eigen::Vector2d& size) { return size.x() > 0 && size.y() >= 0; };
  static const Fields<B> fields =
      Fields<B>("bars")
          .row("count", &B::count, count(0, 100), "How many.", required("a whole number"))
          .row("size", &B::size,
               checked<Eigen::Vector2d>(vector<2>("m"), "a positive number and one that is 0 or more (m)",
                                        holds),
               "Along x and y; 0 along y: all of the picture's height.")
          .row("height", &B::height, not_negative("m"), "Above the ground.")
          .row("from", &B::from, not_negative("s"), "When they begin.");
  return fields;
}

const Fields<Occluder>& occluder_fields() {
  using O = Occluder;
  const auto size = checked<Eigen::Vector2d>(vector<2>("m"), "positive numbers (m)",
                                             [](const Eigen::Vector2d& v) { return v.minCoeff() > 0; });
  static const Fields<O> fields =
      Fields<O>("occluder")
          .row("center", &O::centre, vector<2>("m"), "On the ground below.", required("[x, y] (m)"))
          .row("size", &O::size, size, "Along x and y.", required("[x, y] (m)"))
          .row("bottom", &O::bottom, not_negative("m"), "Above the ground.")
          .row("top", &O::top, not_negative("m"), "Not below `bottom`.")
          .row("from", &O::from, number("s"), "When it is there.")
          .row("to", &O::to, number("s"), "Until when.", absent("always"))
          .row("texture", &O::texture, not_negative("1: as rough as the ground"), "0: one colour.");
  return fields;
}

Occluder read_occluder(const Json& value, const std::string& path) {
  const Occluder occluder = occluder_fields().read(value, path);
  if (!(occluder.top >= occluder.bottom))
    throw InputError(join(path, "top"), to_text(occluder.top), "not below bottom");
  return occluder;
}

const Fields<MountOptions>& mount_fields() {
  using M = MountOptions;
  static const Fields<M> fields =
      Fields<M>("mount")
          .row("kind", &M::kind,
               choice<MountKind>({{"north_up", MountKind::north_up},
                                  {"strapdown", MountKind::strapdown},
                                  {"gimbal", MountKind::gimbal}}),
               "Straight down whatever the attitude; fixed in the body; turned at a limited rate to look at "
               "the middle of the vehicles.",
               required("north_up, strapdown or gimbal"))
          .row("rate_deg", &M::rate, positive("degrees/s", kDegree), "Of a gimbal, at most.")
          .row("lag", &M::latency, not_negative("s"),
               "So old is what a gimbal knows of the body and of where to look.");
  return fields;
}

struct ViewFields : CameraFields, InFolder<View> {};

/// The source's camera: clean, straight down.
Fields<ViewFields> source_view_rows(const char* title) {
  using V = ViewFields;
  const auto ground = [](const Json& v, const std::string& p, V& view) {
    InFolder<Ground> read{{}, view.folder};
    ground_fields().read(v, p, read);
    view.scene.ground = std::move(read);
  };
  return camera_rows<V>(title)
      .special("ground", reference("ground"), ground, "What lies on the ground.")
      .row("bars", &V::bars, mapping("bars", bar_fields()),
           "Bars that hide what they cover, and stand again ahead of the UAS once they have left the "
           "picture.");
}

const Fields<ViewFields>& source_view_fields() {
  static const Fields<ViewFields> fields = source_view_rows("source_camera");
  return fields;
}

const Fields<ViewFields>& view_fields() {
  using V = ViewFields;
  const auto of = [](auto SceneOptions::*member) { return within_part(&View::scene, member); };
  static const Fields<V> fields =
      source_view_rows("camera")
          .row("mount", &V::mount, mapping("mount", mount_fields()), "How it is carried.")
          .row("occluders", of(&SceneOptions::occluders),
               list("occluders", Value<Occluder>{read_occluder, reference("occluder"), {}}),
               "Blocks over the ground.")
          .row("noise", of(&SceneOptions::noise), not_negative("grey levels"),
               "Standard deviation of every pixel.")
          .row("blur", of(&SceneOptions::blur), not_negative("px"), "Of the lens, standard deviation.")
          .row("exposure", of(&SceneOptions::exposure), not_negative("s"),
               "How long a picture is exposed: motion blur.")
          .row("light", of(&SceneOptions::light), positive("1: full sun"), "Below 0.5 dusk.")
          .row("shadows", of(&SceneOptions::shadows), flag(), "On the ground.")
          .row("vehicle_height", &View::height, not_negative("m"),
               "Of the middle of a vehicle above the ground, as the UAS takes it.")
          .row("latency", &V::latency, not_negative("s"), "So old is a picture when it is seen.");
  return fields;
}

View read_view(const Json& value, const std::string& path, const std::filesystem::path& folder,
               const Fields<ViewFields>& fields) {
  ViewFields view;
  view.folder = folder;
  view.mount.kind = MountKind::north_up;
  fields.read(value, path, view);
  view.camera = camera_of(view, value, path);
  return view;
}

struct CarFields : Car {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

const Fields<CarFields>& car_fields() {
  using C = CarFields;
  const auto road = [](const Json& v, const std::string& p, C& car) {
    car.road = scenario::read_road(v, p, car.position);
  };
  const auto size = checked<Eigen::Vector3d>(
      vector<3>("m"), "length and width above 0, height 0 or more (m)",
      [](const Eigen::Vector3d& v) { return v.head<2>().minCoeff() > 0 && v.z() >= 0; });
  static const Fields<C> fields =
      Fields<C>("car")
          .row("name", &C::name, text("a name"), "Of its own.", required("a name, as text"))
          .row("position", &C::position, vector<2>("m"), "At the start.", required("[x, y] (m)"))
          .special("road",
                   {{"title", "a road"},
                    {"anyOf",
                     {{{"$ref", "scenario.schema.json#/$defs/lanes"}},
                      {{"$ref", "scenario.schema.json#/$defs/squircle"}}}}},
                   road, "Where it drives: `lanes` or `squircle` ([scenarios](scenarios.md)).",
                   required("a mapping with kind"))
          .row("size", within_part(&Car::look, &VehicleLook::size), size,
               "Length, width and height; height 0 is a flat picture on the ground, the source's.")
          .row("look", within_part(&Car::look, &VehicleLook::seed), count(0, 1'000'000),
               "Vehicles with the same number look alike.");
  return fields;
}

const Fields<guidance::RendezvousGains>& rendezvous_fields() {
  using G = guidance::RendezvousGains;
  static const Fields<G> fields =
      Fields<G>("rendezvous")
          .kind("kind", "rendezvous", "(3.7), (3.8) of one vehicle.")
          .row("cone", &G::cone, positive("1/s"), "K_1, of y_1.")
          .formerly("K_1")
          .row("speed", &G::speed, positive("1/s"), "K_2, of y_2.")
          .formerly("K_2")
          .row("reference", &G::reference, number("m^4/s^2"), "y_1d: wanted y_1.")
          .formerly("y_1d")
          .row("radius", &G::radius, positive("m"), "R, of the vehicle.")
          .formerly("R")
          .row("most", &G::most, positive("m/s^2"), "Of each component of the acceleration.")
          .row("singular", &G::singular, not_negative(),
               "No command of the law's own where its denominator is below this.")
          .row("closing", &G::closing, flag(),
               "K_1 with the sign of -V_r, without which the UAS parks beside the vehicle.");
  return fields;
}

struct FocalFields : guidance::FocalGains {
  guidance::FocalForm form = guidance::FocalForm::source;
};

const Fields<FocalFields>& focal_fields() {
  using F = FocalFields;
  using guidance::FocalForm;
  static const Fields<F> fields =
      Fields<F>("focal")
          .kind("kind", "focal", "(4.14) to (4.16) of the foci of the ellipse around all.")
          .row("form", &F::form,
               choice<FocalForm>({{"source", FocalForm::source}, {"polynomial", FocalForm::polynomial}}),
               "Of y_1, (4.6) with tau, or without.")
          .row("cone", &F::cone, positive("1/s"), "K_1, of y_1.")
          .formerly("K_1")
          .row("speed", &F::speed, positive("1/s"), "K_2, of y_2.")
          .formerly("K_2")
          .row("reference", &F::reference, number(), "y_1d: wanted y_1.")
          .formerly("y_1d")
          .row("most", &F::most, positive("m/s^2"), "Of each component of the acceleration.")
          .row("singular", &F::singular, not_negative(),
               "No command of the law's own where its denominator is below this.")
          .row("stay", &F::stay, not_negative("s"), "So long the boundary layer's law stays in force.")
          .row("heading", &F::heading, not_negative(), "K_h, of the heading, (4.15).")
          .formerly("K_h")
          .row("sight", &F::sight, not_negative(), "K_theta, of the line of sight.")
          .formerly("K_theta")
          .row("speed_error", &F::speed_error, not_negative("1/s"), "K_sp, of the speed.")
          .formerly("K_sp")
          .row("distance", &F::distance, not_negative("1/s^2"), "K_r, of the distance.")
          .formerly("K_r")
          .row("near", &F::near, not_negative("m"), "`sight` and `distance` count beyond it.");
  return fields;
}

void read_source_law(const Json& value, const std::string& path, Pursuit& pursuit) {
  pursuit.source_law =
      choice<SourceLaw>({{"rendezvous", SourceLaw::rendezvous}, {"focal", SourceLaw::focal}})
          .read(require_field(value, path, "kind", "rendezvous or focal"), join(path, "kind"));
  if (pursuit.source_law == SourceLaw::rendezvous) {
    pursuit.rendezvous = rendezvous_fields().read(value, path);
    return;
  }
  const FocalFields gains = focal_fields().read(value, path);
  pursuit.focal = gains;
  pursuit.form = gains.form;
}

const Fields<guidance::PursuitGains>& our_fields() {
  using G = guidance::PursuitGains;
  static const Fields<G> fields =
      Fields<G>("law_ours")
          .row("distance", &G::distance, positive("1/s"),
               "The closing speed wanted is this times the distance, far away less.")
          .row("speed", &G::speed, positive("1/s"), "Of the velocity error.")
          .row("most", &G::most, positive("m/s^2"), "Of the level acceleration.");
  return fields;
}

const Fields<guidance::VerticalGains>& vertical_fields() {
  using G = guidance::VerticalGains;
  static const Fields<G> fields =
      Fields<G>("vertical")
          .row("size", &G::size, positive("px"), "x_S wanted.")
          .row("size_band", &G::size_band, positive("px"), "Beside it nothing is done.")
          .row("size_near", &G::size_near, positive("px"), "So near it is driven.")
          .row("altitude", &G::altitude, positive("m"), "Wanted.")
          .row("altitude_band", &G::altitude_band, positive("m"), "Beside it at most.")
          .row("size_p", &G::size_p, positive(), "K_pS of (4.23).")
          .formerly("K_pS")
          .row("size_d", &G::size_d, not_negative(), "K_dS of (4.23).")
          .formerly("K_dS")
          .row("altitude_p", &G::altitude_p, positive("1/s^2"), "K_pz of (4.24).")
          .formerly("K_pz")
          .row("altitude_d", &G::altitude_d, not_negative("1/s"), "K_dz of (4.24).")
          .formerly("K_dz")
          .row("lock_p", &G::lock_p, positive("1/s^2"), "K_p of an altitude that is held.")
          .formerly("K_p_lock")
          .row("lock_d", &G::lock_d, not_negative("1/s"), "K_d of it.")
          .formerly("K_d_lock")
          .row("most", &G::most, positive("m/s^2"), "Of the acceleration up.");
  return fields;
}

const Fields<Pursuit>& law_fields() {
  using P = Pursuit;
  static const Fields<P> fields = Fields<P>("laws")
                                      .special("source",
                                               {{"title", "rendezvous or focal"},
                                                {"anyOf", {reference("rendezvous"), reference("focal")}}},
                                               read_source_law, "The source's.")
                                      .row("ours", &P::ours, mapping("law_ours", our_fields()), "Ours.")
                                      .row("vertical", &P::vertical, mapping("vertical", vertical_fields()),
                                           "Of the altitude, (4.17) to (4.24).", absent("none"));
  return fields;
}

Value<Eigen::Vector2d> variance() {
  return checked<Eigen::Vector2d>(vector<2>("m^2/s^4"), "positive numbers (m^2/s^4)",
                                  [](const Eigen::Vector2d& v) { return v.minCoeff() > 0; });
}

/// The rows of a SingerOptions that `filter` finds.
template <typename S, typename Filter>
Fields<S> filter_rows(const char* title, Filter filter) {
  using guidance::SingerOptions;
  return Fields<S>(title)
      .row("alpha", within_part(filter, &SingerOptions::alpha), not_negative("1/s"),
           "Of Singer's model (3.9).")
      .row("variance", within_part(filter, &SingerOptions::variance), variance(),
           "Of the acceleration, along x and y.");
}

const Fields<Pursuit>& source_filter_fields() {
  static const Fields<Pursuit> fields =
      filter_rows<Pursuit>("filter_source", &Pursuit::source_filter)
          .row("noise", &Pursuit::noise, positive("m^2"), "Of a measurement.")
          .row("hidden_noise", &Pursuit::hidden_noise, positive("m^2"),
               "Of the old estimate that stands in for one.");
  return fields;
}

const Fields<Pursuit>& our_filter_fields() {
  static const Fields<Pursuit> fields = filter_rows<Pursuit>("filter_ours", &Pursuit::our_filter)
                                            .row("own_noise", &Pursuit::own_noise, positive("m"),
                                                 "Deviation of the own position, beside the tracker's.");
  return fields;
}

/// A mapping whose fields are the pursuit's own.
auto part(const Fields<Pursuit>& fields) {
  return [&fields](const Json& v, const std::string& p, Pursuit& pursuit) { fields.read(v, p, pursuit); };
}

const Fields<Pursuit>& filter_fields() {
  static const Fields<Pursuit> fields =
      Fields<Pursuit>("filters")
          .special("source", reference("filter_source"), part(source_filter_fields()), "The source's.")
          .special("ours", reference("filter_ours"), part(our_filter_fields()), "Ours.");
  return fields;
}

void read_position(const Json& value, const std::string& path, Pursuit& pursuit) {
  pursuit.start.position = vector<3>("m").read(value, path);
  if (!(pursuit.start.position.z() > 0))
    throw InputError(path + "[2]", quoted(value[2]), "above the ground (m)");
}

const Fields<Pursuit>& uas_fields() {
  using P = Pursuit;
  const auto vehicle = [](const Json& v, const std::string& p, P& pursuit) {
    pursuit.vehicle = scenario::read_vehicle(v, p, true).model;
  };
  static const Fields<P> fields =
      Fields<P>("uas")
          .special("position", vector<3>("m").schema, read_position, "At the start, above the ground.",
                   required("[x, y, z] (m)"))
          .row("velocity", within_part(&P::start, &simulation::Motion::velocity), vector<3>("m/s"),
               "At the start.")
          .special("vehicle", {{"title", "a vehicle"}, {"$ref", "scenario.schema.json#/$defs/quadrotor"}},
                   vehicle, "`{kind: quadrotor}` and its fields ([scenarios](scenarios.md)).",
                   absent("a point mass at a constant altitude, whose camera does not tilt"))
          .row("source_steps", &P::source_steps, flag(),
               "A point mass moves by its new velocity for all of a step, as in the source's simulator.");
  return fields;
}

void read_uas(const Json& value, const std::string& path, Pursuit& pursuit) {
  uas_fields().read(value, path, pursuit);
  if (!pursuit.vehicle && pursuit.start.velocity.z() != 0)
    throw InputError(join(path, "velocity") + "[2]", to_text(pursuit.start.velocity.z()),
                     "0 without a vehicle: a point mass keeps its altitude");
}

/// A reader of vehicles; no two of them have one name.
auto cars(bool followed) {
  return [followed](const Json& value, const std::string& path, Pursuit& pursuit) {
    if (!value.is_array() || (followed && value.empty()))
      throw InputError(path, quoted(value), "a list of vehicles");
    for (std::size_t i = 0; i < value.size(); ++i) {
      CarFields car = car_fields().read(value[i], at(path, i));
      car.followed = followed;
      for (const Car& other : pursuit.cars)
        if (other.name == car.name) throw InputError(at(path, i) + ".name", car.name, "a name of its own");
      pursuit.cars.push_back(std::move(car));
    }
  };
}

Json list_of_cars(int least) {
  return {{"type", "array"}, {"items", reference("car")}, {"minItems", least}, {"title", "list of vehicles"}};
}

const Fields<InFolder<Pursuit>>& camera_fields() {
  using P = InFolder<Pursuit>;
  const auto source = [](const Json& v, const std::string& p, P& pursuit) {
    pursuit.source_view = read_view(v, p, pursuit.folder, source_view_fields());
    if (pursuit.eyes == Eyes::exact) pursuit.perspective_view = pursuit.source_view;
  };
  const auto perspective = [](const Json& v, const std::string& p, P& pursuit) {
    pursuit.perspective_view = read_view(v, p, pursuit.folder, view_fields());
  };
  static const Fields<P> fields =
      Fields<P>("cameras")
          .special("source", reference("source_camera"), source,
                   "The source's: straight down, north up, clean.")
          .special("perspective", reference("camera"), perspective, "A real one.");
  return fields;
}

void read_cameras(const Json& value, const std::string& path, InFolder<Pursuit>& pursuit) {
  camera_fields().read(value, path, pursuit);
  const bool source =
      pursuit.eyes == Eyes::source || (pursuit.eyes == Eyes::exact && !value.contains("perspective"));
  require_field(value, path, source ? "source" : "perspective", "a camera, that of --camera");
}

const Fields<InFolder<Pursuit>>& pursuit_fields() {
  using P = InFolder<Pursuit>;
  static const Fields<P> fields =
      Fields<P>("pursuit")
          .row("name", &P::name, text("a name"), "Of the pursuit.", absent("the file's"))
          .row("duration", &P::duration, positive("s"), "Of the run.")
          .row("step", &P::step, positive("s"), "Between two commands.")
          .row("picture_step", &P::picture_step, positive("s"),
               "Between two pictures, a whole number of steps.")
          .special("uas", reference("uas"), read_uas, "What flies.", required("a mapping with position"))
          .special("cars", list_of_cars(1), cars(true),
                   "That are followed; all are whole in the first picture.", required("a list of vehicles"))
          .special("decoys", list_of_cars(0), cars(false), "That are not.")
          .special("cameras", reference("cameras"), read_cameras,
                   "The one of `--camera`, `perspective` if not given, must be there; the other may be left "
                   "out.",
                   required("a mapping with source and perspective"))
          .special("laws", reference("laws"), part(law_fields()),
                   "One of `source` and `ours` is used: `--law`.")
          .special("filters", reference("filters"), part(filter_fields()),
                   "Of the vehicles' states: `source` with the source's tracker, `ours` with ours.")
          .row("side", &P::side, positive("m"),
               "Of the square around every vehicle, which the ellipse holds.")
          .row("give_up", &P::give_up, positive("s"),
               "A vehicle that is hidden for so long is left out of the ellipse.")
          .row("seed", &P::seed, count(0, kMostSeed), "Of all noise and of the bars.");
  return fields;
}

struct SeenFields : CameraFields, SeenBy {
  SeenFields() : SeenBy{{}, 0.04} {}
};

const Fields<SeenFields>& seen_fields() {
  using S = SeenFields;
  using O = PerceptionOptions;
  const auto of = [](auto O::*member) { return within_part(&SeenBy::perception, member); };
  const auto filter = [](auto guidance::SingerOptions::*member) {
    return [member](S & seen) -> auto& { return seen.perception.filter.*member; };
  };
  static const Fields<S> fields =
      camera_rows<S>("camera")
          .row("focal", &CameraFields::focal, positive("px"), "In place of field_of_view_deg.")
          .row("vehicle_height", of(&O::height), not_negative("m"), "Of the middle of a vehicle.")
          .row("alpha", filter(&guidance::SingerOptions::alpha), not_negative("1/s"), "Of Singer's model.")
          .row("variance", filter(&guidance::SingerOptions::variance), variance(), "Of the acceleration.")
          .row("noise", of(&O::noise), positive("m^2"), "Of a measurement.")
          .row("hidden_noise", of(&O::hidden_noise), positive("m^2"), "Of an old estimate.")
          .row("own_noise", of(&O::own_noise), positive("m"), "Of the own position.")
          .row("picture_step", &SeenBy::picture_step, positive("s"), "Between two pictures.")
          .row("filters", of(&O::source), choice<bool>({{"source", true}, {"ours", false}}), "Whose.");
  return fields;
}

}  // namespace

Pursuit read_pursuit(const Json& fields, const std::string& name, const std::filesystem::path& folder,
                     Eyes eyes) {
  if (!fields.is_object())
    throw InputError("pursuit", quoted(fields), "a mapping with uas, cars and cameras");
  InFolder<Pursuit> read{{}, folder};
  read.name = name;
  read.eyes = eyes;
  pursuit_fields().read(fields, "", read);
  const Pursuit& pursuit = read;
  const auto followed =
      std::count_if(pursuit.cars.begin(), pursuit.cars.end(), [](const Car& car) { return car.followed; });
  if (pursuit.source_law == SourceLaw::rendezvous && followed != 1)
    throw InputError("laws.source.kind", "rendezvous", "focal: rendezvous is for one car");
  const double ratio = pursuit.picture_step / pursuit.step;
  if (!(ratio > 0.5) || std::abs(ratio - std::round(ratio)) > 1e-6)
    throw InputError("picture_step", to_text(pursuit.picture_step), "a whole number of steps (s)");
  return pursuit;
}

Json pursuit_schema() {
  Json schema = pursuit_fields().schema();
  Json& names = schema["$defs"];
  for (const Json& part : {camera_fields().schema(), uas_fields().schema(), car_fields().schema(),
                           ground_fields().schema(), bar_fields().schema(), occluder_fields().schema(),
                           mount_fields().schema(), source_view_fields().schema(), view_fields().schema(),
                           law_fields().schema(), rendezvous_fields().schema(), focal_fields().schema(),
                           our_fields().schema(), vertical_fields().schema(), filter_fields().schema(),
                           source_filter_fields().schema(), our_filter_fields().schema()})
    names[part["title"].get<std::string>()] = part;
  return input::schema_of("a pursuit", "vericone pursue PURSUIT.yaml, docs/reference/pursuits.md.",
                          std::move(schema));
}

SeenBy read_perception(const Json& fields) {
  if (!fields.is_object()) throw InputError("camera", quoted(fields), "a mapping with width, height, ...");
  SeenFields seen;
  seen_fields().read(fields, "", seen);
  seen.perception.camera = camera_of(seen, fields, "");
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

namespace vericone::vision {

Pursuit read_pursuit(const std::string& file, Eyes eyes) {
  const std::filesystem::path path = file;
  const Json fields = input::read_scene_fields(file);
  input::require_kind(fields, input::FileKind::pursuit, file);
  return pursuit::read_pursuit(fields, plain_text(path.stem().string()), path.parent_path(), eyes);
}

}  // namespace vericone::vision
