// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/certificate.h>
#include <vericone/simulation/run.h>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace vericone::scenario {

/// What happened in a few lines: bodies, events, verdict with what is proved, `seconds` of the computation.
void print_run(const simulation::Scenario& scenario, const simulation::Run& run, double seconds,
               std::ostream& out);

/// What a body is at its start, in plain words, and that it changes where it does.
std::string shape_words(const simulation::Body& body);

/// How fast the water or air moves, in a line.
std::string current_text(const simulation::Current& water);

/// What a pilot does, in a line.
std::string agent_text(const simulation::Scenario& scenario, const simulation::Body& body);

/// Outline, size and motion of an orifice, in a line.
std::string orifice_words(const simulation::MovingOrifice& orifice);

/// What a certificate says, and of when, in a line.
std::string certificate_text(const simulation::RunCertificate& certificate);

/// What a file means, line by line.
class Facts {
 public:
  /// An empty label: more of the one before.
  void add(std::string label, std::string text) { lines_.emplace_back(std::move(label), std::move(text)); }
  /// In the columns of all commands, or as a list of {label, text}.
  void print(bool json, std::ostream& out) const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// A label and what it is, in the columns of all commands.
void print_line(std::ostream& out, std::string label, const std::string& text);

}  // namespace vericone::scenario
