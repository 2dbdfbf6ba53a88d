#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/loop_evaluator.hpp>
#include <boresight/control/loop_winding.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2.0 * std::numbers::pi;

// The loop at one frequency.
struct LoopPoint {
  CompensatorResponse compensator;
  Complex dead_time;
  Complex angle;        // what the position path sees of a command: encoder less compliance
  Complex rate_return;  // 1 + L, position loop open
  Complex both_return;  // 1 + L, both closed
};

LoopPoint loop_point(const plant::ResponsePoint& response, const ControlLaw& law, double frequency,
                     double delay) {
  LoopPoint point;
  point.compensator = compensator_response(law, frequency);
  const auto& c = point.compensator;
  point.dead_time = std::polar(1.0, -frequency * delay);
  point.angle = response.encoder_command - c.compliance * response.torque_command;
  point.rate_return = 1.0 + point.dead_time * (c.rate * response.tachometer_command +
                                               c.pressure * response.torque_command);
  point.both_return = point.rate_return + point.dead_time * c.rate * c.position * point.angle;
  return point;
}

// Derivatives of both returns by ln of the gains of a path, less the factor d ln X/d ln g.
struct ReturnDerivative {
  Complex rate, both;
};

ReturnDerivative return_derivative(const LoopPoint& point, const plant::ResponsePoint& response,
                                   LoopPath path) {
  const auto& c = point.compensator;
  const Complex position = point.dead_time * c.rate * c.position * point.angle;
  switch (path) {
    case LoopPath::rate: {
      const Complex rate = point.dead_time * c.rate * response.tachometer_command;
      return {rate, rate + position};
    }
    case LoopPath::pressure: {
      const Complex pressure = point.dead_time * c.pressure * response.torque_command;
      return {pressure, pressure};
    }
    case LoopPath::position:
      return {0.0, position};
    case LoopPath::compliance:
      return {0.0, -point.dead_time * c.rate * c.position * c.compliance * response.torque_command};
  }
  throw InvalidInput("loop evaluator: not a path");
}

double sensitivity(const LoopPoint& point, LoopBreak loop_break) {
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return 1.0 / std::abs(point.rate_return);
    case LoopBreak::valve_command:
      return 1.0 / std::abs(point.both_return);
    case LoopBreak::position_loop:
      return std::abs(point.rate_return / point.both_return);
  }
  throw InvalidInput("loop evaluator: not a loop break");
}

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

// Vertex of the parabola through three points of ln|S|^2 over ln w, the middle one the highest, and
// how far it rises above that.
struct Vertex {
  double place = 0.0;
  double rise = 0.0;
};

