// A mesh of one's own as an obstacle: own_mesh FILE (OFF, OBJ, PLY, STL). Links vericone::files as well.
#include <vericone/files/files.h>
#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main(int, char** arguments) {
  try {
    const files::TriangleMesh mesh = files::triangle_mesh(files::read_points(arguments[1]));
    const Placed obstacle(Assembly::mesh(mesh.points, mesh.triangles));
    const Placed drone(Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.4, 0.15}));
    const Pair pair(drone, obstacle);
    const Eigen::Vector3d still(0, 0, 0);
    for (const Eigen::Vector3d& velocity : {Eigen::Vector3d(4, 0.5, 0.25), Eigen::Vector3d(4, 0, 1)}) {
      std::cout << to_string(pair.verdict(velocity, still));
      if (const auto contact = pair.contact(velocity, still)) std::cout << " after " << contact->time << " s\n";
      else std::cout << ", passes at " << pair.miss(velocity, still).least << " m or more\n";
    }
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
