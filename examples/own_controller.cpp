// How well does a controller of your own reject wind? Any linear controller will do that reads
// tachometer (rad/s) and encoder (rad of motor) and commands the valve (rad/s): here, put together
// from blocks by name, a rate loop with PI action and a position loop with PI action around it.
#include <cstdio>

#include "elevation_axis.hpp"
#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace {

boresight::plant::StateSpace own_controller() {
  using namespace boresight::plant;
  const double kp = 6.0, wip = 0.1;  // 1/s, rad/s
  const double kr = 0.2, wi = 0.5;   // 1, rad/s
  return connect(
      {// kp (1 + wip/s) of what the encoder is off, against it
       rational({-kp * wip, -kp}, {0.0, 1.0}, "encoder", "asked_rate", "position"),
       static_gain(Eigen::RowVector2d(1.0, 1.0), {"asked_rate", "rate_disturbance"},
                   {"rate_command"}),
       static_gain(Eigen::RowVector2d(1.0, -1.0), {"rate_command", "tachometer"}, {"rate_error"}),
       rational({kr * wi, kr}, {0.0, 1.0}, "rate_error", "valve_demand", "rate")},
      {"tachometer", "encoder", "rate_disturbance"}, {"valve_demand", "rate_command"});
}

}  // namespace

int main() {
  namespace design = boresight::design;
  using elevation_axis::mdeg;

  const auto problem = elevation_axis::tracking_problem();
  design::RejectionOptions options;
  options.budgets = {0.527 * mdeg, 2.0 * mdeg};
  const auto score =
      design::rejection_benchmark(problem, design::Constraints{}, own_controller(), options);
  if (!score.stable) {
    std::printf("unstable: slowest pole %+.4f 1/s\n", score.abscissa);
    return 3;
  }
  std::printf("slowest pole: %.4f 1/s\n", score.abscissa);
  std::printf("wind torque at the axis, rms: %.4g N.m\n", score.design_wind.torque_rms);
  std::printf("boresight rms in %.0f m/s: %.4f mdeg\n", problem.wind.mean_speed,
              score.design_wind.boresight_rms / mdeg);
  std::printf("the same by Lyapunov equations: %.4f mdeg\n", score.lyapunov_rms / mdeg);
  std::printf("worst compliance: %.4g mdeg/(MN.m) at %.3f Hz\n", score.worst.upper * 1e6 / mdeg,
              score.worst.frequency / elevation_axis::two_pi);
  std::printf("0.527 mdeg is met up to: %.2f m/s\n", score.budget_speeds[0]);
  std::printf("2 mdeg is met up to: %.2f m/s\n", score.budget_speeds[1]);
}
