// SPDX-License-Identifier: BSD-3-Clause
//
// What a node does with an odometry and the poses of obstacles: one command a message. The structs stand for geometry_msgs,
// whose members have the same names; the functions of vericone take those as they are.
#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

namespace geometry_msgs::msg {
struct Vector3 {
  double x = 0, y = 0, z = 0;
};
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
struct Pose {
  Vector3 position;
  Quaternion orientation;
};
struct Twist {
  Vector3 linear, angular;
};
}  // namespace geometry_msgs::msg
namespace msg = geometry_msgs::msg;

class Avoider {
 public:
  /// Twists in the world's axes.
  msg::Vector3 command(const msg::Pose& pose, const msg::Twist& twist, const std::vector<msg::Pose>& obstacles, double now) {
    others_.clear();
    for (const msg::Pose& at : obstacles) others_.push_back(guidance::state_of(ball_, at, msg::Twist{}));
    const auto step = navigator_.step(guidance::state_of(own_, pose, twist), others_, guidance::Destination{{20, 0, 0}, 4}, now,
                                      0.01);
    msg::Vector3 acceleration;
    guidance::write_vector(step.acceleration, acceleration);
    return acceleration;
  }

 private:
  Body own_ = Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.4, 0.15}), ball_ = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  guidance::Navigator navigator_{{.required = 0.3, .most = 4}};
  std::vector<guidance::BodyState> others_;
};

int main() {
  Avoider avoider;
  msg::Pose pose, obstacle;
  msg::Twist twist;
  twist.linear.x = 5;
  obstacle.position = {10, 0.3, 0};
  const msg::Vector3 a = avoider.command(pose, twist, {obstacle}, 0);
  std::cout << "turns with " << a.x << ", " << a.y << ", " << a.z << " m/s^2\n";
}
