// The demo antenna with its friction, gears and oil under PI with lag, for runs in wind.
#pragma once

#include "design/studies/demo_mission.hpp"
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::reference {

struct DemoLoop {
  design::Mission mission = demo_mission();
  design::TrackingProblem problem = tracking_problem(mission);
  design::SimulatedLoop loop =
      make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna),
                          control::Controller{control::LoopStructure::pi_with_lag(),
                                              {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
  design::SimulatedRmsOptions options{.settling = 20.0,
                                      .duration = 60.0,
                                      .tracking_rate = mission.antenna.drive.tracking_rate,
                                      .threads = 2};
};

}  // namespace boresight::reference
