// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/answers.h>

namespace vericone {

const char* to_string(Relation relation) {
  switch (relation) {
    case Relation::disjoint:
      return "disjoint";
    case Relation::touching:
      return "touching";
    case Relation::overlapping:
      return "overlapping";
  }
  return "";
}

const char* to_string(Membership membership) {
  switch (membership) {
    case Membership::in:
      return "in";
    case Membership::on:
      return "on";
    case Membership::out:
      return "out";
  }
  return "";
}

const char* to_string(Passage passage) {
  switch (passage) {
    case Passage::ahead:
      return "ahead";
    case Passage::ahead_grazing:
      return "ahead, grazing";
    case Passage::never:
      return "never";
    case Passage::behind_grazing:
      return "behind, grazing";
    case Passage::behind:
      return "behind";
  }
  return "";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::in:
      return "in";
    case Verdict::on:
      return "on";
    case Verdict::out:
      return "out";
    case Verdict::overlapping:
      return "overlapping";
    case Verdict::touching:
      return "touching";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

const char* to_string(Certified answer) {
  switch (answer) {
    case Certified::in:
      return "in";
    case Certified::out:
      return "out";
    case Certified::undecided:
      return "undecided";
  }
  return "";
}

}  // namespace vericone
