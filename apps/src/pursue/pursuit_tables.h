// SPDX-License-Identifier: BSD-3-Clause
//
// What a pursuit leaves behind, as tables (docs/reference/pursuits.md).
#pragma once

#include <vericone/vision/pursuit/pursuit.h>
#include <string>

#include "json/json_forward.h"

namespace vericone::pursuit {

/// t, place, velocity and commands of the UAS, the laws' outputs, the ellipse, the camera's view; a row a
/// picture.
std::string uas_csv(const vision::PursuitRun& run);
/// A row a vehicle and picture: true, measured and estimated, against the UAS and on the ground; boxes.
std::string cars_csv(const vision::Pursuit& pursuit, const vision::PursuitRun& run);
/// What the UAS knows of its own camera: a row a picture, for `track --own`.
std::string own_csv(const vision::PursuitRun& run);
/// What it believes of the vehicles: a row a vehicle and picture; `track --own` writes the same.
std::string estimates_csv(std::size_t frame, double t, const std::vector<vision::Followed>& vehicles);
std::string estimates_header();
/// Seconds of every picture's work.
std::string times_csv(const vision::PursuitRun& run);
/// True boxes: frame, id, x, y, w, h, visible part.
std::string truth_csv(const vision::PursuitRun& run);
std::string hidden_csv(const vision::Pursuit& pursuit, const vision::PursuitRun& run);

}  // namespace vericone::pursuit
