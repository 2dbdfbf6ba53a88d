#pragma once

#include <string>
#include <vector>

#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/wind/wind.hpp>
#include <boresight/plant/wind/wind_filter.hpp>

namespace boresight::design {

/// The wind a design is judged in.
struct WindCondition {
  plant::WindSite site;
  plant::WindModel model = plant::WindModel::coherence;
  double mean_speed = 0.0;  // m/s
};

/// A wind and the share of the time it blows, or its probability.
struct WeightedWind {
  WindCondition wind;
  double weight = 0.0;
};

/// A plant that may be the true one.
struct EnsembleMember {
  std::string name;
  plant::AntennaPlant plant;
};

/// Everything that judges a control law on one antenna.
struct TrackingProblem {
  plant::AntennaPlant plant;
  double gear_ratio = 1.0;  // motor turns per antenna turn
  double delay = 0.0;       // s, on the valve command
  control::SensorNoise noise;
  /// The wind of the design: loads, gusts, and the rms where there is no climate.
  WindCondition wind;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  int points_per_decade = 300;
  /// Where given, the wind variance is its expectation over these winds, weights summing to 1. The
  /// loops are linear and a loss goes with the error's square: the winds' spectra add up, weighted.
  std::vector<WeightedWind> climate = {};
};

/// One-sided wind torque spectrum at the motor shaft, (N m)^2/Hz, at frequencies in rad/s.
Eigen::ArrayXd motor_wind_spectrum(const WindCondition& wind, double gear_ratio,
                                   const Eigen::ArrayXd& frequency);

/// The same of a problem: of its wind, or the weighted sum over its climate.
/// @throws InvalidInput for a climate whose weights are negative or do not sum to 1 within 1e-9.
Eigen::ArrayXd motor_wind_spectrum(const TrackingProblem& problem, const Eigen::ArrayXd& frequency);

/// Frequencies (Hz) over which stability, peaks and margins are judged, whatever band the rms is
/// taken over: at least 1e-4 to 25 Hz, and up to eight times the valve's corner: pressure feedback
/// can carry a loop beyond it.
control::FrequencyBand analysis_band(const TrackingProblem& problem);

/// Grid (rad/s) over the analysis band, with the edges of rms band and noise among its points.
Eigen::ArrayXd analysis_grid(const TrackingProblem& problem);

/// A problem's motor wind spectrum from a table, for many plants in one wind: 60 points a decade
/// over the analysis band, cubic in the logarithms between, to 2e-7.
class WindTable {
 public:
  /// @throws InvalidInput as motor_wind_spectrum(problem).
  explicit WindTable(const TrackingProblem& problem);
  /// (N m)^2/Hz at a frequency (rad/s) within the analysis band.
  double spectrum(double frequency) const;

 private:
  double first_ = 0.0, step_ = 0.0;  // of ln w
  Eigen::ArrayXd log_spectrum_;
};

/// The problem's frequency response and spectra on its analysis grid, ready to evaluate control
/// laws.
control::LoopEvaluator make_evaluator(const TrackingProblem& problem);

/// The same on frequencies that the laws ask for, in the wind the table was made of: a few hundred
/// frequencies an evaluation, and its error is held to 1e-8. `tolerance`: of LoopQuadrature; larger
/// for studies of many plants, where frequencies cost memory and time.
control::LoopEvaluator make_adaptive_evaluator(
    const TrackingProblem& problem, const WindTable& wind,
    double tolerance = control::LoopQuadrature{}.tolerance);

/// Order-6 shaping filter of the motor wind torque, fitted from 5e-4 to 5 Hz. Order 4 is enough for
/// the coherence model at 10 m/s; other models and speeds need two more for 0.5 % of the rms.
plant::ShapingFilter fit_wind_filter(const WindCondition& wind, double gear_ratio);
/// The same of a problem's wind or climate.
plant::ShapingFilter fit_wind_filter(const TrackingProblem& problem);

/// Beam rms (rad at the sky, one axis) with the gains held, at another mean speed of the problem's
/// wind; a climate is left out of it.
double beam_rms_at_speed(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                         const Eigen::ArrayXd& wind_transmission, double noise_variance,
                         double mean_speed);

/// Mean wind speed (m/s) at which the beam rms with the gains held reaches `rms_budget` (rad at the
/// sky), by safeguarded regula falsi
/// within [0.1, 60] m/s; 0 if noise alone exceeds it, infinity if it is not reached by 60 m/s.
double wind_speed_limit(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                        const control::ControlLaw& law, double noise_variance, double rms_budget);

}  // namespace boresight::design
