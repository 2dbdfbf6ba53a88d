#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/loop_evaluator.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2.0 * std::numbers::pi;

// The loop at one frequency.
struct LoopPoint {
  CompensatorResponse compensator;
  Complex delayed_rate;   // R exp(-s delay)
  Complex rate_loop;      // L_rate
  Complex position_part;  // R exp(-s delay) P encoder/command
};

LoopPoint loop_point(const plant::PlantResponse& response, Eigen::Index i, const ControlLaw& law,
                     Complex dead_time) {
  LoopPoint point;
  point.compensator = compensator_response(law, response.frequency[i]);
  point.delayed_rate = point.compensator.rate * dead_time;
  point.rate_loop = point.delayed_rate * response.tachometer_command[i];
  point.position_part =
      point.delayed_rate * point.compensator.position * response.encoder_command[i];
  return point;
}

// Derivatives of 1 + L_rate and of 1 + L_rate + L_position by ln of gain k.
struct LoopDerivative {
  Complex rate_loop;
  Complex both;
};

LoopDerivative derivative(const LoopPoint& point, std::size_t k) {
  const Complex rate = point.compensator.rate_by_gain[k];
  const Complex position = point.compensator.position_by_gain[k];
  const Complex of_rate = point.rate_loop * rate;
  return {of_rate, of_rate + point.position_part * (rate + position)};
}

// Counts the right-half-plane zeros of 1 + L from its turning along the positive frequencies.
class Winding {
 public:
  // L starts as c/s^integrators with c > 0.
  explicit Winding(int integrators) : start_(-integrators * std::numbers::pi / 2.0) {}
  void add(Complex value) {
    if (first_) {
      first_value_ = value;
      first_ = false;
    } else if ((last_.imag() < 0.0) != (value.imag() < 0.0)) {
      // Where the chord meets the real axis: only left of the origin the phase jumps by a turn.
      const double real = last_.real() - last_.imag() * (value.real() - last_.real()) /
                                             (value.imag() - last_.imag());
      if (real < 0.0) turns_ += value.imag() < 0.0 ? 1 : -1;
    }
    last_ = value;
  }
  int unstable() const {
    const double from_start = std::remainder(std::arg(first_value_) - start_, two_pi);
    const double along = std::arg(last_) - std::arg(first_value_) + two_pi * turns_;
    const double to_end = -std::arg(last_);
    // A stable loop turns by -start from 0 to infinity, where 1 + L is 1; each zero in the right
    // half plane takes a turn of pi away.
    return static_cast<int>(
        std::lround((-start_ - from_start - along - to_end) / std::numbers::pi));
  }

 private:
  double start_;
  Complex first_value_, last_;
  int turns_ = 0;
  bool first_ = true;
};

// Trapezoid weights in ln f, per Hz, of the intervals that lie within the band.
Eigen::ArrayXd integration_weights(const Eigen::ArrayXd& frequency, const FrequencyBand& band) {
  if (frequency.size() < 3) {
    throw InvalidInput(
        fmt::format("LoopEvaluator: expected at least 3 frequencies, found {}", frequency.size()));
  }
  constexpr double rounding = 1e-9;
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(frequency.size());
  for (Eigen::Index i = 0; i + 1 < frequency.size(); ++i) {
    if (!(frequency[i] > 0.0) || !(frequency[i + 1] > frequency[i])) {
      throw InvalidInput("LoopEvaluator: expected positive, rising frequencies");
    }
    if (frequency[i] < two_pi * band.lowest * (1.0 - rounding) ||
        frequency[i + 1] > two_pi * band.highest * (1.0 + rounding)) {
      continue;
    }
    const double half_step = 0.5 * std::log(frequency[i + 1] / frequency[i]);
    weight[i] += half_step * frequency[i] / two_pi;
    weight[i + 1] += half_step * frequency[i + 1] / two_pi;
  }
  return weight;
}

void accumulate(std::array<double, most_gains>& sum, double weight, std::size_t k, Complex value,
                Complex change) {
  // d|value|^2 = 2 Re(conj(value) d value)
  sum[k] += weight * 2.0 * (value.real() * change.real() + value.imag() * change.imag());
}

}  // namespace

std::string_view to_string(LoopBreak loop_break) {
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return "rate loop alone";
    case LoopBreak::valve_command:
      return "valve command";
    case LoopBreak::position_loop:
      return "position loop";
  }
  throw InvalidInput("to_string: not a loop break");
}

