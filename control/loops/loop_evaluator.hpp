#pragma once

#include <array>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>

#include <Eigen/Core>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::control {

/// Sensor noise: independent, white from 0 to `bandwidth` (Hz), given as rms over that band.
struct SensorNoise {
  double encoder_rms = 0.0;     // rad of motor
  double tachometer_rms = 0.0;  // rad/s of motor
  double bandwidth = 25.0;      // Hz
  double torque_rms = 0.0;      // N m, used only if torque is fed back
};

/// Frequencies (Hz) over which variances are integrated; all of the grid by default.
struct FrequencyBand {
  double lowest = 0.0;
  double highest = std::numeric_limits<double>::infinity();
};

/// The break at which the loop is cut to compute its sensitivity.
enum class LoopBreak {
  rate_loop_alone,  // at the valve command, position loop open: 1/(1 + L_rate)
  valve_command,    // at the valve command, both loops closed
  position_loop,    // at the rate command, rate loop closed
};
inline constexpr std::array loop_breaks{LoopBreak::rate_loop_alone, LoopBreak::valve_command,
                                        LoopBreak::position_loop};
std::string_view to_string(LoopBreak loop_break);
/// False for the rate loop and the position loop of a state space: cut at its encoder it would have
/// both in form (ControlledAntenna), but nothing closes one before the other.
bool has_break(const Controller& controller, LoopBreak loop_break);

/// The open-loop gain at a break at one frequency (rad/s), with exact dead time. Negative feedback
/// is implied: S = 1/(1 + L).
std::complex<double> loop_gain(const plant::ResponsePoint& response, double frequency,
                               const Controller& controller, double delay, LoopBreak loop_break);

/// A local maximum of a sensitivity.
struct SensitivityPeak {
  double frequency = 0.0;  // rad/s
  double magnitude = 0.0;
  /// d ln(magnitude) / d ln(gain), in the order of the gain vector.
  std::array<double, max_gains> log_gradient{};
};

/// The highest local maxima at a break, highest first.
class PeakList {
 public:
  static constexpr std::size_t maximum = 3;
  void push_back(const SensitivityPeak& peak) { peaks_.at(size_++) = peak; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const SensitivityPeak& operator[](std::size_t i) const { return peaks_[i]; }
  const SensitivityPeak& front() const { return peaks_[0]; }
  SensitivityPeak* begin() { return peaks_.data(); }
  SensitivityPeak* end() { return peaks_.data() + size_; }
  const SensitivityPeak* begin() const { return peaks_.data(); }
  const SensitivityPeak* end() const { return peaks_.data() + size_; }

 private:
  std::array<SensitivityPeak, maximum> peaks_;
  std::size_t size_ = 0;
};

/// Evaluation of one controller on one plant from the frequency response. Variances in rad^2 of
/// motor (boresight) and (rad/s)^2 (control effort); *_log_gradient contains d variance / d
/// ln(gain).
struct LoopEvaluation {
  double wind_variance = 0.0;
  double noise_variance = 0.0;
  double effort_variance = 0.0;  // of a state space: of its samples (sample_density)
  /// Variances of valve demand, (rad/s)^2, and motor torque, (N m)^2, caused by wind: the approach
  /// to saturation in gusts. 0 unless look_at_gusts() requested them.
  double wind_demand_variance = 0.0;
  double wind_torque_variance = 0.0;
  std::array<double, max_gains> wind_log_gradient{};
  std::array<double, max_gains> noise_log_gradient{};
  std::array<double, max_gains> effort_log_gradient{};
  std::array<double, max_gains> wind_demand_log_gradient{};
  std::array<double, max_gains> wind_torque_log_gradient{};
  std::array<PeakList, 3> peaks;  // of |S|, by break; empty without that loop (has_break)
  /// Closed-loop poles in the right half plane by the encirclements of 1 + L along the grid,
  /// position loop open and closed. This is a fast filter; the stability verdict is that of the
  /// eigenvalues (closed_loop.hpp).
  int unstable_rate_loop = 0;
  int unstable_closed_loop = 0;

