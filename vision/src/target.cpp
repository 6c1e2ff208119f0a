// SPDX-License-Identifier: BSD-3-Clause
#include "target.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace vericone::vision {
namespace {

constexpr int kMostPoints = 14;
constexpr double kReturn = 0.7;           // px, there and back
constexpr double kStill = 1.5;            // px: less is no motion over the ground
constexpr double kFirstSpeed = 0.2;       // own sizes a picture, standard deviation of what is not known yet
constexpr double kChange = 1;             // own sizes a second, of the velocity in a second
constexpr double kMeasured = 0.3;         // px, standard deviation of a measured centre,
constexpr double kMeasuredOfSize = 0.01;  // and of its own size: a walker's swings
constexpr double kTurnRate = 0.5, kScaleRate = 0.6;  // rad/s and 1/s over the ground
constexpr double kTurnMemory = 0.5;                  // s, over which a target's turning is told from a wobble
constexpr double kTurnStep = 0.003, kScaleStep = 0.002;  // from picture to picture besides
constexpr double kGate = 13.8;         // squared standard deviations: 1 in 1000 is beyond, of two dimensions
constexpr double kHalfHiddenGate = 4;  // of one that looks less like itself
constexpr double kLeast = 0.3;         // correlation of all pixels, whatever agrees closely
constexpr double kKeep = 0.5, kRegain = 0.7;  // correlations
constexpr double kVisible = 0.45, kWhole = 0.8;
constexpr double kShared = 0.3;       // overlap with another target that is seen
constexpr double kClearlyBetter = 4;  // squared standard deviations
constexpr double kRivals = 4;         // own sizes: how far others that look the same are looked for
constexpr double kRivalEvery = 0.4;   // s, after which they are looked for again
constexpr double kRivalMemory = 6;    // s, for which one that is not seen is taken to be still there
constexpr int kMostAlike = 4;
constexpr double kFormFree = 3;     // times the usual change of form, of what is found again
constexpr double kFarWait = 0.5;    // s, of one at the edge of the gate
constexpr double kAloneWait = 0.1;  // the same where nothing that looks like it was seen beside it
constexpr double kNear = 2;         // squared standard deviations
constexpr int kStrict = 1, kPoints = 2, kExpected = 3;  // slack of looks
constexpr double kMostReach = 40;                       // samples to each side that one picture's search goes
constexpr int kKnown = 3;                               // pictures after which a first velocity is known
constexpr double kConfirm = 0.1;  // s for which a regained target must go on as expected
// Own sizes: bodies do not enter each other, so that what looks like the target so near to where it just was
// is the target, wherever it was expected.
constexpr double kItself = 0.6;
constexpr double kOnward = 1.25;      // of its way of late: how far it may have gone another way
constexpr double kBetter = 0.1;       // of correlations
constexpr double kRoam = 3;           // s, for which it is looked for about where it was seen last
constexpr double kUnrestMemory = 10;  // pictures

int slack_of(double far) { return far < kNear ? kExpected : kStrict; }

double size_of(const Box& box) { return std::sqrt(box.w * box.h); }

Eigen::Vector2d shifted(const cv::Point2f& p, const cv::Point& by) {
  return {double(p.x) + by.x, double(p.y) + by.y};
}

Eigen::Matrix2d round_covariance(double deviation) {
  return Eigen::Matrix2d::Identity() * deviation * deviation;
}

}  // namespace

Target::Target(const cv::Mat& grey, const Box& box, const TrackerOptions& options, std::size_t number)
    : options_(options),
      confirmed_(std::max(1, int(std::lround(kConfirm / options.frame_seconds)))),
      first_(box) {
  phase_ = int(3 * number) % std::max(1, int(kRivalEvery / options.frame_seconds));
  view_.centre = box.centre();
  const Eigen::Vector2d size(box.w, box.h);
  anchor_ = Appearance(grey, view_, size);
  recent_ = anchor_;
  const double dt = options.frame_seconds, s = size_of(box);
  filter_ = TargetFilter(view_.centre, kMeasured, kFirstSpeed * s, kChange * s * dt * dt);
  seed(grey);
}

