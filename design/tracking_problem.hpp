#pragma once

#include <boresight/control/loop_evaluator.hpp>
#include <boresight/plant/antenna_plant.hpp>
#include <boresight/plant/wind.hpp>
#include <boresight/plant/wind_filter.hpp>

namespace boresight::design {

/// The wind a design is judged in.
struct WindCondition {
  plant::WindSite site;
  plant::WindModel model = plant::WindModel::coherence;
  double mean_speed = 0.0;  // m/s
};

/// Everything that judges a control law on one antenna.
struct TrackingProblem {
  plant::AntennaPlant plant;
  double gear_ratio = 1.0;  // motor turns per antenna turn
  double delay = 0.0;       // s, on the valve command
  control::SensorNoise noise;
  WindCondition wind;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  int points_per_decade = 300;
};

/// One-sided wind torque spectrum at the motor shaft, (N m)^2/Hz, at frequencies in rad/s.
Eigen::ArrayXd motor_wind_spectrum(const WindCondition& wind, double gear_ratio,
                                   const Eigen::ArrayXd& frequency);

/// Frequencies (Hz) over which stability, peaks and margins are judged, whatever band the rms is
/// taken over: at least 1e-4 to 25 Hz, and up to eight times the valve's corner: pressure feedback
/// can carry a loop beyond it.
control::FrequencyBand analysis_band(const TrackingProblem& problem);

/// Grid (rad/s) over the analysis band, with the edges of rms band and noise among its points.
Eigen::ArrayXd analysis_grid(const TrackingProblem& problem);

/// The problem's frequency response and spectra, ready to evaluate control laws.
control::LoopEvaluator make_evaluator(const TrackingProblem& problem);

/// Order-6 shaping filter of the motor wind torque, fitted from 5e-4 to 5 Hz. Order 4 is enough for
/// the coherence model at 10 m/s; other models and speeds need two more for 0.5 % of the rms.
plant::ShapingFilter fit_wind_filter(const WindCondition& wind, double gear_ratio);

/// Beam rms (rad at the sky, one axis) with the gains held, at another mean wind speed.
double beam_rms_at_speed(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                         const Eigen::ArrayXd& wind_transmission, double noise_variance,
                         double mean_speed);

/// Mean wind speed (m/s) at which the beam rms with the gains held reaches `rms_budget` (rad at the
/// sky), by safeguarded regula falsi
/// within [0.1, 60] m/s; 0 if noise alone exceeds it, infinity if it is not reached by 60 m/s.
double wind_speed_limit(const TrackingProblem& problem, const control::LoopEvaluator& evaluator,
                        const control::ControlLaw& law, double noise_variance, double rms_budget);

}  // namespace boresight::design
