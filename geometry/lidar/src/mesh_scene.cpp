// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/lidar/lidar.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "embree.h"
#include "float_environment.h"

namespace vericone::lidar {
namespace {

using Eigen::Vector3d;

/// Boxes are widened by this part of the scene's radius. Rays start on the scene's sphere, so all floats are
/// below 2 radii: rounding of origin, direction and box and that of the box test stay below 1e-6.
constexpr double kWiden = 4e-6;

/// A ray against triangles in double, after Woop, Benthin, Wald (2013): the corners are sheared to the plane
/// across the ray, each by itself, and a product of two of them decides on the side of an edge, whose sign
/// rounding can turn into zero but not into the other one; zero counts as hit.
class Ray {
 public:
  Ray(const Vector3d& origin, const Vector3d& direction) : origin_(origin) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    if (direction(z_) < 0) std::swap(x_, y_);
    shear_ = Vector3d(direction(x_), direction(y_), 1) / direction(z_);
  }

  /// The range, or NaN.
  double range(const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    const Vector3d p = sheared(a), q = sheared(b), r = sheared(c);
    const double u = r.x() * q.y() - r.y() * q.x(), v = p.x() * r.y() - p.y() * r.x(),
                 w = q.x() * p.y() - q.y() * p.x();
    const bool positive = u > 0 || v > 0 || w > 0, negative = u < 0 || v < 0 || w < 0;
    if (positive == negative) return std::nan("");  // outside, or all zero: seen edge on
    return (u * p.z() + v * q.z() + w * r.z()) / (u + v + w);
  }

 private:
  Vector3d sheared(const Vector3d& corner) const {
    const Vector3d v = corner - origin_;
    return {v(x_) - shear_.x() * v(z_), v(y_) - shear_.y() * v(z_), shear_.z() * v(z_)};
  }

  Vector3d origin_, shear_;
  int x_ = 0, y_ = 0, z_ = 0;
};

}  // namespace

struct MeshScene::Parts {
  std::vector<Vector3d> points;
  std::vector<Triangle> triangles;
  Vector3d center = Vector3d::Zero();
  double radius = 1;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Parts() = default;
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    const FloatEnvironment environment;
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  void build();
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void intersect(const RTCIntersectFunctionNArguments* arguments);
};

namespace {

/// What goes with a ray through Embree: the search in double. The first member is what Embree sees.
template <typename Parts>
struct Search {
  RayContext context;
  const Parts& parts;
  Ray ray;
  double offset, least, most;  // the float ray starts `offset` metres along the ray
  std::optional<Hit> best;

  float float_range(double range) const {
    return static_cast<float>((range - offset) / parts.radius + kWiden);
  }
};

}  // namespace

void MeshScene::Parts::bounds(const RTCBoundsFunctionArguments* arguments) {
  const Parts& parts = *static_cast<const Parts*>(arguments->geometryUserPtr);
  const Triangle& t = parts.triangles[arguments->primID];
  const Vector3d &a = parts.points[t[0]], &b = parts.points[t[1]], &c = parts.points[t[2]];
  const Vector3d low = (a.cwiseMin(b).cwiseMin(c) - parts.center) / parts.radius,
                 high = (a.cwiseMax(b).cwiseMax(c) - parts.center) / parts.radius;
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = static_cast<float>(low.x() - kWiden);
  box.lower_y = static_cast<float>(low.y() - kWiden);
  box.lower_z = static_cast<float>(low.z() - kWiden);
  box.upper_x = static_cast<float>(high.x() + kWiden);
  box.upper_y = static_cast<float>(high.y() + kWiden);
  box.upper_z = static_cast<float>(high.z() + kWiden);
}