template <typename Point>
Vertex vertex(const Point& left, const Point& middle, const Point& right) {
  const double to_left = left.place - middle.place, to_right = right.place - middle.place;
  const double down_left = left.value - middle.value, down_right = right.value - middle.value;
  const double curvature = (down_right / to_right - down_left / to_left) / (to_right - to_left);
  const double slope = down_left / to_left - curvature * to_left;
  if (!(curvature < 0.0)) return {middle.place, 0.0};
  // A step to the very end of the bracket would not shorten it.
  const double shift = std::clamp(-0.5 * slope / curvature, 0.9 * to_left, 0.9 * to_right);
  return {middle.place + shift, (slope + curvature * shift) * shift};
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

Complex loop_gain(const plant::ResponsePoint& response, double frequency, const ControlLaw& law,
                  double delay, LoopBreak loop_break) {
  const LoopPoint point = loop_point(response, law, frequency, delay);
  const auto& c = point.compensator;
  const Complex rate = point.dead_time * (c.rate * response.tachometer_command +
                                          c.pressure * response.torque_command);
  const Complex position = point.dead_time * c.rate * c.position * point.angle;
  switch (loop_break) {
    case LoopBreak::rate_loop_alone:
      return rate;
    case LoopBreak::valve_command:
      return rate + position;
    case LoopBreak::position_loop:
      return position / (1.0 + rate);
  }
  throw InvalidInput("loop_gain: not a loop break");
}

double LoopEvaluation::highest_peak(LoopBreak loop_break) const {
  const auto& list = peaks[static_cast<std::size_t>(loop_break)];
  return list.empty() ? 1.0 : list.front().magnitude;
}

LoopChannels make_channels(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency) {
  return {plant::plant_response(plant, frequency), plant::PointResponse(plant)};
}

LoopEvaluator::LoopEvaluator(const LoopChannels& channels, double delay, SensorNoise noise,
                             const Eigen::ArrayXd& wind_spectrum, FrequencyBand band)
    : LoopEvaluator(channels, delay, noise, wind_spectrum,
                    integration_weights(channels.response.frequency, band),
                    integration_weights(channels.response.frequency,
                                        {band.lowest, std::min(band.highest, noise.bandwidth)})) {}

LoopEvaluator::LoopEvaluator(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency,
                             double delay, SensorNoise noise, const Eigen::ArrayXd& wind_spectrum,
                             FrequencyBand band)
    : LoopEvaluator(make_channels(plant, frequency), delay, noise, wind_spectrum, band) {}

LoopEvaluator::LoopEvaluator(LoopChannels channels, double delay, SensorNoise noise,
                             const Eigen::ArrayXd& wind_spectrum, const Eigen::ArrayXd& weight,
                             const Eigen::ArrayXd& noise_weight)
    : channels_(std::move(channels)), delay_(delay), noise_(noise), weight_(weight) {
  const Eigen::Index count = channels_.response.frequency.size();
  for (const auto* numbers : {&wind_spectrum, &weight, &noise_weight}) {
    if (numbers->size() != count) {
      throw InvalidInput(fmt::format(
          "LoopEvaluator: expected as many wind values and weights as frequencies, found {} and {}",
          numbers->size(), count));
    }
  }
  fill_packs(wind_spectrum, noise_weight);
}

void LoopEvaluator::fill_packs(const Eigen::ArrayXd& wind_spectrum,
                               const Eigen::ArrayXd& noise_weight) {
  const plant::PlantResponse& response = channels_.response;
  const Eigen::Index count = response.frequency.size();
  packs_.resize(plant::pack_count(static_cast<std::size_t>(count)));
  // The last pack is filled up with the last frequency, without weight.
  for (std::size_t i = 0; i < packs_.size() * plant::pack_size; ++i) {
    const bool there = static_cast<Eigen::Index>(i) < count;
    const Eigen::Index k = std::min(static_cast<Eigen::Index>(i), count - 1);
    const double w = response.frequency[k];
    const Complex dead_time = std::polar(1.0, -w * delay_);
    GridPack& pack = packs_[i / plant::pack_size];
    const std::size_t lane = i % plant::pack_size;
    pack.frequency.set(lane, w);
    pack.wind_weight.set(lane, there ? weight_[k] * wind_spectrum[k] : 0.0);
    pack.noise_weight.set(lane, there ? noise_weight[k] : 0.0);
    if (pack.noise_weight[lane] > 0.0) noise_packs_ = i / plant::pack_size + 1;
    const auto set = [&](plant::ComplexPack& place, Complex value) {
      place.re.set(lane, value.real());
      place.im.set(lane, value.imag());
    };
    set(pack.tachometer_command, response.tachometer_command[k] * dead_time);
    set(pack.torque_command, response.torque_command[k] * dead_time);
    set(pack.encoder_command, response.encoder_command[k] * dead_time);
    set(pack.beam_command, response.beam_command[k] * dead_time);
    set(pack.tachometer_wind, response.tachometer_wind[k]);
    set(pack.torque_wind, response.torque_wind[k]);
    set(pack.encoder_wind, response.encoder_wind[k]);
    set(pack.beam_wind, response.beam_wind[k]);
  }
  rate_return_.resize(packs_.size());
  both_return_.resize(packs_.size());
  for (auto& square : sensitivity_square_) square.resize(packs_.size());
}

LoopEvaluation LoopEvaluator::evaluate(const ControlLaw& law, bool with_gradients) {
  validate(law);
  LoopEvaluation result;
  sweep(law, with_gradients, result);
  int rate_integrators = 0, position_integrators = 0;
  for (const LoopBlock& block : law.structure.blocks()) {
    if (block.kind != BlockKind::integral) continue;
    ++(block.path == LoopPath::rate ? rate_integrators : position_integrators);
  }
  // The position loop has the antenna's own integration besides.
  Winding rate_winding(rate_integrators);
  Winding both_winding(rate_integrators + position_integrators + 1);
  const auto count = static_cast<std::size_t>(response().frequency.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pack = i / plant::pack_size, lane = i % plant::pack_size;
    rate_winding.add({rate_return_[pack].re[lane], rate_return_[pack].im[lane]});
    both_winding.add({both_return_[pack].re[lane], both_return_[pack].im[lane]});
  }
  result.unstable_rate_loop = rate_winding.unstable();
  result.unstable_closed_loop = both_winding.unstable();
  for (std::size_t b = 0; b < loop_breaks.size(); ++b) {
    if (breaks_[b]) find_peaks(law, loop_breaks[b], result.peaks[b]);
  }
  return result;
}

SensitivityPeak LoopEvaluator::peak_at(const ControlLaw& law, LoopBreak loop_break,
                                       double frequency) const {
  const plant::ResponsePoint response = channels_.at(frequency);
  const LoopPoint point = loop_point(response, law, frequency, delay_);
  SensitivityPeak peak;
  peak.frequency = frequency;
  peak.magnitude = sensitivity(point, loop_break);
  std::size_t k = 0;
  for (const LoopBlock& block : law.structure.blocks()) {
    const ReturnDerivative change = return_derivative(point, response, block.path);
    const Complex of_rate = change.rate / point.rate_return;
    const Complex of_both = change.both / point.both_return;
    const Complex of_break = loop_break == LoopBreak::rate_loop_alone ? -of_rate
                             : loop_break == LoopBreak::valve_command ? -of_both
                                                                      : of_rate - of_both;
    for (std::size_t j = 0; j < block.gains.size(); ++j, ++k) {
      peak.log_gradient[k] = (of_break * point.compensator.by_gain[k]).real();
    }
  }
  return peak;
}

// Successive parabolas through the best point and its neighbours, whose values are all exact.
SensitivityPeak LoopEvaluator::polish(const ControlLaw& law, LoopBreak loop_break,
                                      std::array<LogPoint, 3> bracket) const {
  constexpr int most_steps = 8;
  constexpr double enough = 1e-11;  // of ln|S|^2
  SensitivityPeak best;
  for (int step = 0; step < most_steps; ++step) {
    auto& [left, middle, right] = bracket;
    const Vertex top = vertex(left, middle, right);
    const bool done = top.rise < enough;
    if (done && step > 0) break;
    const SensitivityPeak peak = peak_at(law, loop_break, std::exp(top.place));
    if (peak.magnitude > best.magnitude) best = peak;
    const LogPoint found{top.place, 2.0 * std::log(peak.magnitude)};
    if (done || found.place == middle.place) break;
    // The highest of the four with its neighbours.
    const bool beyond = found.place > middle.place;
    if (found.value > middle.value) {
      (beyond ? left : right) = middle;
      middle = found;
    } else {
      (beyond ? right : left) = found;
    }
  }
  return best;
}

void LoopEvaluator::find_peaks(const ControlLaw& law, LoopBreak loop_break, PeakList& peaks) const {
  const auto& packs = sensitivity_square_[static_cast<std::size_t>(loop_break)];
  const auto square = [&](Eigen::Index i) {
    const auto place = static_cast<std::size_t>(i);
    return packs[place / plant::pack_size][place % plant::pack_size];
  };
  const Eigen::ArrayXd& w = response().frequency;
  // The highest few, in falling order.
  std::array<Eigen::Index, PeakList::most> maxima{};
  std::size_t count = 0;
  double before = square(0), here = square(1);
  for (Eigen::Index i = 1; i + 1 < w.size(); ++i) {
    const double after = square(i + 1);
    if (here > 1.0 && here >= before && here > after) {
      std::size_t place = count;
      while (place > 0 && square(maxima[place - 1]) < here) --place;
      if (place < PeakList::most) {
        count = std::min(count + 1, PeakList::most);
        for (std::size_t j = count - 1; j > place; --j) maxima[j] = maxima[j - 1];
        maxima[place] = i;
      }
    }
    before = here;
    here = after;
  }
  for (std::size_t m = 0; m < count; ++m) {
    const Eigen::Index i = maxima[m];
    const auto on_grid = [&](Eigen::Index k) {
      return LogPoint{std::log(w[k]), std::log(square(k))};
    };
    peaks.push_back(polish(law, loop_break, {on_grid(i - 1), on_grid(i), on_grid(i + 1)}));
  }
  std::sort(peaks.begin(), peaks.end(), [](const SensitivityPeak& x, const SensitivityPeak& y) {
    return x.magnitude > y.magnitude;
  });
}

Eigen::ArrayXd LoopEvaluator::wind_transmission(const ControlLaw& law) const {
  validate(law);
  const plant::PlantResponse& plant = response();
  Eigen::ArrayXd square(plant.frequency.size());
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const plant::ResponsePoint here = plant::point(plant, i);
    const LoopPoint point = loop_point(here, law, plant.frequency[i], delay_);
    const auto& c = point.compensator;
    const Complex measured =
        c.rate * (here.tachometer_wind +
                  c.position * (here.encoder_wind - c.compliance * here.torque_wind)) +
        c.pressure * here.torque_wind;
    square[i] = std::norm(here.beam_wind -
                          here.beam_command * point.dead_time * measured / point.both_return);
  }
  return square;
}

}  // namespace boresight::control
