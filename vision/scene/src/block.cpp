// SPDX-License-Identifier: BSD-3-Clause
#include "block.h"

#include <algorithm>
#include <cmath>

namespace vericone::vision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Block block_of(const VehicleLook& look, const PlacedVehicle& placed) {
  return {placed.position, 0.5 * look.size.head<2>(), placed.heading, 0, look.size.z(), false};
}

Block block_of(const Occluder& occluder) {
  return {occluder.centre, 0.5 * occluder.size, 0, occluder.bottom, occluder.top, occluder.top <= 0};
}

std::vector<Vector3d> Block::corners() const {
  const double c = std::cos(heading), s = std::sin(heading);
  std::vector<Vector3d> all;
  for (const double z : {bottom, top})
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      all.emplace_back(centre.x() + c * x * half.x() - s * y * half.y(),
                       centre.y() + s * x * half.x() + c * y * half.y(), z);
  return all;
}

BlockView::BlockView(const Block& block, const Camera& camera, const Pose& pose) : block_(block) {
  const double c = std::cos(block.heading), s = std::sin(block.heading);
  Matrix3d axes;  // rows: of the block
  axes << c, s, 0, -s, c, 0, 0, 0, 1;
  eye_ = axes * (pose.position - Vector3d(block.centre.x(), block.centre.y(), 0));
  Matrix3d inner;
  inner << 1 / camera.focal, 0, -camera.centre.x() / camera.focal, 0, 1 / camera.focal,
      -camera.centre.y() / camera.focal, 0, 0, 1;
  direction_ = axes * pose.rotation * inner;
  span_ = {0, 0, camera.width - 1, camera.height - 1};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
  for (const Vector3d& corner : block.corners()) {
    const auto pixel = camera.project(pose.to_body(corner));
    if (!pixel) return;
    low = low.cwiseMin(*pixel);
    high = high.cwiseMax(*pixel);
  }
  box_ = {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  const auto within = [](double x, int most) { return int(std::clamp(x, -1.0, most + 1.0)); };
  span_.left = std::max(span_.left, within(std::floor(low.x() + 0.5), camera.width));
  span_.top = std::max(span_.top, within(std::floor(low.y() + 0.5), camera.height));
  span_.right = std::min(span_.right, within(std::ceil(high.x() - 0.5), camera.width));
  span_.bottom = std::min(span_.bottom, within(std::ceil(high.y() - 0.5), camera.height));
}

BlockView::Slabs BlockView::slabs(const Vector3d& direction) const {
  const Vector3d low(-block_.half.x(), -block_.half.y(), block_.bottom),
      high(block_.half.x(), block_.half.y(), block_.top);
  Slabs slabs{0, kMissed, Face::level};
  for (int i = 0; i < 3; ++i) {
    const double d = direction[i] == 0 ? 1e-300 : direction[i];
    double in = (low[i] - eye_[i]) / d, out = (high[i] - eye_[i]) / d;
    if (in > out) std::swap(in, out);
    if (in > slabs.near) slabs = {in, slabs.far, Face(i)};
    slabs.far = std::min(slabs.far, out);
  }
  return slabs;
}

BlockView::Hit BlockView::hit(double u, double v) const {
  const Vector3d direction = direction_ * Vector3d(u, v, 1);
  const Slabs in = slabs(direction);
  if (in.near > in.far) return {};
  return {in.near, in.face, eye_ + in.near * direction};
}

double BlockView::depth(double u, double v) const {
  const Slabs in = slabs(direction_ * Vector3d(u, v, 1));
  if (in.near > in.far) return kMissed;
  return block_.covers ? 0 : in.near;
}

}  // namespace vericone::vision
