/* A drone that flies past a ball on its way: 100 steps a second, nothing allocated in the loop. */
#include <stdio.h>
#include <vericone_c.h>

int main(void) {
  const double origin[3] = {0, 0, 0}, axes[3] = {0.4, 0.4, 0.15}, radii[3] = {1, 1, 1}, goal[3] = {20, 0, 0};
  const double step = 0.01, still[3] = {0, 0, 0}, at[3] = {10, 0.3, 0};
  vericone_body* drone = vericone_body_ellipsoid(origin, axes, NULL);
  vericone_body* ball = vericone_body_ellipsoid(origin, radii, NULL);
  vericone_pair* pair = vericone_pair_new(drone, origin, NULL, ball, at, NULL, 0);
  vericone_navigator* navigator = vericone_navigator_new(0.3, 4, 0); /* keeps 0.3 m; 4 m/s^2 */
  vericone_moving agent = {.body = drone, .velocity = {5, 0, 0}};
  const vericone_moving other = {.body = ball, .position = {10, 0.3, 0}};
  if (vericone_sound_arithmetic() != VERICONE_OK || !drone || !ball || !pair || !navigator) {
    fprintf(stderr, "%s\n", vericone_error());
    return 1;
  }
  vericone_contact contact;
  if (vericone_pair_contact(pair, agent.velocity, still, &contact) == 1)
    printf("straight on it would hit after %.3f s\n", contact.time);

  double least = 1e9;
  vericone_command command = {.status = VERICONE_HOMING};
  for (double t = 0; agent.position[0] < goal[0] - 1 && t < 10; t += step) {
    if (vericone_navigator_step(navigator, &agent, &other, 1, goal, 4, t, step, &command) < 0) break;
    if (command.least < least) least = command.least;
    for (int i = 0; i < 3; ++i) {
      agent.position[i] += step * (agent.velocity[i] + 0.5 * step * command.acceleration[i]);
      agent.velocity[i] += step * command.acceleration[i];
    }
  }
  printf("passed, at least %.2f m away, status %d\n", least, (int)command.status);

  vericone_navigator_free(navigator);
  vericone_pair_free(pair);
  vericone_body_free(ball);
  vericone_body_free(drone);
  return 0;
}