Box Target::box() const { return box_at(view_); }

Box Target::box_at(const View& view) const {
  const double c = std::abs(std::cos(view.turn)), s = std::abs(std::sin(view.turn));
  // The box about an ellipse that fills the first one, turned.
  const double w = view.scale * std::hypot(c * first_.w, s * first_.h),
               h = view.scale * std::hypot(s * first_.w, c * first_.h);
  return {view.centre.x() - 0.5 * w, view.centre.y() - 0.5 * h, w, h};
}

void Target::seed(const cv::Mat& grey) {
  if (int(points_.size()) >= kMostPoints * 2 / 3) return;
  const Box b = box();
  const cv::Rect area = cv::Rect(cv::Point(int(std::lround(b.x)), int(std::lround(b.y))),
                                 cv::Size(int(std::lround(b.w)), int(std::lround(b.h)))) &
                        cv::Rect(0, 0, grey.cols, grey.rows);
  if (area.width < 3 || area.height < 3) return;
  const double apart = std::max(2.0, 0.12 * size_of(b));
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(grey(area), corners, kMostPoints, 0.05, apart, {}, 3);
  for (const cv::Point2f& corner : corners) {
    const cv::Point2f p(corner.x + float(area.x), corner.y + float(area.y));
    const Eigen::Vector2d q =
        Eigen::Rotation2Dd(-view_.turn) * (Eigen::Vector2d(p.x, p.y) - view_.centre) / view_.scale;
    const double u = q.x() / (0.5 * first_.w), v = q.y() / (0.5 * first_.h);
    if (u * u + v * v > 1) continue;  // a box's corners are the ground's
    if (std::any_of(points_.begin(), points_.end(), [&](const auto& o) { return cv::norm(o - p) < apart; }))
      continue;
    points_.push_back(p);
    if (int(points_.size()) >= kMostPoints) break;
  }
}

