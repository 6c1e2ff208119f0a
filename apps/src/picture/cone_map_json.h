// SPDX-License-Identifier: BSD-3-Clause
//
// Cone maps as JSON for apps/figures/cone_map.py.
#pragma once

#include <vericone/cones/map/cone_map.h>
#include <string>

#include "json/json_forward.h"

namespace vericone {

/// What the picture needs, to be written as `cone_map.json` into the folder given to draw_figures:
/// {"title", "towards", "colliding", "safe", "undecided", "asked", "complete", "resolution", "corners",
///  "cells": [[i, j, k]], "labels": "ios...", "region": {...} or null}
/// `towards` != 0: the direction of the middle of the picture, whose region is outlined. Solid angles in
/// steradian, `labels` one letter a cell: i(n), o(ut), u(ndecided).
Json cone_map_json(const ConeMap& map, const Eigen::Vector3d& towards, double resolution,
                   const std::string& title = "");

}  // namespace vericone
