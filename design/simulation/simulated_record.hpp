#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/nonlinear/run_events.hpp>

namespace boresight::design {

/// Asked with the part of a run that is done (0..1); false ends it.
using RunProgress = std::function<bool(double done)>;

/// A channel as a recorder writes it.
struct SimulatedChannel {
  std::string name;
  std::string unit;        // of the values
  int decimals = 6;        // behind the point, so many as show the recorder's steps
  Eigen::VectorXd values;  // one a sample
};

/// What was written in a simulated test, and what happened.
struct SimulatedRecord {
  std::string test;                        // its name
  std::vector<SimulatedChannel> channels;  // the first one is the time
  bool complete = true;                    // false: the run was ended before its time
  double duration = 0.0;                   // s simulated
  double planned_duration = 0.0;           // s; the same if complete
  double sample_time = 0.0;                // s
  plant::RunEvents events;
};

}  // namespace boresight::design