std::optional<Target::Flow> Target::flow(const cv::Mat& before, const cv::Mat& now,
                                         const Eigen::Matrix3d& ground, const View& was, const View& guess) {
  const std::vector<cv::Point2f> points = std::exchange(points_, {});
  if (points.empty()) return std::nullopt;
  const Box b = box();
  const double size = size_of(b);
  // Only the surroundings: both crops moved with the guess, so that what is left to find is small.
  const int reach = int(std::ceil(std::max(b.w, b.h) + 24));
  const cv::Size crop(std::min(2 * reach, now.cols), std::min(2 * reach, now.rows));
  const auto about = [&](const Eigen::Vector2d& c) {
    return cv::Rect(cv::Point(std::clamp(int(std::lround(c.x())) - reach, 0, now.cols - crop.width),
                              std::clamp(int(std::lround(c.y())) - reach, 0, now.rows - crop.height)),
                    crop);
  };
  const cv::Rect a = about(was.centre), z = about(guess.centre);
  const int window = std::clamp(int(0.5 * std::min(b.w, b.h)) | 1, 7, 15);
  const cv::Mat from_picture = before(a).clone(), to_picture = now(z).clone();
  std::vector<cv::Point2f> from, to, back;
  const double turn = guess.turn - was.turn, grow = guess.scale / was.scale;
  for (const cv::Point2f& p : points) {
    const Eigen::Vector2d q =
        guess.centre + grow * (Eigen::Rotation2Dd(turn) * (Eigen::Vector2d(p.x, p.y) - was.centre));
    from.emplace_back(p.x - float(a.x), p.y - float(a.y));
    to.emplace_back(float(q.x()) - float(z.x), float(q.y()) - float(z.y));
  }
  back = from;
  const std::vector<cv::Point2f> guessed = to;
  std::vector<std::uint8_t> found, returned;
  std::vector<float> error;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
  std::vector<cv::Mat> pa, pz;
  cv::buildOpticalFlowPyramid(from_picture, pa, {window, window}, 2);
  cv::buildOpticalFlowPyramid(to_picture, pz, {window, window}, 2);
  cv::calcOpticalFlowPyrLK(pa, pz, from, to, found, error, {window, window}, 2, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  cv::calcOpticalFlowPyrLK(pz, pa, to, back, returned, error, {window, window}, 1, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<cv::Point2f> good0, good1;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (found[i] && returned[i] && cv::norm(back[i] - from[i]) < kReturn) {
      // A target that moves over the ground has no points that stay with it: they are what hides it.
      const Eigen::Vector2d at = shifted(to[i], z.tl());
      const Eigen::Vector2d own = shifted(guessed[i], z.tl());
      const Eigen::Vector2d still = plane_step(ground, {points[i].x, points[i].y}).to;
      if ((still - own).norm() > kStill && (at - still).norm() < 0.3 * (still - own).norm()) continue;
      good0.push_back(points[i]);
      good1.emplace_back(to[i].x + float(z.x), to[i].y + float(z.y));
    }
  if (good0.empty()) return std::nullopt;

  Flow result;
  result.view = guess;
  const double off = 0.6 + 0.02 * size;
  std::vector<std::uint8_t> on(good0.size(), 0);
  bool fitted = false;
  if (good0.size() >= 6 && size > 15) {
    const cv::Mat fit = cv::estimateAffinePartial2D(good0, good1, on, cv::RANSAC, off, 100, 0.99);
    if (!fit.empty() && 2 * cv::countNonZero(on) >= int(good0.size())) {
      const double c = fit.at<double>(0, 0), s = fit.at<double>(1, 0), scale = std::hypot(c, s);
      const double turned = std::atan2(s, c);
      if (std::abs(scale / grow - 1) < 0.1 && std::abs(turned - turn) < 0.2) {
        const Eigen::Vector2d& p = was.centre;
        result.view.centre = {c * p.x() - s * p.y() + fit.at<double>(0, 2),
                              s * p.x() + c * p.y() + fit.at<double>(1, 2)};
        result.view.scale = was.scale * scale;
        result.view.turn = was.turn + turned;
        fitted = true;
      }
    }
  }
  if (!fitted) {
    // The median of what is left over of the guess.
    std::vector<double> us, vs;
    std::vector<Eigen::Vector2d> lefts;
    for (std::size_t i = 0; i < good0.size(); ++i) {
      const Eigen::Vector2d q =
          guess.centre +
          grow * (Eigen::Rotation2Dd(turn) * (Eigen::Vector2d(good0[i].x, good0[i].y) - was.centre));
      lefts.emplace_back(good1[i].x - q.x(), good1[i].y - q.y());
      us.push_back(lefts.back().x());
      vs.push_back(lefts.back().y());
    }
    const auto middle = us.size() / 2;
    std::nth_element(us.begin(), us.begin() + middle, us.end());
    std::nth_element(vs.begin(), vs.begin() + middle, vs.end());
    const Eigen::Vector2d left(us[middle], vs[middle]);
    for (std::size_t i = 0; i < good0.size(); ++i) on[i] = (lefts[i] - left).norm() < off;
    result.view.centre = guess.centre + left;
  }
  for (std::size_t i = 0; i < good0.size(); ++i)
    if (on[i]) points_.push_back(good1[i]), ++result.points;
  return result;
}

/// Something that stood there when the target was last seen elsewhere is not the target: the place looked as
/// much like it then as it does now.
bool Target::was_there_before(const Match& match) const {
  const PlaneStep back = plane_step(last_seen_.ground.inverse(), match.view.centre);
  const double size = size_of(box());
  if ((back.to - last_seen_.view.centre).norm() < 0.7 * size) return false;
  View then = match.view;
  then.centre = back.to;
  then.turn += back.turn();
  then.scale *= back.scale();
  const double alike = recent_.align(last_seen_.picture, then, nullptr).alike;
  return alike > match.agreement.alike - kBetter && (then.centre - back.to).norm() < 0.3 * size;
}

std::vector<Target::Match> Target::look_alikes(const cv::Mat& grey, const View& about, double reach,
                                               int slack) const {
  const cv::Mat pattern = recent_.picture();
  const double step = recent_.step() * about.scale;  // picture px a sample
  double coarse = 1;
  while (reach / (step * coarse) > kMostReach && coarse * 8 <= std::min(pattern.cols, pattern.rows))
    coarse *= 2;
  cv::Mat small = pattern;
  if (coarse > 1) cv::resize(pattern, small, {}, 1 / coarse, 1 / coarse, cv::INTER_AREA);
  const double sample = step * coarse;
  const int radius = int(std::min(kMostReach, std::ceil(reach / sample))) + 1;
  const int w = small.cols + 2 * radius, h = small.rows + 2 * radius;
  const double c = std::cos(about.turn) * sample, s = std::sin(about.turn) * sample;
  // From a pixel of the search picture to the picture, of which only what is needed is smoothed.
  const double ox = 0.5 * (w - 1), oy = 0.5 * (h - 1), half = std::hypot(ox, oy) * sample + 2;
  // A view may be far outside, where its pixels are beyond every int.
  const auto within = [](double at, int size) { return at > 0 ? (at < size ? int(at) : size) : 0; };
  const double left = std::floor(about.centre.x() - half), top = std::floor(about.centre.y() - half);
  const double side = std::floor(2 * half) + 2;
  const cv::Rect needed(cv::Point(within(left, grey.cols), within(top, grey.rows)),
                        cv::Point(within(left + side, grey.cols), within(top + side, grey.rows)));
  if (needed.width < small.cols || needed.height < small.rows) return {};
  const cv::Matx23d map(c, -s, about.centre.x() - c * ox + s * oy - needed.x, s, c,
                        about.centre.y() - s * ox - c * oy - needed.y);
  cv::Mat area, score, source = grey(needed);
  if (sample > 1.5) {
    cv::Mat smooth;
    cv::GaussianBlur(source, smooth, {}, 0.4 * sample);
    source = smooth;
  }
  cv::warpAffine(source, area, map, {w, h}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, 0);
  cv::matchTemplate(area, small, score, cv::TM_CCOEFF_NORMED);
  std::vector<Match> matches;
  for (int k = 0; k < kMostAlike; ++k) {
    double most = 0;
    cv::Point at;
    cv::minMaxLoc(score, nullptr, &most, nullptr, &at);
    if (most < kRegain - 0.25) break;
    const double x = at.x - radius, y = at.y - radius;
    Match match;
    match.view = about;
    match.view.centre += Eigen::Vector2d(c * x - s * y, s * x + c * y);
    const int nx = std::max(1, small.cols / 2), ny = std::max(1, small.rows / 2);
    score(cv::Rect(at.x - nx, at.y - ny, 2 * nx + 1, 2 * ny + 1) & cv::Rect(0, 0, score.cols, score.rows)) =
        -1.f;
    const Form form = form_about(match.view, kFormFree);
    match.agreement = recent_.align(grey, match.view, &form);
    if (like_itself(match.agreement, slack)) matches.push_back(match);
  }
  return matches;
}

void Target::remember_rivals(const cv::Mat& grey) {
  // Some are hidden before the target is, as those ahead of it under a bridge: they are kept for a while.
  std::erase_if(rivals_,
                [&](const Rival& r) { return (age_ - r.seen) * options_.frame_seconds > kRivalMemory; });
  const double size = size_of(box());
  for (const Match& match : look_alikes(grey, view_, kRivals * size, kStrict)) {
    const Eigen::Vector2d d = match.view.centre - view_.centre;
    if (d.norm() < 0.5 * size) continue;
    const Eigen::Vector2d beside = Eigen::Rotation2Dd(-view_.turn) * d / view_.scale;
    const auto same = std::find_if(rivals_.begin(), rivals_.end(), [&](const Rival& r) {
      return (r.beside - beside).norm() * view_.scale < 0.5 * size;
    });
    if (same == rivals_.end()) {
      rivals_.push_back({beside, age_});
    } else {
      *same = {beside, age_};
    }
  }
}

bool Target::is_rival(const View& own, const Eigen::Vector2d& centre, const Eigen::Matrix2d& inverse,
                      double far) const {
  return std::any_of(rivals_.begin(), rivals_.end(), [&](const Rival& r) {
    const Eigen::Vector2d there = own.centre + own.scale * (Eigen::Rotation2Dd(own.turn) * r.beside);
    return (age_ - r.seen) * options_.frame_seconds < kRivalMemory &&
           (centre - there).dot(inverse * (centre - there)) < far;
  });
}

std::optional<Target::Match> Target::manoeuvre(const cv::Mat& now, const View& still, const View& guess,
                                               const std::optional<Match>& tried,
                                               std::span<const Box> others) {
  const double size = size_of(box());
  const double reach = std::max(kItself * size, kOnward * filter_.velocity().norm());
  std::vector<Match> found = look_alikes(now, still, reach, kStrict);
  View view = still;
  Agreement agreement;
  if (settle(now, still, view, agreement, 0)) found.push_back({view, agreement});
  std::erase_if(found, [&](const Match& match) { return !like_itself(match.agreement, kStrict); });
  if (tried) found.push_back(*tried);
  const Eigen::Matrix2d even = Eigen::Matrix2d::Identity();
  std::erase_if(found, [&](const Match& match) {
    const double far = (match.view.centre - still.centre).norm();
    const Box there = box_at(match.view);
    return far > reach || std::abs(match.view.scale / still.scale - 1) > 0.15 ||
           std::abs(match.view.turn - still.turn) > 0.3 ||
           std::any_of(others.begin(), others.end(),
                       [&](const Box& o) { return overlap(o, there) > kShared; }) ||
           is_rival(still, match.view.centre, even, far * far) ||
           is_rival(guess, match.view.centre, even, far * far) || was_there_before(match);
  });
  if (found.empty()) return std::nullopt;
  return *std::max_element(found.begin(), found.end(), [](const Match& a, const Match& b) {
    return a.agreement.alike < b.agreement.alike;
  });
}

std::optional<Target::Candidate> Target::search(const cv::Mat& now, const Eigen::Matrix2d& gate,
                                                std::span<const Box> others) const {
  const double size = size_of(box());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(gate);
  const double reach = std::sqrt(kGate * eigen.eigenvalues()(1));
  // A large area is searched in parts, one a picture; so are turns besides the expected one.
  const auto matches_about = [&](const Eigen::Vector2d& centre, double to) {
    constexpr double kMostParts = 1000;  // to each side: a million pictures, longer than any search
    const int parts =
        std::max(1, int(std::min(kMostParts, std::ceil(to / (kMostReach * recent_.step() * view_.scale)))));
    const int part = hidden_ % (parts * parts);
    const double cell = 2 * to / parts;
    View about = view_;
    about.centre =
        centre + Eigen::Vector2d((part % parts + 0.5) * cell - to, (part / parts + 0.5) * cell - to);
    const double turns[] = {0, 0.25, -0.25};
    if (hidden_ * options_.frame_seconds > 0.5) about.turn += turns[hidden_ / (parts * parts) % 3];
    return look_alikes(now, about, 0.5 * cell, kExpected);
  };
  // It may have stopped or turned when it was seen last.
  const Eigen::Vector2d still = plane_step(last_seen_.ground, last_seen_.view.centre).to;
  const double roam =
      std::min(kRivals * size, kItself * size + kOnward * hidden_ * filter_.velocity().norm());
  const bool roams = hidden_ * options_.frame_seconds < kRoam;
  const Eigen::Matrix2d inverse = gate.inverse();
  const auto far_from = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - b).dot(inverse * (a - b));
  };
  std::vector<Candidate> found;
  std::vector<Match> matches = matches_about(view_.centre, reach);
  Match there{view_, {}};
  const Form form = form_about(view_, kFormFree);
  there.agreement = recent_.align(now, there.view, &form);
  matches.push_back(there);
  if (roams) {
    const std::vector<Match> more = matches_about(still, roam);
    matches.insert(matches.end(), more.begin(), more.end());
  }
  for (const Match& match : matches) {
    const View& view = match.view;
    double far = far_from(view.centre, view_.centre);
    const Box box_there = box_at(view);
    if (far > kGate) {
      if (!roams || (view.centre - still).norm() > roam) continue;
      far = kGate;
    }
    if (!like_itself(match.agreement, slack_of(far)) || std::abs(view.scale / view_.scale - 1) > 0.2 ||
        std::abs(view.turn - view_.turn) > 0.6 ||
        std::any_of(others.begin(), others.end(),
                    [&](const Box& o) { return overlap(o, box_there) > kShared; }) ||
        is_rival(view_, view.centre, inverse, far_from(view.centre, view_.centre)) || was_there_before(match))
      continue;
    found.push_back({view, far + std::pow((1 - match.agreement.alike) / 0.1, 2), far, 1});
  }
  if (found.empty()) return std::nullopt;
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  for (const Candidate& other : found)
    if ((other.view.centre - found[0].view.centre).norm() > 0.3 * size &&
        other.cost < found[0].cost + kClearlyBetter)
      return std::nullopt;  // two alike: the next pictures tell
  return found[0];
}

