// A body with dents against a box: answers are right, or `undecided` near the boundary. What to do then.
#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main() {
  const Placed box(HullBody::box({-1, -1, -1}, {1, 1, 1}));
  const Placed dented(CombinedEllipsoid(Ellipsoid::from_axes({8, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.5, 1, 1})}));
  const Pair pair(box, dented), finer(box, dented, {.tolerance = 1e-5});
  const Eigen::Vector3d still(0, 0, 0);
  double in = 0, out = 1;  // slopes dy/dx of the velocity: the first collides, the second does not
  while (pair.verdict({1, (in + out) / 2, 0}, still) != Verdict::undecided)
    (pair.verdict({1, (in + out) / 2, 0}, still) == Verdict::in ? in : out) = (in + out) / 2;
  const Eigen::Vector3d w(1, (in + out) / 2, 0);
  std::cout << "undecided at the slope " << w.y() << ", where features below " << pair.guarantee().tolerance
            << " of a body count\n";
  std::cout << "to be safe: " << (may_collide(pair.verdict(w, still)) ? "a collision" : "no collision") << '\n';
  const Miss miss = pair.miss(w, still);
  std::cout << "in metres: passes at " << miss.least << " to " << miss.most << " m, proved\n";
  std::cout << "with the tolerance 1e-5: " << to_string(finer.verdict(w, still)) << '\n';
}
