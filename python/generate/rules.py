# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read off the headers: which module has what, which templates are instantiated, what is left out and
why, what takes one or many, what takes long. A public name that is neither bound nor here stops the build."""
from __future__ import annotations

# Headers below these folders are in these modules; the first that fits.
MODULES = [
    ("geometry/files", "_files"), ("geometry/octomap", "_octomap"), ("geometry/fitting", "_fitting"),
    ("geometry/lidar", "_lidar"), ("geometry", "_core"), ("cones", "_core"), ("guidance", "_core"),
    ("scenes/fit", "_fitting"), ("scenes/scan", "_lidar"), ("scenes", "_files"), ("vision", "_vision"), ("verify", "_verify"),
]
# Where the public headers are, in folders named include.
FOLDERS = ["geometry", "geometry/files", "geometry/octomap", "geometry/fitting", "geometry/lidar", "cones", "guidance",
           "guidance/simulation", "guidance/vehicles", "scenes", "scenes/scenarios", "scenes/fit", "scenes/scan", "vision", "vision/scene", "vision/footage",
           "vision/pursuit"]
# Headers whose functions may take one or many.
MANY_FOLDERS = ("geometry/include", "cones/include", "guidance/include")

DIMENSIONS = ("D", "N", "M")
INSTANCES = {
    "BasicEllipsoid": [("Ellipse", ("2",)), ("Ellipsoid", ("3",))],
    "BasicQuadric": [("Conic", ("2",)), ("Quadric", ("3",))],
    "BasicCombined": [("CombinedEllipse", ("2",)), ("CombinedEllipsoid", ("3",))],
    "Delimiter": [("Delimiter2", ("2",)), ("Delimiter3", ("3",))],
    "DelimiterRate": [("DelimiterRate2", ("2",)), ("DelimiterRate3", ("3",))],
    "NearestPoints": [("NearestPoints2", ("2",)), ("NearestPoints3", ("3",))],
    "MinVolumeResult": [("MinVolumeResult2", ("2",)), ("MinVolumeResult3", ("3",))],
    "exact::RationalBody": [("RationalBody2", ("2",)), ("RationalBody3", ("3",))],
    "ContactFrame": [("ContactFrame2", ("2",)), ("ContactFrame3", ("3",))],
    "SymmetricEigen": [("SymmetricEigen2", ("2",)), ("SymmetricEigen3", ("3",))],
    "Cholesky": [("Cholesky2", ("2",)), ("Cholesky3", ("3",))],
    "LeftSingular": [("LeftSingular2", ("2",)), ("LeftSingular3", ("3",))],
    "verify::CgalMinEllipsoid": [("CgalMinEllipsoid2", ("2",)), ("CgalMinEllipsoid3", ("3",))],
    "verify::MinEllipsoidComparison": [("MinEllipsoidComparison2", ("2",)), ("MinEllipsoidComparison3", ("3",))],
    "guidance::Cartesian": [("Cartesian2", ("2",)), ("Cartesian3", ("3",))],
    "guidance::Belief": [("Belief2", ("2",)), ("Belief6", ("6",))],
    "guidance::Innovation": [("Innovation1", ("1",)), ("Innovation2", ("2",)), ("Innovation6", ("6",))],
}
FUNCTION_INSTANCES: dict[str, list[tuple[str, ...]]] = {
    "guidance::predict": [("2",), ("6",)],
    "guidance::correct": [("2", "1"), ("6", "1"), ("6", "2"), ("6", "6")],
    "guidance::error_squared": [("2",), ("6",)],
}

# C++ name: why Python has none.
SKIPPED: dict[str, str] = {
    "climb": "a template of C++ for those who write predicates",
    "decided_by": "a template of C++ for those who write predicates",
    "rung_counts": "counts by tags, which are types of C++; a Python program counts the rungs that it is given",
    "SpatialMotion::rate_a": "a pointer; bodies are rigid here, SectorPlanes and PlaneCones take those that change",
    "SpatialMotion::rate_b": "a pointer; bodies are rigid here, SectorPlanes and PlaneCones take those that change",
    "simulation::earliest_passages": "takes pointers; reach() asks it for a scenario",
    "Stop": "Ctrl-C and progress= end long work in Python",
    "StopScope": "Ctrl-C and progress= end long work in Python",
    "stop_of_this_thread": "Ctrl-C and progress= end long work in Python",
    "stop_requested": "Ctrl-C and progress= end long work in Python",
    "checkpoint": "Ctrl-C and progress= end long work in Python",
    "Interrupted": "KeyboardInterrupt stands for it",
    "vision::Perception::Perception": "takes a tracker for its own; pursue() makes one",
    "verify::SpatialFamilyReport::gap_medians": "medians by number of planes, as C++ has them; print() says them",
    "verify::CorpusCase::body": "a template by its result; the package vericone reads bodies from scenes",
    "verify::CorpusCase::rational_body": "a template by its result; exact.RationalBody3 takes any Ellipsoid",
    "verify::CorpusCase::vector": "a template by its result; numbers() has the text of each",
    "verify::read_corpus": "takes a stream of C++; files are read by name",
    "verify::kAllSpatialFamilies": "list(SpatialFamily) has them",
    "verify::kAllPlanarFamilies": "list(PlanarFamily) has them",
    "verify::kGapSamples": "a number of planes that only C++ counts by",
    "kBodyKinds": "list(BodyKind) has them",
    "BasicEllipsoid::trusted": "looks at nothing; a pickle has a body bit for bit, and is looked at",
    "BasicCombined::trusted": "looks at nothing; a pickle has a body bit for bit, and is looked at",
    "montecarlo::kUnlimited": "what Flown.guide has of a law without saturation",
    "montecarlo::kBin": "0.25 m, the width of a bin of Counts.least_distances",
    "montecarlo::kLastBin": "15 m, where the last bin of Counts.least_distances begins",
    "InputError": "InputError of the package: a ValueError with field, value and requirement",
}
# (C++ name, types of the parameters): why Python has not this overload.
SKIPPED_OVERLOADS: dict[tuple[str, str], str] = {
    ("ConeOracle::memberships", parameters): "membership() takes arrays of any strides"
    for parameters in ("const double *, std::ptrdiff_t, std::span<Membership>, vericone::VectorWidth",
                       "std::span<const Eigen::Vector3d>, std::span<Membership>, vericone::VectorWidth")
} | {("min_volume_ellipsoid", "const std::vector<Eigen::Matrix<double, D, 1>> &, const vericone::MinVolumeOptions &"): "points are rows of one array in Python"}

# Enumerations and records that are filled in through a pointer where the caller asks: rung=True.
ASKED = ("vericone::Rung", "vericone::Effort")
# Records whose names end so are not questions: they are not taken as lists.
NOT_QUESTIONS = ("Options", "Memory", "Gains", "Parameters", "Limits")
# Functions that take one only, although their parameters look like questions.
SINGLE: set[str] = set()
# Functions that may take more than a few tenths of a second: they can be interrupted. Beside them, all that
# take lists, where these are long.
LONG: set[str] = {
    "Assembly::boxes", "Assembly::cloud", "Assembly::mesh", "Assembly::polyhedra", "AssemblyOracle::extremes", "Body::containing_ellipsoid",
    "Hierarchy::Hierarchy", "MeshWindow::cone", "Pair::cone", "Pair::directions", "combined_cone", "combined_slice_cone", "cone_bounds",
    "cone_map", "convex_reach", "enclosed_volume", "mesh_section", "min_volume_ellipsoid", "part",
    "plane_intervals", "probability_of_passing_through", "regions", "region_around", "rims", "slice_cone",
    "surface", "to_obj", "to_ply", "true_cone", "visible_cone", "volume",
    *(f"exact::{name}" for name in ("between_positive_roots", "distinct_positive_roots", "gcd", "positive_roots", "real_roots", "real_roots_in",
                                    "squarefree_part", "sturm_chain", "RealRoot::RealRoot", "RealRoot::refine")),
    "guidance::all_planes",
    "files::read_points", "files::triangle_mesh", "files::write_points", "octomap::boxes_by_kind", "octomap::obstacle_boxes", "octomap::read_octree",
    "fits::read_scan", "fits::write_fit", "fitting::check", "fitting::enclose", "fitting::fit", "fitting::containing_fit", "fitting::fit_surface",
    "fitting::convex_hull", "fitting::hull_to_scan", "fitting::scan_to_hull", "fitting::volume",
    "fitting::enclosed_volume", "fits::body_text", "fits::describe",
    "lidar::MeshScene::MeshScene", "lidar::fuse", "lidar::raster", "lidar::scan", "lidar::spinning", "lidar::visible_part",
    "scanning::look", "scanning::plane_section_picture", "scanning::read_scan_scene", "scanning::scan_and_study", "scanning::scan_text",
    "scanning::study", "scanning::write_scan",
    "scenario::read_scenario", "scenario::scenario_of_text", "scenario::write_run",
    "scenes::read_body", "scenes::read_scene", "scenes::scene_of_text", "scenes::write_body", "scenes::write_scene",
    "simulation::Arc::Arc", "simulation::Track::advance", "simulation::Vehicle::advance", "simulation::curves_of", "simulation::fly_trial",
    "simulation::largest_current", "simulation::prove", "simulation::prove_passage", "simulation::reach", "simulation::run_tables", "simulation::simulate",
    "montecarlo::fly", "montecarlo::fly_straight",
    "vision::Image::Image", "vision::Perception::start", "vision::Perception::step", "vision::Reader::next", "vision::Scene::Scene",
    "vision::Scene::render", "vision::Tracker::start", "vision::Tracker::step", "vision::VideoWriter::add", "vision::VideoWriter::close",
    "vision::draw_sighting", "vision::grey_of", "vision::open_footage", "vision::pursue", "vision::read_picture", "vision::write_picture",
}
# Calls of C++ for many vectors at once, by the function for one and its number of parameters.
WHOLE = {("ConeOracle::membership", 1): "memberships"}
# Methods whose results refer to the object.
KEEPS_SELF = {"simulation::VehicleModel::launch"}
# Classes whose const calls change what nobody sees: one call at a time too.
MACHINES = {"PlaneCones"}

# What C++ requires of its callers, where a release does not look: C++ name: condition in C++, of the object `self` and of
# the parameters; which input breaks it, what was given, what would be right. "name/3": of its overload with three parameters.
_TRIMMED = "(!{0}.empty() && {0}.back() != 0)"
REQUIRES: dict[str, tuple[str, str, str, str]] = {
    **{f"guidance::SetMembershipFilter::{name}": ("self.started()", "filter", "no measurement", "one that has met a measurement")
       for name in ("position", "velocity", "position_radius", "velocity_radius")},
    "guidance::SetMembershipFilter::axis": ("self.started() && i >= 0 && i < 3", "i", "no such axis, or no measurement",
                                            "0, 1 or 2, of a filter that has met a measurement"),
    "lidar::BeamPattern::direction": ("beam < self.size()", "beam", "no such beam", "below size()"),
    "vision::Image::Image/3": ("w > 0 && h > 0 && (c == 1 || c == 3) && double(w) * h < 1e9", "size", "no size of a picture",
                             "w x h pixels of 1 or 3 channels"),
    "simulation::Vehicle::advance": ("from_ >= 0 && to >= from_ && to - from_ <= 1e5", "to", "no time after from", "from the time reached, to a "
                                     "later one, less than 1e5 s on"),
    "Interval::Interval/2": ("rad >= 0", "rad", "less", "0 or more"),
    "Interval::between": ("!(lo > hi)", "lo", "above hi", "at most hi"),
    "guidance::robust_correction": ("(vericone::guidance::check(model, options), low <= high)", "low, high", "others", "low <= high"),
    "guidance::outer_loop": ("most >= 0", "most", "less", "0 or more (m/s^2)"),
    "guidance::all_planes": ("planes >= 1", "planes", "less", "at least 1"),
    "guidance::choose_plane": ("options.planes >= 1 && options.planes <= 10'000", "options.planes", "others", "from 1 to 10000"),
    "guidance::planar_rates": ("state.r > 0", "state.r", "no positive number", "positive (m)"),
    **{f"guidance::{name}": ("across.allFinite() && a.position != b.position && "
                             "((a.planar() && b.planar()) || !(b.position - a.position).cross(across).isZero(0))",
                             "across", "bodies in one place, or a direction along their line", "across the line between bodies apart")
       for name in ("plane_states", "plane_view")},
    "exact::Dyadic::power_of_two": ("std::abs(double(exponent)) <= 100'000", "exponent", "an exponent beyond", "between -100000 and 100000"),
    "exact::RealRoot::refine": ("bits <= 100'000", "bits", "more", "at most 100000"),
    "exact::RealRoot::RealRoot/3": (
        "[](const auto& q, const auto& from, const auto& to) { using namespace vericone::exact; return q && !q->empty() && q->back() != 0 && "
        "compare(from, to) < 0 && (from.numerator >= 0 || to.numerator <= 0) && sign_at(*q, from) * sign_at(*q, to) < 0 && "
        "sign_changes_at(sturm_chain(*q), from) - sign_changes_at(sturm_chain(*q), to) == 1; }(p, lo, hi)",
        "p, lo, hi", "no root, or several", "a polynomial with one simple root between lo and hi, which have one sign"),
    "exact::between": ("compare(lo, hi) < 0 && (lo.numerator >= 0 || hi.numerator <= 0)", "lo, hi", "others", "lo < hi, of one sign"),
    "exact::Dyadic::of": ("std::isfinite(finite)", "finite", "no finite number", "finite"),
    "exact::grid_exponent": ("std::isfinite(x)", "x", "no finite number", "finite"),
    "exact::on_grid": ("std::isfinite(x) && std::abs(e) <= 10000 && (x == 0 || e <= vericone::exact::grid_exponent(x, e))", "x, e",
                       "no such number, or a grid beyond doubles", "a finite multiple of 2^e, e between -10000 and 10000"),
    "AssemblyOracle::extreme": ("std::abs(axis.squaredNorm() - 1) < 1e-9 && std::abs(side.squaredNorm() - 1) < 1e-9 && std::abs(axis.dot(side)) < 1e-9",
                                "axis, side", "others", "orthonormal"),
    "simulation::paired": ("first.size == second.size", "second", "another number of them", "as many as first has"),
    "octomap::kind_of": ("!std::isnan(cell.log_odds)", "cell.log_odds", "nan", "a number"),
    "guidance::singer_noise": ("std::isfinite(alpha) && alpha > 0 && variance >= 0 && std::isfinite(variance) && dt >= 0 && std::isfinite(dt)",
                               "alpha, variance, dt", "others", "finite: alpha positive (1/s), variance and dt (s) from 0 up"),
    "vision::Tracker::step": ("!ground || ground->allFinite()", "ground", "a number that is not finite", "finite, or None"),
    "exact::direction_on_grid": ("[](const auto& x) { if constexpr (requires { x.allFinite(); }) return x.allFinite(); else return true; }(v)", "v",
                                 "a number that is not finite", "finite"),
    "exact::difference_on_grid": ("x.allFinite() && y.allFinite()", "x, y", "a number that is not finite", "finite"),
    "ConeMap::cell": ("i < self.cells.size() && std::ranges::all_of(self.cells[i].corners, [&](auto k) { return k < self.corners.size(); })", "i",
                      "no such cell, or corners that the map does not have", "a cell of a map as cone_map() returns it"),
    "Assembly::piece": ("i < self.size()", "i", "no such piece", "below size()"),
    "least_squares": ("a.rows() == b.size()", "b", "another number of rows than a has", "of as many numbers as a has rows"),
    "shortest_least_squares": ("a.rows() == b.size()", "b", "another number of rows than a has", "of as many numbers as a has rows"),
    "solve_square": ("a.rows() == a.cols() && a.rows() == b.size() && a.rows() <= 16", "a", "a matrix of another shape",
                     "square, of at most 16 rows, as many as b has numbers"),
    "mesh_section": ("std::ranges::all_of(points, [](const auto& x) { return x.allFinite(); }) && std::ranges::all_of(triangles, "
                     "[&](const auto& t) { return std::ranges::all_of(t, [&](auto k) { return k < points.size(); }); })",
                     "triangles", "corners that are no points, or not finite", "indices of finite points"),
    "convex_reach": ("oracle.relation() == Relation::disjoint && oracle.obstacle().size() == 1", "oracle", "another pair",
                     "of disjoint bodies, the obstacle of one piece"),
    "files::are_collinear": ("a.allFinite() && b.allFinite() && c.allFinite()", "a, b, c", "a number that is not finite", "finite"),
    "Opening::depth": ("point.allFinite()", "point", "a number that is not finite", "finite (m)"),
    **{f"{oracle}::exact_membership": ("v_a.allFinite() && v_b.allFinite()", "velocity", "a number that is not finite", "finite (m/s)")
       for oracle in ("ConeOracle", "HullOracle", "SectorOracle")},
    "exact_side": ("point.allFinite()", "point", "a number that is not finite", "finite"),
    "exact_earlier": ("p.w.allFinite() && q.w.allFinite()", "w", "a number that is not finite", "finite (m/s)"),
    "exact_facing_orifice_transit": ("center_line.allFinite() && w.allFinite() && std::isfinite(agent_radius) && std::isfinite(opening_radius)",
                                     "center_line, w", "a number that is not finite", "finite"),
    **{f"vehicles::{name}": ("(vericone::vehicles::check(quadrotor), true)", "quadrotor", "no options", "as check() asks")
       for name in ("quadrotor_rates", "thrust_and_tilt", "quadrotor_wrench")},
    "exact_time_to_contact": ("v_a.allFinite() && v_b.allFinite()", "velocity", "a number that is not finite", "finite (m/s)"),
    "OrificeOracle::exact_transit": ("w.allFinite()", "w", "a number that is not finite", "finite (m/s)"),
    "simulation::mesh_track": ("orifice.window != nullptr", "orifice", "no window", "with a window"),
    **{f"exact::{name}": (_TRIMMED.format("p"), "p", "no number, or a leading 0", "coefficients of which the last is not 0")
       for name in ("real_roots", "real_roots_in", "positive_roots", "sturm_chain", "squarefree_part", "distinct_positive_roots",
                    "between_positive_roots")},
    **{f"exact::{name}": (f"{_TRIMMED.format('p')} && {_TRIMMED.format('q')}", "p, q", "no number, or a leading 0",
                          "coefficients of which the last is not 0")
       for name in ("gcd", "surely_coprime")},
    "exact::log2_floor": ("[](const auto& n) { if constexpr (requires { n.numerator; }) return n.numerator != 0; else return n != 0; }(x)", "x", "0", "another number than 0"),
    **{f"exact::sign_changes_at_{where}": ("std::ranges::none_of(chain, [](const auto& f) { return f.empty(); })", "chain",
                                           "a part without coefficients", "of polynomials with coefficients")
       for where in ("zero", "infinity")},
    "simulation::share_of": ("successes <= trials && confidence > 0 && confidence < 1", "successes", "more than there are trials, or no confidence",
                             "at most the trials, with a confidence between 0 and 1"),
    "exact::divide_exactly": (f"{_TRIMMED.format('p')} && {_TRIMMED.format('q')} && p.size() >= q.size()", "q", "no divisor of p",
                              "a divisor of p, with a last coefficient that is not 0"),
}
# The same of every argument of a type: condition of the argument {0}; which part of it, what was given, what would be right.
REQUIRES_OF_TYPES: dict[str, tuple[str, str, str, str]] = {
    "vericone::exact::Dyadic": ("{0}.exponent <= 100'000", "exponent", "more", "at most 100000"),
    "vericone::PlaneFrame": ("{0}.origin.allFinite() && {0}.x_axis.allFinite() && {0}.y_axis.allFinite()", "frame",
                             "a number that is not finite", "finite"),
}
# Types that the library checks itself, if it is asked to, and by what: every argument of theirs, and lists of them, are.
CHECKED: dict[str, str] = {f"vericone::guidance::{name}": "vericone::guidance::check" for name in ("BodyState", "ClearanceOptions", "GuideOptions",
                                                                                              "LawOptions")}