std::optional<Target::Match> Target::follow_candidate(const cv::Mat& now, const Eigen::Matrix3d& ground,
                                                      const Eigen::Vector2d& expected) {
  const double size = size_of(box());
  const PlaneStep along = plane_step(ground, candidate_->view.centre);
  View still = candidate_->view;
  still.centre = along.to;
  still.turn += along.turn();
  still.scale *= along.scale();
  std::optional<Match> best;
  const auto take = [&](const View& from) {
    Match match{from, {}};
    if (!settle(now, from, match.view, match.agreement, 0) ||
        !like_itself(match.agreement, slack_of(candidate_->far)) ||
        (match.view.centre - from.centre).norm() > 1.5 + 0.08 * size)
      return false;
    best = match;
    return true;
  };
  View onward = still;
  onward.turn += turning_;
  onward.centre += expected;  // as it was expected to move itself
  if (take(onward)) {
    candidate_->moved = best->view.centre - still.centre;
    candidate_->view = best->view;
    return best;
  }
  // It goes another way, which is less likely.
  onward.centre = still.centre + candidate_->moved;
  if (!take(onward) && !take(still))
    for (const Match& match : look_alikes(now, still, kItself * size, kStrict))
      if ((match.view.centre - still.centre).norm() < kItself * size &&
          (!best || match.agreement.alike > best->agreement.alike))
        best = match;
  if (!best) return std::nullopt;
  candidate_->moved = best->view.centre - still.centre;
  candidate_->view = best->view;
  candidate_->cost = std::max(candidate_->cost, kGate);
  candidate_->far = kGate;
  return best;
}

