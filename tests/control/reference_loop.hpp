#pragma once

#include <numbers>

#include "reference_antenna.hpp"
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/wind/wind.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

/// The loops around the reference antenna: noise, dead time, wind of 10 m/s at the motor shaft.
namespace boresight::reference {

inline constexpr double delay = 0.03;

inline control::SensorNoise sensor_noise() {
  return {0.1 * mdeg * gear_ratio(), 0.02, 25.0, 0.5};
}

/// Every kind of block, in every path that takes it.
inline std::vector<control::LoopStructure> loop_structures() {
  using control::LoopStructure;
  return {LoopStructure::pi(),
          LoopStructure::pi_with_lag(),
          LoopStructure::pressure_feedback(),
          LoopStructure::lead_lag(),
          LoopStructure::full(),
          LoopStructure::pi_with_lag().with_compliance_compensation(),
          LoopStructure::pressure_feedback().with_notch().with_compliance_compensation()};
}

inline double motor_wind_spectrum(double frequency) {
  const double ratio = gear_ratio();
  return plant::wind_torque_spectrum(wind_site(), plant::WindModel::coherence, 10.0, frequency) /
         (ratio * ratio);
}

inline control::LoopEvaluator loop_evaluator(const plant::AntennaPlant& plant,
                                             int points_per_decade = 300) {
  // The edge of the noise's band is a point of the grid.
  const Eigen::ArrayXd low = plant::frequency_grid(plant, 1e-4, 25.0, points_per_decade);
  const Eigen::ArrayXd high = plant::frequency_grid(plant, 25.0, 100.0, points_per_decade);
  Eigen::ArrayXd w(low.size() + high.size() - 1);
  w << low, high.tail(high.size() - 1);
  return {
      plant,
      w,
      {.delay = delay,
       .noise = sensor_noise(),
       .wind_spectrum = (w / two_pi).unaryExpr([](double f) { return motor_wind_spectrum(f); })}};
}

inline plant::ShapingFilter wind_filter(int order) {
  const Eigen::ArrayXd f = Eigen::ArrayXd::LinSpaced(200, std::log(5e-4), std::log(5.0)).exp();
  return plant::fit_shaping_filter(f, f.unaryExpr([](double x) { return motor_wind_spectrum(x); }),
                                   order);
}

/// A controller anywhere within the bounds of the search.
inline control::Controller random_controller(RandomNumbers& random,
                                             control::LoopStructure structure) {
  control::Controller controller{structure, {}};
  for (const auto& description : control::gain_descriptions(structure)) {
    controller.gains.push_back(random.log_uniform(description.lower, description.upper));
  }
  return controller;
}

/// A controller drawn from the whole bounds until it is stable with every sensitivity peak within a
/// limit.
inline control::Controller sound_controller(RandomNumbers& random,
                                            control::LoopEvaluator& evaluator,
                                            control::LoopStructure structure, double highest_peak) {
  while (true) {
    const control::Controller controller = random_controller(random, structure);
    const auto evaluation = evaluator.evaluate(controller, false);
    bool sound = evaluation.stable();
    for (const auto loop_break : control::loop_breaks) {
      sound = sound && evaluation.highest_peak(loop_break) <= highest_peak;
    }
    if (sound) return controller;
  }
}

}  // namespace boresight::reference
