// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/pieces.h"

#include "certificate/convex_pair.h"
#include "certificate/ellipsoids.h"
#include "certificate/polytopes.h"

namespace vericone::certificates {
namespace {

bool are_round(const PairOfPieces& pair) { return pair.a.round() && pair.b.round(); }

/// Asks the pair of two ellipsoids, or that of others.
template <typename OfEllipsoids, typename OfOthers>
auto ask(const PairOfPieces& pair, const OfEllipsoids& of_ellipsoids, const OfOthers& of_others) {
  const Question& question = pair.question;
  const int grid = pair.grid();
  const Eigen::Vector3d &at_a = question.agent.at(), &at_b = question.obstacle.at();
  if (!are_round(pair))
    return of_others(
        PolytopePair(pair.a, at_a, pair.b, at_b, question.v_a, question.v_b, question.horizon, grid), grid);
  const Motion motion(question.v_a, question.v_b, question.horizon.from, question.horizon.until, grid);
  const auto center = [&](const Piece& piece, const Eigen::Vector3d& at) {
    return on_grid(piece.round()->center(), grid) + on_grid(at, grid);
  };
  return of_ellipsoids(
      EllipsoidPair(*pair.a.round(), center(pair.a, at_a), *pair.b.round(), center(pair.b, at_b), motion),
      grid);
}

void write_pieces(Text& text, const PairOfPieces& pair) {
  if (pair.agent) text.raw(", \"agent_piece\": ").index(*pair.agent);
  if (pair.obstacle) text.raw(", \"obstacle_piece\": ").index(*pair.obstacle);
}

void write_weights(Text& text, const char* field, const Weights& weights) {
  if (weights.empty()) return;
  text.raw(", \"").raw(field).raw("\": [");
  const char* between = "[";
  for (const auto& [corner, weight] : weights) {
    text.raw(between).index(corner).raw(", ").number(weight).raw("]");
    between = ", [";
  }
  text.raw("]");
}

void write_meeting(Text& text, const Meeting& meeting, int grid, bool inside_agent) {
  text.raw("{\"rule\": \"point\", \"time\": ").number(meeting.time).raw(", \"point\": ");
  text.number(meeting.point, grid - static_cast<int>(meeting.finer)).raw(", \"inside\": ");
  text.raw(inside_agent ? "\"agent\"" : "\"obstacle\"");
}

void write_touch(Text& text, const Touch& touch, int grid) {
  text.raw("{\"rule\": \"touch\", \"n\": ").number(touch.normal).raw(", \"time\": ").number(touch.time);
  const char* between = ", \"point\": [";
  for (const Rational& x : touch.point) {
    text.raw(between).number(x, grid);
    between = ", ";
  }
  text.raw("]");
}

void write_crossing(Text& text, const Crossing& crossing) {
  text.raw("{\"rule\": \"cross\", \"time\": ").number(crossing.time);
  const char* between = ", \"pairs\": [[";
  for (const auto& term : crossing.terms) {
    text.raw(between).index(term.pair.agent).raw(", ").index(term.pair.obstacle).raw(", ");
    text.number(term.weight).raw("]");
    between = ", [";
  }
  text.raw("]");
}

template <typename Of>
auto ask_convex(const PairOfPieces& pair, const Of& of) {
  const Question& question = pair.question;
  const RoundedHull agent = rounded_hull(pair.a, question.agent.at()),
                    obstacle = rounded_hull(pair.b, question.obstacle.at());
  return of(ConvexPair(agent, obstacle, question.v_a, question.v_b, question.horizon));
}

/// How the parts of a piece make up the point; of round ones it is seen without.
void write_mean(Text& text, const char* field, const Piece& piece, const Mean& mean) {
  if (piece.round()) return;
  const char* between = "\": [[";
  text.raw(", \"").raw(field);
  for (const Share& share : mean.shares) {
    text.raw(between).index(share.part).raw(", ").number(share.weight);
    if (!is_zero(share.along)) write(text.raw(", "), share.along);
    text.raw("]");
    between = ", [";
  }
  text.raw("]");
}

void write_common(Text& text, const PairOfPieces& pair, const CommonPoint& at) {
  write(text.raw(", \"time\": ").number(at.time).raw(", \"point\": "), at.point);
  write_mean(text, "agent_weights", pair.a, at.agent);
  write_mean(text, "obstacle_weights", pair.b, at.obstacle);
  write_pieces(text, pair);
  text.raw("}");
}

}  // namespace

int PairOfPieces::grid() const {
  const int least = std::min({a.grid(), b.grid(), grid_of(question.agent.at()),
                              grid_of(question.obstacle.at()), grid_of(question.v_a), grid_of(question.v_b)});
  return least == kNoGrid ? 0 : least;
}

bool PairOfPieces::has_convex() const { return a.convex || b.convex; }

bool PairOfPieces::has_dents() const {
  for (const Piece* piece : {&a, &b})
    if (piece->delimited()) return true;
  return false;
}

void write(Text& text, const Plane& plane) {
  text.raw("{\"rule\": \"plane\", ");
  if (plane.across) {
    const auto& [k, a, b] = *plane.across;
    // The two other axes in rising order.
    text.raw("\"across_w\": [").index(static_cast<std::size_t>(k)).raw(", ");
    text.number(k == 1 ? b : a).raw(", ").number(k == 1 ? a : b).raw("]");
  } else {
    text.raw("\"n\": ").number(plane.normal);
  }
  if (plane.levels) {
    text.raw(", \"agent_at_most\": ").number(plane.levels->first);
    text.raw(", \"obstacle_at_least\": ").number(plane.levels->second);
  }
  text.raw("}");
}

std::optional<Plane> plane_between(const PairOfPieces& pair) {
  if (pair.has_convex()) return ask_convex(pair, [](const ConvexPair& of) { return of.plane(); });
  const auto plane = [](const auto& of, int) { return of.plane(); };
  return ask(pair, plane, plane);
}

bool prove_out(const PairOfPieces& pair, Text& proof) {
  const auto plane = plane_between(pair);
  if (plane) write(proof, *plane);
  return plane.has_value();
}

bool prove_in(const PairOfPieces& pair, Text& proof) {
  if (pair.has_convex()) {
    const auto deep = ask_convex(pair, [](const ConvexPair& of) { return of.meeting(); });
    if (!deep || pair.has_dents()) return false;
    proof.raw("{\"rule\": \"point\", \"inside\": ");
    proof.raw(deep->inside == DeepPoint::Inside::agent      ? "\"agent\""
              : deep->inside == DeepPoint::Inside::obstacle ? "\"obstacle\""
                                                            : "\"both\"");
    write_common(proof, pair, *deep);
    return true;
  }
  const bool found = ask(
      pair,
      [&](const EllipsoidPair& of, int grid) {
        const auto meeting = of.meeting();
        if (meeting) write_meeting(proof, *meeting, grid, true);
        return meeting.has_value();
      },
      [&](const PolytopePair& of, int grid) {
        if (of.has_round()) {
          const auto found_point = of.meeting();
          if (!found_point) return false;
          const bool of_agent = found_point->corners_of_agent;
          write_meeting(proof, found_point->meeting, grid, !of_agent);
          write_weights(proof, of_agent ? "agent_weights" : "obstacle_weights", found_point->weights);
          return true;
        }
        const auto crossing = of.crossing();
        if (crossing) write_crossing(proof, *crossing);
        return crossing.has_value();
      });
  if (!found) return false;
  write_pieces(proof, pair);
  proof.raw("}");
  return true;
}

bool prove_on(const PairOfPieces& pair, Text& proof) {
  if (pair.has_convex()) {
    const auto touch = ask_convex(pair, [](const ConvexPair& of) { return of.touch(); });
    if (!touch || pair.has_dents()) return false;
    proof.raw("{\"rule\": \"touch\", \"n\": ").number(touch->normal);
    write_common(proof, pair, touch->at);
    return true;
  }
  const bool found = ask(
      pair,
      [&](const EllipsoidPair& of, int grid) {
        const auto touch = of.touch();
        if (touch) write_touch(proof, *touch, grid);
        return touch.has_value();
      },
      [&](const PolytopePair& of, int grid) {
        const auto touch = of.touch();
        if (!touch) return false;
        write_touch(proof, touch->touch, grid);
        write_weights(proof, "agent_weights", touch->agent);
        write_weights(proof, "obstacle_weights", touch->obstacle);
        return true;
      });
  if (!found) return false;
  write_pieces(proof, pair);
  proof.raw("}");
  return true;
}

}  // namespace vericone::certificates