Form Target::form_about(const View& view, double times) const {
  const double dt = options_.frame_seconds;
  return {view, times * (kTurnStep + kTurnRate * dt), times * (kScaleStep + kScaleRate * dt)};
}

bool Target::like_itself(const Agreement& agreement, int slack) const {
  // Right where it is expected it may look less like itself: the light and the ground about it change, and
  // part of it may still be hidden.
  return agreement.alike > std::max(kRegain - 0.1 * (slack - 1), usual_ - 0.12 * slack) &&
         agreement.visible > std::max(0.6 - 0.05 * (slack - 1), usual_visible_ - 0.1 * slack);
}

double Target::deviation() const { return kMeasured + kMeasuredOfSize * size_of(box()); }

bool Target::settle(const cv::Mat& now, const View& guess, View& view, Agreement& agreement, int points) {
  const Form form = form_about(guess, 1);
  agreement = recent_.align(now, view, &form);
  View first = view;
  const Agreement with_first = anchor_.align(now, first, &form);
  const double size = size_of(box());
  // What is taken in from picture to picture may creep; the first one does not.
  if (with_first.correlation > 0.75 && with_first.correlation > agreement.correlation - 0.15 &&
      (first.centre - view.centre).norm() < 0.15 * size + 1 && std::abs(first.turn - view.turn) < 0.2 &&
      std::abs(first.scale / view.scale - 1) < 0.1) {
    view.centre += 0.5 * (first.centre - view.centre);
    view.turn += 0.5 * (first.turn - view.turn);
    view.scale += 0.5 * (first.scale - view.scale);
  }
  return agreement.correlation > std::max(kLeast, 0.5 * usual_correlation_) &&
         agreement.alike > (points >= 4 ? kKeep : std::max(kKeep + 0.05, usual_ - 0.35)) &&
         agreement.visible > kVisible && agreement.inside > 0.6;
}

