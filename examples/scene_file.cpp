// What does a scene file say, and will its bodies meet? Needs vericone::scenes:
// find_package(vericone 0.1 REQUIRED COMPONENTS scenes)
#include <vericone/scenes/scene.h>
#include <iostream>
using namespace vericone;

int main(int count, char** arguments) {
  const scenes::Scene scene = scenes::read_scene(count > 1 ? arguments[1] : "scene.yaml");
  const Pair pair = scene.pair();
  std::cout << scene.agent.name << ", " << scene.obstacle.name << ": "
            << to_string(pair.verdict(scene.agent.velocity, scene.obstacle.velocity)) << '\n';
}