void MeshScene::Parts::intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  auto& search = *reinterpret_cast<Search<Parts>*>(arguments->context);
  const Parts& parts = search.parts;
  const Triangle& t = parts.triangles[arguments->primID];
  const double range = search.ray.range(parts.points[t[0]], parts.points[t[1]], parts.points[t[2]]);
  if (!(range >= search.least && range <= search.most)) return;
  auto& best = search.best;
  if (best && !(range < best->range || (range == best->range && arguments->primID < best->triangle))) return;
  best = Hit{range, arguments->primID};
  auto& ray = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // N = 1
  ray.ray.tfar = std::min(ray.ray.tfar, search.float_range(range));
  ray.hit.geomID = arguments->geomID;
  ray.hit.primID = arguments->primID;
}

void MeshScene::Parts::build() {
  const FloatEnvironment environment;
  device = rtcNewDevice("threads=1,set_affinity=0");
  if (!device) throw std::runtime_error("Embree does not start");
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, &Parts::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &Parts::intersect);
  rtcCommitGeometry(geometry);
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree could not build a hierarchy of " + std::to_string(triangles.size()) +
                             " triangles");
}

MeshScene::MeshScene(std::span<const Vector3d> points, std::span<const Triangle> triangles)
    : parts_(std::make_unique<Parts>()) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError(
          "points[" + std::to_string(i) + "]",
          "[" + to_text(points[i].x()) + ", " + to_text(points[i].y()) + ", " + to_text(points[i].z()) + "]",
          "finite");
  if (triangles.empty() || triangles.size() > 0xfffffffe)
    throw InputError("triangles", std::to_string(triangles.size()), "1 to 4294967294 of them");
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t corner : triangles[i]) {
      if (corner >= points.size())
        throw InputError("triangles[" + std::to_string(i) + "]", std::to_string(corner),
                         "indices below the number of points, " + std::to_string(points.size()));
      low = low.cwiseMin(points[corner]);
      high = high.cwiseMax(points[corner]);
    }
  parts_->points.assign(points.begin(), points.end());
  parts_->triangles.assign(triangles.begin(), triangles.end());
  parts_->center = 0.5 * low + 0.5 * high;
  parts_->radius = (high - parts_->center).norm();
  if (parts_->radius == 0) parts_->radius = 1;
  // Squares of it are needed, and rays are floats of its size.
  if (!(parts_->radius > 1e-100 && parts_->radius < 1e100))
    throw InputError("points", "a mesh of radius " + to_text(parts_->radius), "between 1e-100 and 1e100 (m)");
  parts_->build();
}

MeshScene::~MeshScene() = default;
MeshScene::MeshScene(MeshScene&&) noexcept = default;
MeshScene& MeshScene::operator=(MeshScene&&) noexcept = default;

std::optional<Hit> MeshScene::first_hit(const Vector3d& origin, const Vector3d& direction, double least,
                                        double most) const {
  const FloatEnvironment environment;
  const Parts& parts = *parts_;
  // From where the ray enters the scene's sphere: floats of the scene's size whatever the distance.
  const Vector3d to_center = parts.center - origin;
  const double along = to_center.dot(direction), reach = 1.001 * parts.radius,
               away = (to_center - along * direction).norm();
  if (!(away <= reach) || !(most >= least)) return std::nullopt;
  const double offset = std::max(0.0, along - std::sqrt((reach - away) * (reach + away)));

  Search<Parts> search{{}, parts, Ray(origin, direction), offset, least, most, {}};
  const Vector3d start = (offset * direction - to_center) / parts.radius;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x());
  ray.ray.org_y = static_cast<float>(start.y());
  ray.ray.org_z = static_cast<float>(start.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tnear = static_cast<float>(std::max(0.0, (least - offset) / parts.radius - kWiden));
  ray.ray.tfar = search.float_range(std::min(most, along + reach));
  ray.ray.mask = 0xffffffff;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  lidar::first_hit(parts.scene, search.context, ray);
  return search.best;
}

bool MeshScene::sees(const Vector3d& eye, const Vector3d& point, double margin) const {
  const Vector3d way = point - eye;
  const double distance = way.norm();
  return !(distance > margin) || !first_hit(eye, way / distance, 0, distance - margin);
}

}  // namespace vericone::lidar
