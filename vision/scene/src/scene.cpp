// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/vision/scene/scene.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "block.h"
#include "ground.h"
#include "look.h"
#include "polygon.h"

namespace vericone::vision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Towards the sun's shadow: m aside for every m up.
const Vector2d kShadow(0.55, 0.4);
constexpr float kShade = 0.55f;

std::string at(const char* list, std::size_t i, const char* field) {
  return std::string(list) + "[" + std::to_string(i) + "]." + field;
}

void require(bool good, const std::string& field, double value, const char* what) {
  if (!good) throw InputError(field, to_text(value), what);
}

void check(const std::vector<Occluder>& occluders) {
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    const Occluder& o = occluders[i];
    require(o.centre.allFinite(), at("occluders", i, "centre"), o.centre.sum(), "finite numbers (m)");
    require(o.size.allFinite() && o.size.minCoeff() > 0, at("occluders", i, "size"), o.size.minCoeff(),
            "positive finite numbers (m)");
    require(o.bottom >= 0 && o.bottom <= o.top && std::isfinite(o.top), at("occluders", i, "bottom"),
            o.bottom, "0 or more, at most top (m)");
    require(o.texture >= 0 && o.texture <= 1, at("occluders", i, "texture"), o.texture, "from 0 to 1");
    require(o.from <= o.to, at("occluders", i, "to"), o.to, "a time not before from (s)");
  }
}

void check(const SceneOptions& options) {
  const Image& picture = options.ground.picture;
  if (!picture.empty() &&
      (picture.width < 2 || picture.height < 2 || (picture.channels != 1 && picture.channels != 3)))
    throw InputError("ground.picture",
                     std::to_string(picture.width) + " x " + std::to_string(picture.height) + " x " +
                         std::to_string(picture.channels),
                     "2 x 2 pixels or more, of 1 or 3 channels");
  const double m = options.ground.metres_per_pixel;
  require(m > 0 && std::isfinite(m), "ground.metres_per_pixel", m, "a positive finite number (m)");
  require(options.ground.marks >= 0 && options.ground.marks <= 1e6, "ground.marks", options.ground.marks,
          "from 0 to 1000000 (1/km^2)");
  for (std::size_t i = 0; i < options.vehicles.size(); ++i) {
    const Vector3d& size = options.vehicles[i].size;
    require(size.allFinite() && size.head<2>().minCoeff() > 0 && size.z() >= 0, at("vehicles", i, "size"),
            size.minCoeff(), "a positive length and width, a height of 0 or more (m)");
  }
  check(options.occluders);
  require(options.noise >= 0 && options.noise <= 60, "noise", options.noise, "from 0 to 60 grey levels");
  require(options.blur >= 0 && options.blur <= 20, "blur", options.blur, "from 0 to 20 px");
  require(options.exposure >= 0 && options.exposure <= 1, "exposure", options.exposure, "from 0 to 1 s");
  require(options.light > 0 && options.light <= 4, "light", options.light, "above 0, at most 4");
  require(options.channels == 1 || options.channels == 3, "channels", options.channels, "1 (grey) or 3");
}

/// A picture that colours are laid on.
struct Canvas {
  Image& image;

  void lay(int u, int v, const Colour& colour, float share) const {
    std::uint8_t* p = &image.data[(std::size_t(v) * image.width + u) * image.channels];
    if (share == 1 && image.channels == 1) {
      *p = std::uint8_t(grey(colour) + 0.5f);
      return;
    }
    const auto mix = [&](std::uint8_t& to, float value) {
      to = std::uint8_t(std::clamp(float(to) + share * (value - float(to)) + 0.5f, 0.0f, 255.0f));
    };
    if (image.channels == 1) {
      mix(*p, grey(colour));
      return;
    }
    for (int k = 0; k < 3; ++k) mix(p[k], colour[k]);
  }
  void darken(int u, int v, float share) const {
    std::uint8_t* p = &image.data[(std::size_t(v) * image.width + u) * image.channels];
    for (int k = 0; k < image.channels; ++k)
      p[k] = std::uint8_t(float(p[k]) * (1 - share * (1 - kShade)) + 0.5f);
  }
};