  bool stable() const { return unstable_rate_loop == 0 && unstable_closed_loop == 0; }
  double boresight_variance() const { return wind_variance + noise_variance; }
  double highest_peak(LoopBreak loop_break) const;
};

/// The plant data of a loop evaluation: the response on a grid, and between its points. The
/// response may come from a model or a measurement.
struct LoopChannels {
  plant::PlantResponse response;
  std::function<plant::ResponsePoint(double frequency)> at;
};
LoopChannels make_channels(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency);

/// Range and accuracy of an evaluator that chooses its frequencies. The frequencies from
/// `analysis.lowest` to `analysis.highest` are divided into panels of eight Gauss points in ln f,
/// with limits at the edges of rms band and noise. A panel is no wider than `widest_panel`, and the
/// plant's channels are polynomials of that degree within `channel_tolerance` of their largest
/// value in it. An evaluation halves panels further where its own closed loop requires it. One
/// reason is poles near the axis that leave variances and their gradients an error near `tolerance`
/// of the variance. The other is a 1 + L that turns by more than a right angle from point to point.
struct LoopQuadrature {
  FrequencyBand analysis{1e-4, 100.0};  // Hz: peaks and stability
  /// Hz: variances. If it begins below the analysis band, the density below that band is assumed
  /// constant.
  FrequencyBand band{};
  /// Limit on the estimated error of one panel divided by the square root of its half width in ln
  /// f, relative to the whole variance of boresight, effort, demand or torque.
  double tolerance = 3e-11;
  double channel_tolerance = 0.1;
  double widest_panel = 2.0;  // in ln f
};

/// Inputs of an evaluator on given frequencies, in addition to the plant.
struct GridConditions {
  double delay = 0.0;  // s, of the command
  SensorNoise noise{};
  /// One-sided spectrum of the wind torque at the motor shaft, (N m)^2/Hz, at the frequencies of
  /// the grid.
  Eigen::ArrayXd wind_spectrum{};
  FrequencyBand band{};  // of the variances; noise: within its bandwidth too
};

/// The same for an evaluator that chooses its frequencies.
struct PanelConditions {
  double delay = 0.0;  // s, of the command
  SensorNoise noise{};
  /// As above, at a frequency in Hz. Must be smooth; use a grid for spectra with kinks.
  std::function<double(double hertz)> wind_spectrum{};
  LoopQuadrature quadrature{};
};

/// Evaluates controllers on one plant. The plant enters only through its frequency response, which
/// is computed once. An evaluation takes some hundred operations per frequency. All gradients take
/// ten more per gain (by the adjoint of the closed loop). The number of structural modes does not
/// matter. Dead time is exact. Copies are independent. Use one object in one thread only, because
/// it keeps its work arrays and the frequencies that evaluations requested.
class LoopEvaluator {
 public:
  /// For a grid (rad/s). Integrals cover the part of it within the band by the trapezoid rule in ln
  /// f; include the band edges in the grid. Peaks, of a state space below its
  /// nyquist_frequency, and stability cover the whole grid.
  /// @throws InvalidInput for sizes that differ, fewer than three frequencies, or a grid that does
  /// not rise.
  LoopEvaluator(LoopChannels channels, const GridConditions& conditions);
  LoopEvaluator(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency,
                const GridConditions& conditions);
  /// For adaptively chosen frequencies (LoopQuadrature). The integrals of every controller reach
  /// the stated tolerance, however lightly its closed loop is damped. Frequencies requested for one
  /// controller are reused for the next; no value depends on earlier evaluations. `channels`: the
  /// response at a frequency in rad/s, smooth.
  /// @throws InvalidInput for bands that are not in order or do not overlap, or a tolerance or
  /// panel width that is not positive; NumericalFailure for a response or spectrum that is not
  /// finite.
  LoopEvaluator(std::function<plant::ResponsePoint(double frequency)> channels,
                PanelConditions conditions);
  LoopEvaluator(const LoopEvaluator& other);
  LoopEvaluator(LoopEvaluator&& other) noexcept;
  LoopEvaluator& operator=(const LoopEvaluator& other);
  LoopEvaluator& operator=(LoopEvaluator&& other) noexcept;
  ~LoopEvaluator();

  /// Selects the breaks whose peaks are computed; all by default.
  void look_at(std::array<bool, 3> breaks);
  /// Selects whether the variances of valve demand and motor torque by wind are computed; false by
  /// default.
  void look_at_gusts(bool look);

  /// @throws InvalidInput as control::validate.
  LoopEvaluation evaluate(const Controller& controller, bool with_gradients);
  /// Number of frequencies of the last evaluation.
  std::size_t frequencies_used() const;

  /// |boresight / wind torque|^2 of the closed loop at each frequency of the grid, rad^2/(N m)^2.
  Eigen::ArrayXd wind_transmission(const Controller& controller) const;

  /// Response of the plant on the grid, or on the panels that every evaluation starts from.
  const plant::PlantResponse& response() const;
  double delay() const;
  /// Weights that turn a sum over the response's frequencies into an integral over Hz.
  const Eigen::ArrayXd& integration_weight() const;

 private:
  class State;  // loop_evaluator_state.hpp
  std::unique_ptr<State> state_;
};

}  // namespace boresight::control
