#pragma once

#include <string>
#include <vector>

#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/wind/wind.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::design {

/// The wind condition of a design.
struct WindCondition {
  plant::WindSite site;
  plant::WindModel model = plant::WindModel::coherence;
  double mean_speed = 0.0;  // m/s

  bool operator==(const WindCondition&) const = default;
};

/// A wind and the fraction of the time it blows, or its probability.
struct WeightedWind {
  WindCondition wind;
  double weight = 0.0;
};

/// One member of the plant ensemble.
struct EnsembleMember {
  std::string name;
  plant::AntennaPlant plant;
};

/// Plant and conditions for the evaluation of controllers on one antenna.
struct TrackingProblem {
  plant::AntennaPlant plant;
  double gear_ratio = 1.0;  // motor turns per antenna turn
  double delay = 0.0;       // s, on the valve command
  control::SensorNoise noise;
  /// The design wind. It gives the loads and gusts, and the rms if there is no climate.
  WindCondition wind;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  int points_per_decade = 300;
  /// If given, the wind variance is its expectation over these winds, with weights that sum to 1.
  /// The loops are linear and a loss scales with the error squared, so the weighted wind spectra
  /// add up.
  std::vector<WeightedWind> climate = {};
};

/// One-sided wind torque spectrum at the motor shaft, (N m)^2/Hz, at frequencies in rad/s.
Eigen::ArrayXd motor_wind_spectrum(const WindCondition& wind, double gear_ratio,
                                   const Eigen::ArrayXd& frequency);

/// The same for a problem: of its wind, or the weighted sum over its climate.
/// @throws InvalidInput for a climate whose weights are negative or do not sum to 1 within 1e-9.
Eigen::ArrayXd motor_wind_spectrum(const TrackingProblem& problem, const Eigen::ArrayXd& frequency);

/// Frequency band (Hz) for the evaluation of stability, peaks and margins, whatever the band of the
/// rms. At least 1e-4 to 25 Hz, and up to eight times the valve's corner, because pressure feedback
/// can extend a loop beyond the corner.
control::FrequencyBand analysis_band(const TrackingProblem& problem);

/// Grid (rad/s) over the analysis band. It includes the edges of the rms band and of the noise.
Eigen::ArrayXd analysis_grid(const TrackingProblem& problem);

/// Table of a problem's motor wind spectrum, for many plants in one wind. 60 points per decade over
/// the analysis band, cubic interpolation in the logarithms, accurate to 2e-7.
class WindTable {
 public:
  /// @throws InvalidInput as motor_wind_spectrum(problem).
  explicit WindTable(const TrackingProblem& problem);
  /// Spectrum in (N m)^2/Hz at a frequency (rad/s) within the analysis band.
  double spectrum(double frequency) const;

 private:
  double first_ = 0.0, step_ = 0.0;  // of ln w
  Eigen::ArrayXd log_spectrum_;
};

/// Evaluator of controllers: the problem's frequency response and spectra on its analysis grid.
control::LoopEvaluator make_evaluator(const TrackingProblem& problem);

/// The same on adaptively chosen frequencies, in the wind of the table. It uses a few hundred
/// frequencies per evaluation and bounds the error to 1e-8. `tolerance` as in LoopQuadrature;
/// larger for studies of many plants, where frequencies cost memory and time.
control::LoopEvaluator make_adaptive_evaluator(
    const TrackingProblem& problem, const WindTable& wind,
    double tolerance = control::LoopQuadrature{}.tolerance);

/// Order-6 shaping filter of the motor wind torque, fitted from 5e-4 to 5 Hz. Order 4 suffices for
/// the coherence model at 10 m/s. Other models and speeds need two more orders for 0.5 % of the
/// rms.
plant::ShapingFilter fit_wind_filter(const WindCondition& wind, double gear_ratio);
/// The same for a problem's wind or climate.
plant::ShapingFilter fit_wind_filter(const TrackingProblem& problem);

/// Boresight rms (rad at the sky, per axis) with fixed gains at another mean speed of the problem's
/// wind. A climate is ignored.
double boresight_rms_at_speed(const TrackingProblem& problem,
                              const control::LoopEvaluator& evaluator,
                              const Eigen::ArrayXd& wind_transmission, double noise_variance,
                              double mean_speed);

/// Mean wind speed (m/s) at which the boresight rms with fixed gains reaches `rms_budget` (rad at
/// the sky). Computed by safeguarded regula falsi within [0.1, 60] m/s. 0 if noise alone exceeds
/// the budget, infinity if it is not reached by 60 m/s.
double wind_speed_limit(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                        const control::Controller& controller, double noise_variance,
                        double rms_budget);

}  // namespace boresight::design
