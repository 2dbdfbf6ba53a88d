#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/control_law.hpp>
#include <boresight/plant/plant_response.hpp>

namespace boresight::control {

/// Sensor noise: independent, white from 0 to `bandwidth` (Hz), given as rms over that band.
struct SensorNoise {
  double encoder_rms = 0.0;     // rad of motor
  double tachometer_rms = 0.0;  // rad/s of motor
  double bandwidth = 25.0;      // Hz
};

/// Frequencies (Hz) over which variances are integrated; all of the grid by default.
struct FrequencyBand {
  double lowest = 0.0;
  double highest = std::numeric_limits<double>::infinity();
};

/// Where the loop is cut to look at its sensitivity.
enum class LoopBreak {
  rate_loop_alone,  // at the valve command, position loop open: 1/(1 + L_rate)
  valve_command,    // at the valve command, both loops closed
  position_loop,    // at the rate command, rate loop closed
};
inline constexpr std::array loop_breaks{LoopBreak::rate_loop_alone, LoopBreak::valve_command,
                                        LoopBreak::position_loop};
std::string_view to_string(LoopBreak loop_break);

/// The open-loop gain at a break (positive gain with the -1 taken out, so that S = 1/(1 + L)) at
/// one frequency, with exact dead time.
std::complex<double> loop_gain(const plant::PlantResponse& response, Eigen::Index i,
                               const ControlLaw& law, double delay, LoopBreak loop_break);

/// A local maximum of a sensitivity.
struct SensitivityPeak {
  double frequency = 0.0;  // rad/s
  double magnitude = 0.0;
  /// d ln(magnitude) / d ln(gain), in the order of the gain vector.
  std::array<double, most_gains> log_gradient{};
};

/// One control law on one plant, seen through the frequency response. Variances in rad^2 of motor
/// (beam) and (rad/s)^2 (valve effort); *_log_gradient holds d variance / d ln(gain).
struct LoopEvaluation {
  double wind_variance = 0.0;
  double noise_variance = 0.0;
  double effort_variance = 0.0;
  std::array<double, most_gains> wind_log_gradient{};
  std::array<double, most_gains> noise_log_gradient{};
  std::array<double, most_gains> effort_log_gradient{};
  /// Highest local maxima of |S| at each break, highest first (at most three).
  std::array<std::vector<SensitivityPeak>, 3> peaks;
  /// Closed-loop poles in the right half plane by the winding of 1 + L along the grid, position
  /// loop open and closed. A quick filter: the verdict is the eigenvalues' (closed_loop.hpp).
  int unstable_rate_loop = 0;
  int unstable_closed_loop = 0;

  bool stable() const { return unstable_rate_loop == 0 && unstable_closed_loop == 0; }
  double beam_variance() const { return wind_variance + noise_variance; }
  double highest_peak(LoopBreak loop_break) const;
};

/// Evaluates control laws on one plant. The plant enters through its frequency response only,
/// computed once; an evaluation costs some fifty complex operations a frequency whatever the
/// number of structural modes, and dead time is exact. Not to be shared between threads: it keeps
/// its work arrays.
class LoopEvaluator {
 public:
  /// `wind_spectrum`: one-sided spectrum of the wind torque at the motor shaft, (N m)^2/Hz, at the
  /// response's frequencies. Integrals run over the part of the grid within `band` (noise: within
  /// its bandwidth too) by the trapezoid rule in ln f; put the edges among the frequencies. Peaks
  /// and stability are taken over the whole grid.
  /// @throws InvalidInput for sizes that differ or a grid that does not rise.
  LoopEvaluator(plant::AntennaPlant plant, const Eigen::ArrayXd& frequency, double delay,
                SensorNoise noise, const Eigen::ArrayXd& wind_spectrum, FrequencyBand band = {});

  /// @throws InvalidInput as validate(law).
  LoopEvaluation evaluate(const ControlLaw& law, bool with_gradients);

  /// |beam / wind torque|^2 of the closed loop at each frequency of the grid, rad^2/(N m)^2.
  Eigen::ArrayXd wind_transmission(const ControlLaw& law) const;

  const plant::PlantResponse& response() const { return response_; }
  const plant::AntennaPlant& antenna() const { return plant_; }
  double delay() const { return delay_; }
  /// Weights that turn a sum over the grid into an integral over Hz.
  const Eigen::ArrayXd& integration_weight() const { return weight_; }

 private:
  SensitivityPeak peak_at(const ControlLaw& law, LoopBreak loop_break, double frequency) const;
  std::vector<SensitivityPeak> find_peaks(const ControlLaw& law, LoopBreak loop_break,
                                          const Eigen::ArrayXd& square) const;

  plant::AntennaPlant plant_;
  plant::PlantResponse response_;
  double delay_;
  SensorNoise noise_;
  Eigen::ArrayXd weight_;
  Eigen::ArrayXd wind_weight_;   // weight times wind spectrum
  Eigen::ArrayXd noise_weight_;  // weight within the noise band
  Eigen::ArrayXcd dead_time_;
  std::array<Eigen::ArrayXd, 3> sensitivity_square_;
};

}  // namespace boresight::control