Sighting Target::hidden(const Eigen::Matrix2d& gate) {
  followed_ = 0;
  ++hidden_;
  points_.clear();
  Sighting s;
  s.sight = hidden_ * options_.frame_seconds > options_.give_up ? Sight::lost : Sight::total;
  s.box = box();
  s.covariance = gate;
  s.confidence = 0;
  return s;
}

void Target::accept(const cv::Mat& now, const View& view, const Agreement& agreement,
                    const std::optional<Eigen::Vector2d>& velocity) {
  view_ = view;
  const Eigen::Vector2d d = view.centre - filter_.centre();
  const Eigen::Matrix2d r = round_covariance(deviation());
  const double far = d.dot((filter_.covariance() + r).inverse() * d);
  if (velocity) {
    filter_.restart(view.centre, *velocity, deviation(),
                    0.5 * (*velocity - filter_.velocity()).norm() + deviation());
  } else {
    filter_.update(view.centre, r);
  }
  if (hidden_ == 0) unrest_ += (std::min(far, 100.0) / 2 - unrest_) / kUnrestMemory;
  hidden_ = 0;
  ++followed_;
  candidate_.reset();
  if (agreement.visible > kWhole) {
    const double rate = std::max(0.1, 1.0 / age_);
    usual_ += rate * (agreement.alike - usual_);
    usual_correlation_ += rate * (agreement.correlation - usual_correlation_);
    usual_visible_ += rate * (agreement.visible - usual_visible_);
  }
  if (agreement.correlation > std::max(0.75, usual_correlation_ - 0.1) && agreement.visible > kWhole)
    recent_.learn(now, view, 0.09);
  const double finer = view.scale * anchor_.step();
  if (agreement.correlation > 0.85 && agreement.visible > kWhole && (finer > 1.6 || finer < 0.6) &&
      std::max(first_.w, first_.h) * view.scale < 30) {
    anchor_ = Appearance(now, view, {first_.w, first_.h});
    recent_ = anchor_;
  }
  seed(now);
  if (agreement.visible > kWhole && age_ % std::max(1, int(kRivalEvery / options_.frame_seconds)) == phase_)
    remember_rivals(now);
}