/// Colour of what a ray hits on a vehicle.
Colour colour_of(const Look& look, const BlockView& view, const BlockView::Hit& hit) {
  const Vector2d half = view.block().half;
  if (hit.face == Face::level)
    return look.roof(0.5 + 0.5 * hit.place.x() / half.x(), 0.5 - 0.5 * hit.place.y() / half.y());
  const double high = hit.place.z() / view.block().top;
  const bool flank = hit.face == Face::across;
  return (flank ? 1.0f : 0.85f) *
         look.side(0.5 + 0.5 * (flank ? hit.place.x() / half.x() : hit.place.y() / half.y()), high);
}

/// Samples of a pixel's side: as many as make a hundredth of a small vehicle's pixels matter.
int samples_for(const Box& box) {
  const double size = std::max(box.w, box.h);
  return size < 64 ? 4 : size < 160 ? 3 : 2;
}

/// Whether another block is before a depth on the ray of (u, v).
bool hidden(const std::vector<const BlockView*>& others, double u, double v, double depth) {
  return std::any_of(others.begin(), others.end(),
                     [&](const BlockView* other) { return other->depth(u, v) < depth; });
}

std::vector<const BlockView*> near(const std::vector<BlockView>& blocks, const BlockView& self) {
  std::vector<const BlockView*> found;
  for (const BlockView& block : blocks)
    if (&block != &self && block.span().meets(self.span())) found.push_back(&block);
  return found;
}

void draw_vehicle(const Canvas& canvas, const Look& look, const BlockView& view,
                  const std::vector<BlockView>& occluders) {
  if (view.box().w <= 0) return;
  const std::vector<const BlockView*> before = near(occluders, view);
  const int n = samples_for(view.box());
  const Span2& span = view.span();
  for (int v = span.top; v <= span.bottom; ++v)
    for (int u = span.left; u <= span.right; ++u) {
      Colour sum = Colour::Zero();
      int hits = 0;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double x = u + (i + 0.5) / n - 0.5, y = v + (j + 0.5) / n - 0.5;
          const BlockView::Hit hit = view.hit(x, y);
          if (hit.depth == BlockView::kMissed || hidden(before, x, y, hit.depth)) continue;
          sum += colour_of(look, view, hit);
          ++hits;
        }
      if (hits > 0) canvas.lay(u, v, sum / float(hits), float(hits) / float(n * n));
    }
}

}  // namespace

struct Scene::Parts {
  explicit Parts(const SceneOptions& given)
      : options((check(given), given)), ground(given.ground, given.channels) {
    options.ground.picture = {};
    for (const VehicleLook& vehicle : options.vehicles) looks.emplace_back(vehicle.seed);
  }

  void check_view(const Camera& camera, std::span<const PlacedVehicle> vehicles) const {
    if (!(camera.width > 0 && camera.height > 0 && double(camera.width) * camera.height <= 1e8))
      throw InputError("camera", std::to_string(camera.width) + " x " + std::to_string(camera.height) + " px",
                       "from 1 to 1e8 pixels");
    if (vehicles.size() != options.vehicles.size())
      throw InputError("vehicles", std::to_string(vehicles.size()),
                       std::to_string(options.vehicles.size()) + ", as many as the scene has");
  }

  std::vector<Block> present(double t) const {
    std::vector<Block> blocks;
    for (const Occluder& occluder : options.occluders)
      if (t >= occluder.from && t <= occluder.to) blocks.push_back(block_of(occluder));
    return blocks;
  }

  void shadow(const Canvas& canvas, const Camera& camera, const Pose& pose, const Block& block) const {
    if (block.top <= 0) return;
    Polygon outline;
    std::vector<Vector3d> flat;
    for (const Vector3d& corner : block.corners())
      outline.emplace_back(corner.head<2>() + corner.z() * kShadow);
    for (const Vector2d& p : hull_of(outline)) flat.emplace_back(p.x(), p.y(), 0);
    fill(seen(camera, pose, flat), camera.width, camera.height,
         [&](int u, int v, double share) { canvas.darken(u, v, float(share)); });
  }

