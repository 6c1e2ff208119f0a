// SPDX-License-Identifier: GPL-3.0-or-later
//
// One assembly and all that is asked about it.
#pragma once

#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/verify/assembly/campaign.h>
#include <vericone/internal/verify/seeded_random.h>

namespace vericone::verify {

class AssemblyEngagement {
 public:
  /// The oracle is told of `told`, which is `c` but where a library is broken on purpose.
  AssemblyEngagement(const AssemblyCase& c, const AssemblyCase& told, std::uint64_t index,
                     AssemblyReport& report);

  /// False where there is no cone.
  bool relation();
  void velocities();
  void extremes();
  void map();

 private:
  void contact(const Eigen::Vector3d& w, Membership truth);
  void march(const Eigen::Vector3d& w, const AssemblyContact& contact);
  void contact_point(const Eigen::Vector3d& w, const AssemblyContact& contact);
  void miss(const Eigen::Vector3d& w, Membership truth);
  void half_plane(const Eigen::Vector3d& axis, const Eigen::Vector3d& side);
  /// Many half-planes at once against each alone.
  void ring();
  void expect(Check& check, bool holds, const char* what, const Eigen::Vector3d& w);

  const AssemblyCase& case_;
  std::uint64_t index_;
  AssemblyReport& report_;
  SeededRandom random_;
  Assembly assembly_;
  AssemblyOracle oracle_;
  AssemblyTruth truth_;
  double size_;  // largest coordinate
};

}  // namespace vericone::verify
