# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read off the headers: which module has what, which templates are instantiated, what is left out and
why, what takes long. A public name that is neither bound nor here stops the build."""
from __future__ import annotations

import re

# Headers below these folders are in these modules; the first that fits.
MODULES = [
    ("geometry/files", "_files"), ("geometry/octomap", "_octomap"), ("geometry/fitting", "_fitting"),
    ("geometry/lidar", "_lidar"), ("geometry", "_core"), ("cones", "_core"), ("guidance", "_core"),
    ("scenes/fit", "_fitting"), ("scenes/scan", "_lidar"), ("scenes/pursuits", "_vision"), ("scenes", "_files"), ("vision", "_vision"),
    ("verify", "_verify"),
]
# Where the public headers are, in folders named include.
FOLDERS = ["geometry", "geometry/files", "geometry/octomap", "geometry/fitting", "geometry/lidar", "cones", "guidance",
           "guidance/simulation", "guidance/vehicles", "guidance/swarm", "guidance/ships", "scenes", "scenes/work", "scenes/scenarios", "scenes/fit", "scenes/scan", "scenes/pursuits",
           "vision", "vision/scene", "vision/footage", "vision/pursuit"]
# Headers whose functions may take one or many.
MANY_FOLDERS = ("geometry/include", "cones/include", "guidance/include")

DIMENSIONS = ("D", "N", "M")
INSTANCES = {
    "BasicEllipsoid": [("Ellipse", ("2",)), ("Ellipsoid", ("3",))],
    "BasicQuadric": [("Conic", ("2",)), ("Quadric", ("3",))],
    "BasicCombined": [("CombinedEllipse", ("2",)), ("CombinedEllipsoid", ("3",))],
    "guidance::Belief": [("Belief6", ("6",))],
    "guidance::Innovation": [("Innovation2", ("2",)), ("Innovation6", ("6",))],
    # Of both dimensions, with their number behind the name.
    **{name: [(name.split("::")[-1] + n, (n,)) for n in "23"]
       for name in ("Delimiter", "DelimiterRate", "MinVolumeResult", "exact::RationalBody", "guidance::Cartesian")},
}

# C++ name: why Python has none.
SKIPPED: dict[str, str] = {name: why for why, names in {
    "a template of C++ for those who write predicates": "climb decided_by",
    "what pilots of C++ are told and are; pilot_by() flies a function of Python":
        "simulation::PilotModel::launch simulation::PilotModel::check",
    "refers to the pilot; most_commanded() and guarded() say what it is": "simulation::model_of",
    "counts by tags, which are types of C++; a Python program counts the rungs that it is given": "rung_counts",
    "a pointer; bodies are rigid here": "SpatialMotion::rate_a SpatialMotion::rate_b",
    "messages of Python programs are read by who has them":
        "guidance::vector_of guidance::pose_of guidance::state_of guidance::write_vector",
    "takes pointers; reach() asks it for a scenario": "simulation::earliest_passages",
    "Ctrl-C and progress= end long work in Python": "Stop StopScope stop_of_this_thread stop_requested checkpoint",
    "KeyboardInterrupt stands for it": "Interrupted",
    "InputError of the package: a ValueError with field, value and requirement": "InputError",
    "takes a tracker for its own; pursue() makes one": "vision::Perception",
    "asked when the package is imported": "require_sound_arithmetic",
    "list() of the enumeration has them": "kBodyKinds verify::kAllSpatialFamilies verify::kAllPlanarFamilies",
    "looks at nothing; a pickle is looked at": "BasicEllipsoid::trusted BasicCombined::trusted",
    "0.25 m and 15 m, the bins of Counts.least_distances": "montecarlo::kBin montecarlo::kLastBin",
    "medians by number of planes, as C++ has them; print() says them": "verify::SpatialFamilyReport::gap_medians",
    "a template by its result; the package vericone reads bodies from scenes": "verify::CorpusCase::body",
    "a template by its result; exact.RationalBody3 takes any Ellipsoid": "verify::CorpusCase::rational_body",
    "a template by its result; numbers() has the text of each": "verify::CorpusCase::vector",
    "exact.RationalBody3 takes any Ellipsoid": "exact::defining_shape",
    "takes a stream of C++; files are read by name": "verify::read_corpus",
    "a number of planes that only C++ counts by": "verify::kGapSamples",
}.items() for name in names.split()}
# The same of all names that end so.
SKIPPED_KINDS: list[tuple[re.Pattern[str], str]] = [
    (re.compile(r"^(?!ConeOracle::naive_membership$)(.*::)?(triage|interval|naive|exact)_(?!relation$)\w+$"),
     "one rung of a ladder: the name without it climbs them all"),
    (re.compile(r"(^|::)to_string$"), "an enumeration prints its name"),
    (re.compile(r"^simulation::Leg::(accelerated$|(most|first|last)_)"), "bounds that proofs ask for"),
    (re.compile(r"^PlaneCones::(opening_slope|tolerance|smooth)$|^widest_vectors$"), "what the library asks itself"),
    (re.compile(r"^guidance::PlaneFilters::\w+$"), "guide() makes and asks them, in its memory"),
]
# (C++ name, types of the parameters without "vericone::"): why Python has not this overload.
SKIPPED_OVERLOADS: dict[tuple[str, str], str] = {
    ("ConeOracle::memberships", parameters): "membership() takes arrays of any strides"
    for parameters in ("const double *, std::ptrdiff_t, std::span<Membership>, VectorWidth",
                       "std::span<const Eigen::Vector3d>, std::span<Membership>, VectorWidth")
} | {("min_volume_ellipsoid", "const std::vector<Eigen::Matrix<double, D, 1>> &, const MinVolumeOptions &"):
     "points are rows of one array in Python"}

# Enumerations and records that are filled in through a pointer where the caller asks: rung=True.
ASKED = ("vericone::Rung",)
# Records whose names end so are not questions: they are not taken as lists.
NOT_QUESTIONS = ("Options", "Memory", "Gains", "Parameters", "Limits")
# Functions that may take more than a few tenths of a second: they can be interrupted. Beside them, all that
# take lists, where these are long.
LONG: set[str] = {f"{space}::{name}".removeprefix("::") for space, names in {
    "": "Assembly::boxes Assembly::cloud Assembly::mesh Assembly::polyhedra Body::containing_ellipsoid "
        "MeshWindow::cone Pair::cone combined_slice_cone cone_bounds cone_map enclosed_volume min_volume_ellipsoid part "
        "probability_of_passing_through regions region_around rims slice_cone surface to_obj to_ply true_cone "
        "visible_cone volume",
    "guidance": "all_planes", "files": "read_points triangle_mesh write_points", "fits": "read_scan write_fit describe",
    "octomap": "obstacle_boxes read_octree",
    "fitting": "check enclose fit hull_to_scan scan_to_hull volume enclosed_volume",
    "lidar": "MeshScene::MeshScene fuse raster scan spinning visible_part",
    "ships": "sail",
    "scanning": "look read_scan_scene scan_and_study study write_scan",
    "scenario": "campaign_rows fly_campaign read_scenario read_tracks scenario_of_text tracks_of_text write_run",
    "scenes": "read_body read_scene scene_of_text write_body write_scene",
    "simulation": "Arc::Arc certify fitted_track greatest Track::advance Vehicle::advance curves_of fly_trial largest_current prove prove_passage "
                  "reach run_tables simulate",
    "swarm": "Swarm::Swarm Swarm::step fly start_amid start_of",
    "vision": "Image::Image Reader::next Scene::Scene Scene::render Tracker::start Tracker::step VideoWriter::add "
              "VideoWriter::close draw_sighting grey_of open_footage pursue read_picture read_pursuit write_picture",
}.items() for name in names.split()}
# Calls of C++ for many vectors at once, by the function for one and its number of parameters.
WHOLE = {("ConeOracle::membership", 1): "memberships"}
# Methods whose results refer to the object.
KEEPS_SELF = {"simulation::VehicleModel::launch"}
# Classes whose const calls change what nobody sees: one call at a time too.
MACHINES = {"PlaneCones"}

# What virtual functions require, of which C++ has many definitions: the condition, of `self` and the parameters; which
# input breaks it, what was given, what would be right. All others say it themselves (requirements.py).
REQUIRES: dict[str, tuple[str, str, str, str]] = {
    "simulation::Vehicle::advance": ("from >= 0 && to >= from && to - from <= 1e5", "to", "no time after from",
                                     "from the time reached, to a later one, less than 1e5 s on"),
    "vision::Tracker::step": ("!ground || ground->allFinite()", "ground", "a number that is not finite",
                              "finite, or None"),
}
# Types that the library checks itself, if asked, and by what: every argument of theirs, and lists of them, are.
CHECKED: dict[str, str] = {f"vericone::guidance::{name}": "vericone::guidance::check"
                           for name in ("BodyState", "ClearanceOptions", "GuideOptions", "LawOptions")}