  void draw_occluder(const Canvas& canvas, const Camera& camera, const Pose& pose, const Block& block,
                     double texture) const {
    const std::vector<Vector3d> corners = block.corners();
    const std::vector<Vector3d> bottom(corners.begin(), corners.begin() + 4),
        top(corners.begin() + 4, corners.end());
    const Colour roof(172, 178, 180), wall(84, 86, 90);
    // All of its outline as a wall, and the top on it: no gap between faces.
    if (block.top > block.bottom) {
      Polygon all;
      const auto add = [&](const std::vector<Vector3d>& face) {
        const Polygon part = seen(camera, pose, face);
        all.insert(all.end(), part.begin(), part.end());
      };
      add(bottom);
      add(top);
      for (std::size_t i = 0; i < 4; ++i) add({bottom[i], bottom[(i + 1) % 4], top[(i + 1) % 4], top[i]});
      if (all.size() >= 3)
        fill(hull_of(all), camera.width, camera.height,
             [&](int u, int v, double share) { canvas.lay(u, v, wall, float(share)); });
    }
    if (!(pose.position.z() > block.top)) return;
    const Polygon face = seen(camera, pose, top);
    if (texture == 0) {
      fill(face, camera.width, camera.height,
           [&](int u, int v, double share) { canvas.lay(u, v, roof, float(share)); });
      return;
    }
    const double metres = (pose.position.z() - block.top) / camera.focal;
    fill(face, camera.width, camera.height, [&](int u, int v, double share) {
      const auto place = ground_point(camera, pose, {double(u), double(v)}, block.top);
      // Another part of the ground's picture than the one below.
      const float relief = place ? ground.relief(place->x() + 77, place->y() + 131, metres) : 0;
      canvas.lay(u, v, roof * (1 + float(texture) * relief), float(share));
    });
  }

  std::vector<BlockView> views(const std::vector<Block>& blocks, const Camera& camera,
                               const Pose& pose) const {
    std::vector<BlockView> all;
    all.reserve(blocks.size());
    for (const Block& block : blocks) all.emplace_back(block, camera, pose);
    return all;
  }

  std::vector<Block> blocks_of(std::span<const PlacedVehicle> vehicles, double earlier) const {
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      PlacedVehicle placed = vehicles[i];
      placed.position -= earlier * placed.velocity;
      blocks.push_back(block_of(options.vehicles[i], placed));
    }
    return blocks;
  }

  /// One instant, `earlier` s before the picture's time for what moves.
  void draw(const Camera& camera, const Pose& pose, std::span<const PlacedVehicle> vehicles, double t,
            double earlier, Image& image) const {
    const Canvas canvas{image};
    ground.draw(camera, pose, image);
    std::vector<Block> blocks = present(t);
    std::vector<double> textures;
    for (const Occluder& occluder : options.occluders)
      if (t >= occluder.from && t <= occluder.to) textures.push_back(occluder.texture);
    const std::vector<Block> cars = blocks_of(vehicles, earlier);
    if (options.shadows) {
      for (const Block& block : cars) shadow(canvas, camera, pose, block);
      for (const Block& block : blocks) shadow(canvas, camera, pose, block);
    }
    std::vector<std::size_t> order(blocks.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return blocks[a].top < blocks[b].top; });
    for (const std::size_t i : order) draw_occluder(canvas, camera, pose, blocks[i], textures[i]);
    const std::vector<BlockView> before = views(blocks, camera, pose), seen_cars = views(cars, camera, pose);
    order.resize(cars.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return seen_cars[a].eye().squaredNorm() > seen_cars[b].eye().squaredNorm();
    });
    for (const std::size_t i : order) draw_vehicle(canvas, looks[i], seen_cars[i], before);
  }

  /// How far the ground moves in the picture while it is exposed, px.
  static double motion(const Camera& camera, const Pose& from, const Pose& to) {
    double most = 0;
    for (const double u : {0.0, camera.width - 1.0})
      for (const double v : {0.0, camera.height - 1.0}) {
        const auto place = ground_point(camera, to, {u, v});
        const auto was = place ? camera.project(from.to_body(*place)) : std::nullopt;
        if (was) most = std::max(most, (*was - Vector2d(u, v)).norm());
      }
    return most;
  }

  void exposed(const Camera& camera, const Pose& pose, std::span<const PlacedVehicle> vehicles, double t,
               Image& image, const Pose& before) {
    double moved = motion(camera, before, pose);
    for (const PlacedVehicle& vehicle : vehicles)
      moved = std::max(moved, options.exposure * vehicle.velocity.norm() * camera.focal /
                                  std::max(1.0, pose.position.z()));
    constexpr int kMost = 8;
    const int instants = std::clamp(int(std::ceil(moved)) + 1, 1, kMost);
    if (instants == 1) {
      draw(camera, pose, vehicles, t, 0, image);
      return;
    }
    sum.assign(image.data.size(), 0);
    const Eigen::Quaterniond from(before.rotation), to(pose.rotation);
    for (int k = 0; k < instants; ++k) {
      const double share = (k + 0.5) / instants;
      const Pose now{
          before.position + share * (pose.position - before.position),
          before.rotation == pose.rotation ? pose.rotation : from.slerp(share, to).toRotationMatrix()};
      draw(camera, now, vehicles, t, (1 - share) * options.exposure, image);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = std::uint16_t(sum[i] + image.data[i]);
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      image.data[i] = std::uint8_t((sum[i] + instants / 2) / instants);
  }

  /// A field of noise, larger than the picture, from a place of its own in every frame.
  void add_noise(std::uint64_t frame, Image& image) {
    constexpr int kLarger = 257;
    const int width = image.width * image.channels + kLarger, height = image.height + kLarger;
    if (noise.cols != width || noise.rows != height) {
      noise.create(height, width, CV_8S);
      cv::RNG random(mixed(options.seed, 0x6e6f));
      cv::Mat field(height, width, CV_32F);
      random.fill(field, cv::RNG::NORMAL, 0, options.noise);
      field.convertTo(noise, CV_8S);
    }
    const std::uint64_t place = mixed(options.seed, frame);
    const int left = int(place % kLarger), top = int((place >> 32) % kLarger);
    const int row = image.width * image.channels;
    for (int v = 0; v < image.height; ++v) {
      std::uint8_t* p = &image.data[std::size_t(v) * row];
      const std::int8_t* n = noise.ptr<std::int8_t>(v + top) + left;
      for (int u = 0; u < row; ++u) p[u] = std::uint8_t(std::clamp(p[u] + n[u], 0, 255));
    }
  }

  SceneOptions options;
  GroundPicture ground;
  std::vector<Look> looks;
  cv::Mat noise;
  std::vector<std::uint16_t> sum;
};

