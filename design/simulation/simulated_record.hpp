#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/nonlinear/run_events.hpp>

namespace boresight::design {

/// Called with the completed fraction of a run (0..1); returning false ends it.
using RunProgress = std::function<bool(double done)>;

/// A channel in the form that a recorder writes.
struct SimulatedChannel {
  std::string name;
  std::string unit;        // of the values
  int decimals = 6;        // decimal places, enough to resolve the recorder's steps
  Eigen::VectorXd values;  // one per sample
};

/// The channels of a simulated test, and its events.
struct SimulatedRecord {
  std::string test;                        // its name
  std::vector<SimulatedChannel> channels;  // the first one is the time
  bool complete = true;                    // false: the run was interrupted
  double duration = 0.0;                   // s simulated
  double planned_duration = 0.0;           // s; the same if complete
  double sample_time = 0.0;                // s
  plant::RunEvents events;
};

}  // namespace boresight::design