Sighting Target::step(const cv::Mat& before, const cv::Mat& now, const Eigen::Matrix3d& ground,
                      const Expectation* expected, std::span<const Box> others) {
  const double dt = options_.frame_seconds;
  ++age_;
  const View was = view_;
  filter_.set_acceleration(kChange * size_of(first_) * view_.scale * dt * dt *
                           std::sqrt(std::max(1.0, unrest_)));
  filter_.predict(ground, turning_);
  const PlaneStep step = plane_step(ground, was.centre);
  View guess = was;
  guess.turn += step.turn() + turning_;
  guess.scale *= step.scale();
  guess.centre = filter_.centre();
  Eigen::Matrix2d gate = filter_.covariance();
  // What is seen needs no advice, once its velocity is known.
  if (expected && (hidden_ > 0 || followed_ < kKnown)) {
    guess.centre = expected->centre;
    gate = expected->covariance;
  }
  if (expected && hidden_ > 0) {
    filter_.place(expected->centre, expected->covariance);
    // From how it looked when it was seen last: what it is followed by may have grown against the first
    // picture.
    if (told_) {
      guess.scale = told_->view.scale * expected->scale / told_->scale;
      guess.turn = told_->view.turn + expected->turn - told_->turn;
    }
  }
  gate += round_covariance(deviation());

  const double size = size_of(box());
  const auto sighting = [&](const Agreement& agreement) {
    if (expected) told_ = Told{view_, expected->scale, expected->turn};
    Sighting s;
    s.sight = agreement.visible > kWhole ? Sight::no_occlusion : Sight::partial;
    s.box = box();
    s.measured = true;
    s.covariance = round_covariance(deviation());
    s.confidence = std::clamp(agreement.correlation, 0.0, 1.0) * agreement.visible;
    return s;
  };
  if (hidden_ == 0) {
    const std::optional<Flow> followed = flow(before, now, ground, was, guess);
    View view = followed && followed->points >= 3 ? followed->view : guess;
    Agreement agreement;
    bool good = settle(now, guess, view, agreement, followed ? followed->points : 0);
    if (!good || agreement.visible < kWhole) {
      View other = guess;
      Agreement with_guess;
      const bool again = settle(now, guess, other, with_guess, 0);
      if (again && (!good || with_guess.alike > agreement.alike)) {
        view = other;
        agreement = with_guess;
        good = true;
      }
    }
    if (!good) {
      // A picture left out, a first velocity unknown: it may be too far for both, but within the gate.
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(gate);
      double nearest = kGate;
      for (const Match& match : look_alikes(now, guess, std::sqrt(kGate * eigen.eigenvalues()(1)), kStrict)) {
        const Eigen::Vector2d off = match.view.centre - guess.centre;
        const double far = off.dot(gate.inverse() * off);
        if (far >= nearest) continue;
        nearest = far;
        view = match.view;
        agreement = match.agreement;
        good = true;
      }
    }
    const Eigen::Vector2d d = view.centre - guess.centre;
    // What crosses it hides a part of it and moves in another way: it is not to be taken for it.
    const bool as_usual = like_itself(agreement, kStrict);
    const double far = d.dot(gate.inverse() * d);
    const bool gated = far < (as_usual ? kGate : kHalfHiddenGate) ||
                       (d.norm() < 0.3 * size && agreement.correlation > 0.8 && as_usual);
    const bool expected_there = good && gated && std::abs(view.scale / guess.scale - 1) < 0.15 &&
                                std::abs(view.turn - guess.turn) < 0.3;
    View still = was;
    still.centre = step.to;
    still.turn += step.turn();
    still.scale *= step.scale();
    std::optional<Eigen::Vector2d> velocity;
    if (!expected_there || !as_usual) {
      last_seen_ = {before, was, ground};
      // Points that move over the ground are not those of what hides it.
      const bool points = followed && followed->points >= 4 && (view.centre - still.centre).norm() > kStill;
      const bool tried = good && like_itself(agreement, points ? kPoints : kStrict);
      const std::optional<Match> other = manoeuvre(
          now, still, guess, tried ? std::optional<Match>({view, agreement}) : std::nullopt, others);
      if (other && (!expected_there || other->agreement.alike > agreement.alike + kBetter)) {
        view = other->view;
        agreement = other->agreement;
        velocity = view.centre - still.centre;
      } else if (!expected_there) {
        last_seen_.picture = before.clone();
        view_ = guess;
        return hidden(gate);
      }
    }
    const double rate = std::min(0.5, dt / kTurnMemory);
    turning_ += rate * (view.turn - guess.turn);
    accept(now, view, agreement, velocity);
    return sighting(agreement);
  }

  // Hidden: what is found must go on as expected for some pictures before it is believed.
  view_ = guess;
  last_seen_.ground = ground * last_seen_.ground;
  if (candidate_) {
    const std::optional<Match> match = follow_candidate(now, ground, guess.centre - step.to);
    if (match) {
      // One that is far from where it is expected waits for longer: the right one may come out yet.
      const double wait = rivals_.empty() ? kAloneWait : kFarWait;
      const int least = rivals_.empty() ? confirmed_ : std::max(2, confirmed_);
      if (++candidate_->seen >= least + wait * candidate_->cost / kGate / dt) {
        accept(now, match->view, match->agreement,
               candidate_->far < kGate ? std::nullopt : std::optional(candidate_->moved));
        return sighting(match->agreement);
      }
    } else {
      candidate_.reset();
    }
  }
  if (!candidate_ || candidate_->cost > kNear) {
    const std::optional<Candidate> found = search(now, gate, others);
    if (found && (!candidate_ || found->cost < candidate_->cost - kNear)) candidate_ = found;
  }
  return hidden(gate);
}

}  // namespace vericone::vision