Scene::Scene(const SceneOptions& options) : parts_(std::make_unique<Parts>(options)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::render(const Camera& camera, const Pose& pose, std::span<const PlacedVehicle> vehicles, double t,
                   std::uint64_t frame, Image& image, const Pose* before) {
  const SceneOptions& options = parts_->options;
  parts_->check_view(camera, vehicles);
  if (image.width != camera.width || image.height != camera.height || image.channels != options.channels)
    image = Image(camera.width, camera.height, options.channels);
  if (options.exposure > 0)
    parts_->exposed(camera, pose, vehicles, t, image, before ? *before : pose);
  else
    parts_->draw(camera, pose, vehicles, t, 0, image);
  cv::Mat picture(image.height, image.width, options.channels == 1 ? CV_8UC1 : CV_8UC3, image.data.data());
  if (options.blur > 0) cv::GaussianBlur(picture, picture, {}, options.blur);
  if (options.light != 1) picture.convertTo(picture, -1, options.light);
  if (options.noise > 0) parts_->add_noise(frame, image);
}

std::vector<VehicleTruth> Scene::truth(const Camera& camera, const Pose& pose,
                                       std::span<const PlacedVehicle> vehicles, double t) const {
  parts_->check_view(camera, vehicles);
  const std::vector<BlockView> cars = parts_->views(parts_->blocks_of(vehicles, 0), camera, pose),
                               occluders = parts_->views(parts_->present(t), camera, pose);
  std::vector<VehicleTruth> truth;
  for (const BlockView& car : cars) {
    VehicleTruth& now = truth.emplace_back(VehicleTruth{car.box(), 0});
    if (!(now.box.w > 0)) continue;
    std::vector<const BlockView*> others = near(occluders, car);
    for (const BlockView* other : near(cars, car)) others.push_back(other);
    constexpr int kRays = 32;
    int all = 0, visible = 0;
    for (int j = 0; j < kRays; ++j)
      for (int i = 0; i < kRays; ++i) {
        const double u = now.box.x + now.box.w * (i + 0.5) / kRays,
                     v = now.box.y + now.box.h * (j + 0.5) / kRays;
        const double depth = car.depth(u, v);
        if (depth == BlockView::kMissed) continue;
        ++all;
        if (camera.sees({u, v}) && !hidden(others, u, v, depth)) ++visible;
      }
    now.visible = all > 0 ? double(visible) / all : 0;
  }
  return truth;
}

void Scene::set_occluders(std::vector<Occluder> occluders) {
  check(occluders);
  parts_->options.occluders = std::move(occluders);
}

}  // namespace vericone::vision