Complex loop_gain(const plant::PlantResponse& response, Eigen::Index i, const ControlLaw& law,
                  double delay, LoopBreak loop_break) {
  const LoopPoint point =
      loop_point(response, i, law, std::polar(1.0, -response.frequency[i] * delay));
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return point.rate_loop;
    case LoopBreak::valve_command:
      return point.rate_loop + point.position_part;
    case LoopBreak::position_loop:
      return point.position_part / (1.0 + point.rate_loop);
  }
  throw InvalidInput("loop_gain: not a loop break");
}

double LoopEvaluation::highest_peak(LoopBreak loop_break) const {
  const auto& list = peaks[static_cast<std::size_t>(loop_break)];
  return list.empty() ? 1.0 : list.front().magnitude;
}

LoopEvaluator::LoopEvaluator(plant::AntennaPlant plant, const Eigen::ArrayXd& frequency,
                             double delay, SensorNoise noise, const Eigen::ArrayXd& wind_spectrum,
                             FrequencyBand band)
    : plant_(std::move(plant)),
      response_(plant::plant_response(plant_, frequency)),
      delay_(delay),
      noise_(noise),
      weight_(integration_weights(frequency, band)),
      wind_weight_(weight_),
      noise_weight_(
          integration_weights(frequency, {band.lowest, std::min(band.highest, noise.bandwidth)})) {
  const Eigen::Index count = frequency.size();
  if (wind_spectrum.size() != count) {
    throw InvalidInput(
        fmt::format("LoopEvaluator: expected as many wind values as frequencies, found {} and {}",
                    wind_spectrum.size(), count));
  }
  wind_weight_ *= wind_spectrum;
  dead_time_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) dead_time_[i] = std::polar(1.0, -frequency[i] * delay);
  for (auto& array : sensitivity_square_) array.resize(count);
}

LoopEvaluation LoopEvaluator::evaluate(const ControlLaw& law, bool with_gradients) {
  validate(law);
  const std::size_t gains = law.gains.size();
  const double encoder_density = noise_.encoder_rms * noise_.encoder_rms / noise_.bandwidth;
  const double tachometer_density =
      noise_.tachometer_rms * noise_.tachometer_rms / noise_.bandwidth;
  LoopEvaluation result;
  Winding rate_winding(1);
  Winding both_winding(3);
  for (Eigen::Index i = 0; i < response_.frequency.size(); ++i) {
    const LoopPoint point = loop_point(response_, i, law, dead_time_[i]);
    const Complex rate_return = 1.0 + point.rate_loop;
    const Complex both_return = rate_return + point.position_part;
    rate_winding.add(rate_return);
    both_winding.add(both_return);
    const double rate_square = std::norm(rate_return);
    const double both_square = std::norm(both_return);
    const double inverse_square = 1.0 / both_square;
    sensitivity_square_[0][i] = 1.0 / rate_square;
    sensitivity_square_[1][i] = inverse_square;
    sensitivity_square_[2][i] = rate_square * inverse_square;

    const Complex inverse = std::conj(both_return) * inverse_square;
    const Complex position = point.compensator.position;
    // What the loop adds to the beam: -beam/command times (measured rate + P measured angle).
    const Complex act = -response_.beam_command[i] * point.delayed_rate * inverse;
    const Complex measured = response_.tachometer_wind[i] + position * response_.encoder_wind[i];
    const Complex wind = response_.beam_wind[i] + act * measured;
    const Complex encoder = act * position;
    const Complex effort_rate = point.compensator.rate * inverse;
    const Complex effort_position = effort_rate * position;

    const double wind_weight = wind_weight_[i];
    const double encoder_weight = noise_weight_[i] * encoder_density;
    const double tachometer_weight = noise_weight_[i] * tachometer_density;
    result.wind_variance += wind_weight * std::norm(wind);
    result.noise_variance +=
        encoder_weight * std::norm(encoder) + tachometer_weight * std::norm(act);
    result.effort_variance +=
        encoder_weight * std::norm(effort_position) + tachometer_weight * std::norm(effort_rate);
    if (!with_gradients) continue;
    for (std::size_t k = 0; k < gains; ++k) {
      const Complex by_rate = point.compensator.rate_by_gain[k];
      const Complex by_position = point.compensator.position_by_gain[k];
      const Complex by_return = derivative(point, k).both * inverse;
      const Complex relative = by_rate - by_return;
      const Complex act_change = act * relative;
      accumulate(result.wind_log_gradient, wind_weight, k, wind,
                 act_change * measured + act * position * by_position * response_.encoder_wind[i]);
      accumulate(result.noise_log_gradient, encoder_weight, k, encoder,
                 encoder * (relative + by_position));
      accumulate(result.noise_log_gradient, tachometer_weight, k, act, act_change);
      accumulate(result.effort_log_gradient, encoder_weight, k, effort_position,
                 effort_position * (relative + by_position));
      accumulate(result.effort_log_gradient, tachometer_weight, k, effort_rate,
                 effort_rate * relative);
    }
  }
  result.unstable_rate_loop = rate_winding.unstable();
  result.unstable_closed_loop = both_winding.unstable();
  for (std::size_t b = 0; b < loop_breaks.size(); ++b) {
    result.peaks[b] = find_peaks(law, loop_breaks[b], sensitivity_square_[b]);
  }
  return result;
}

