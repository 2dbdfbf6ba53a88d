#include <cmath>

#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/problem/mean_wind_load.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::design {

Eigen::ArrayXd wind_transmission(const TrackingProblem& problem,
                                 const control::Controller& controller,
                                 const Eigen::ArrayXd& frequency) {
  const control::LoopEvaluator evaluator(problem.plant, frequency,
                                         {.delay = problem.delay,
                                          .noise = problem.noise,
                                          .wind_spectrum = Eigen::ArrayXd::Zero(frequency.size()),
                                          .band = problem.rms_band});
  return evaluator.wind_transmission(controller);
}

double predicted_rms(const TrackingProblem& problem, const control::Controller& controller) {
  control::LoopEvaluator evaluator = make_evaluator(problem);
  return std::sqrt(evaluator.evaluate(controller, false).boresight_variance());
}

double static_boresight_error(const TrackingProblem& problem,
                              const control::Controller& controller) {
  control::ControlledAntenna loop(problem.plant, control::to_state_space(controller),
                                  problem.delay);
  // Lower frequencies lose digits: the free antenna's angle in a steady torque grows without bound.
  constexpr double far_below = 3e-5;  // rad/s
  const double torque =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
  return std::abs(loop.at(far_below).boresight_by_wind * torque) / problem.gear_ratio;
}

double static_encoder_error(const TrackingProblem& problem, const control::Controller& controller) {
  return static_encoder_error(controller, mean_wind_load(problem).demand, problem.gear_ratio);
}

}  // namespace boresight::design
