// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/certificate.h>
#include <string>

#include "common.h"

using namespace vericone;
using namespace vericone::c;

extern "C" {

int64_t vericone_pair_certificate(const vericone_pair* pair, const double agent_velocity[3],
                                  const double obstacle_velocity[3], double from, double until, char* text,
                                  size_t capacity) {
  return answered([&] {
    const Certificate found =
        given(pair, "pair")
            .pair.certificate(vector(agent_velocity, "agent_velocity"),
                              vector(obstacle_velocity, "obstacle_velocity"), Horizon{from, until});
    if (capacity > 0) given(text, "text");
    const std::string& told = found.text.empty() ? found.reason : found.text;
    if (capacity > 0) text[told.copy(text, capacity - 1)] = '\0';
    return int64_t(found.text.size());
  });
}

}  // extern "C"