SensitivityPeak LoopEvaluator::peak_at(const ControlLaw& law, LoopBreak loop_break,
                                       double frequency) const {
  const auto response = plant::plant_response(plant_, Eigen::ArrayXd::Constant(1, frequency));
  const LoopPoint point = loop_point(response, 0, law, std::polar(1.0, -frequency * delay_));
  const Complex rate_return = 1.0 + point.rate_loop;
  const Complex both_return = rate_return + point.position_part;
  SensitivityPeak peak;
  peak.frequency = frequency;
  const bool alone = loop_break == LoopBreak::rate_loop_alone;
  peak.magnitude = alone                                    ? 1.0 / std::abs(rate_return)
                   : loop_break == LoopBreak::valve_command ? 1.0 / std::abs(both_return)
                                                            : std::abs(rate_return / both_return);
  for (std::size_t k = 0; k < law.gains.size(); ++k) {
    const LoopDerivative change = derivative(point, k);
    const double of_rate = (change.rate_loop / rate_return).real();
    const double of_both = (change.both / both_return).real();
    peak.log_gradient[k] = alone                                    ? -of_rate
                           : loop_break == LoopBreak::valve_command ? -of_both
                                                                    : of_rate - of_both;
  }
  return peak;
}

std::vector<SensitivityPeak> LoopEvaluator::find_peaks(const ControlLaw& law, LoopBreak loop_break,
                                                       const Eigen::ArrayXd& square) const {
  constexpr std::size_t kept = 3;
  std::vector<Eigen::Index> maxima;
  for (Eigen::Index i = 1; i + 1 < square.size(); ++i) {
    if (square[i] > 1.0 && square[i] >= square[i - 1] && square[i] > square[i + 1]) {
      maxima.push_back(i);
    }
  }
  const std::size_t count = std::min(kept, maxima.size());
  std::partial_sort(maxima.begin(), maxima.begin() + static_cast<std::ptrdiff_t>(count),
                    maxima.end(),
                    [&](Eigen::Index x, Eigen::Index y) { return square[x] > square[y]; });
  std::vector<SensitivityPeak> peaks;
  for (std::size_t m = 0; m < count; ++m) {
    // Vertex of the parabola through three points in (ln w, ln |S|^2), then the exact response
    // there.
    const Eigen::Index i = maxima[m];
    const double left = std::log(response_.frequency[i - 1] / response_.frequency[i]);
    const double right = std::log(response_.frequency[i + 1] / response_.frequency[i]);
    const double down_left = std::log(square[i - 1] / square[i]);
    const double down_right = std::log(square[i + 1] / square[i]);
    const double curvature = (down_right / right - down_left / left) / (right - left);
    const double slope = down_left / left - curvature * left;
    const double shift = curvature < 0.0 ? std::clamp(-0.5 * slope / curvature, left, right) : 0.0;
    peaks.push_back(peak_at(law, loop_break, response_.frequency[i] * std::exp(shift)));
  }
  std::sort(peaks.begin(), peaks.end(), [](const SensitivityPeak& x, const SensitivityPeak& y) {
    return x.magnitude > y.magnitude;
  });
  return peaks;
}

Eigen::ArrayXd LoopEvaluator::wind_transmission(const ControlLaw& law) const {
  validate(law);
  Eigen::ArrayXd square(response_.frequency.size());
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const LoopPoint point = loop_point(response_, i, law, dead_time_[i]);
    const Complex measured =
        response_.tachometer_wind[i] + point.compensator.position * response_.encoder_wind[i];
    square[i] = std::norm(response_.beam_wind[i] -
                          response_.beam_command[i] * point.delayed_rate * measured /
                              (1.0 + point.rate_loop + point.position_part));
  }
  return square;
}

}  // namespace boresight::control
