#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <boresight/control/loops/loop_encirclements.hpp>
#include <boresight/control/loops/loop_evaluator_state.hpp>
#include <boresight/control/loops/loop_point.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

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

}  // namespace

LoopPoint loop_point(const plant::ResponsePoint& response, const Controller& controller,
                     double frequency, double delay) {
  LoopPoint point;
  point.compensator = compensator_response(controller, frequency);
  const auto& c = point.compensator;
  point.dead_time = std::polar(1.0, -frequency * delay);
  point.angle = response.encoder_command - c.compliance * response.torque_command;
  point.rate_return = 1.0 + point.dead_time * (c.rate * response.tachometer_command +
                                               c.pressure * response.torque_command);
  point.both_return = point.rate_return + point.dead_time * c.rate * c.position * point.angle;
  return point;
}

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

Complex loop_gain(const plant::ResponsePoint& response, double frequency,
                  const Controller& controller, double delay, LoopBreak loop_break) {
  const LoopPoint point = loop_point(response, controller, frequency, delay);
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

bool has_break(const Controller& controller, LoopBreak loop_break) {
  return loop_break == LoopBreak::valve_command || controller.structure.state_space() == nullptr;
}

double LoopEvaluation::highest_peak(LoopBreak loop_break) const {
  const auto& list = peaks[static_cast<std::size_t>(loop_break)];
  return list.empty() ? 1.0 : list.front().magnitude;
}

LoopChannels make_channels(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency) {
  return {plant::plant_response(plant, frequency), plant::PointResponse(plant)};
}

LoopEvaluator::LoopEvaluator(LoopChannels channels, const GridConditions& conditions)
    : state_(std::make_unique<State>(std::move(channels), conditions)) {}

LoopEvaluator::LoopEvaluator(const plant::AntennaPlant& plant, const Eigen::ArrayXd& frequency,
                             const GridConditions& conditions)
    : LoopEvaluator(make_channels(plant, frequency), conditions) {}

LoopEvaluator::LoopEvaluator(std::function<plant::ResponsePoint(double)> channels,
                             PanelConditions conditions)
    : state_(std::make_unique<State>(std::move(channels), std::move(conditions))) {}

LoopEvaluator::LoopEvaluator(const LoopEvaluator& other)
    : state_(std::make_unique<State>(*other.state_)) {}

LoopEvaluator& LoopEvaluator::operator=(const LoopEvaluator& other) {
  return *this = LoopEvaluator(other);
}

LoopEvaluator::LoopEvaluator(LoopEvaluator&& other) noexcept = default;
LoopEvaluator& LoopEvaluator::operator=(LoopEvaluator&& other) noexcept = default;
LoopEvaluator::~LoopEvaluator() = default;

void LoopEvaluator::look_at(std::array<bool, 3> breaks) {
  state_->look_at(breaks);
}

void LoopEvaluator::look_at_gusts(bool look) {
  state_->look_at_gusts(look);
}

LoopEvaluation LoopEvaluator::evaluate(const Controller& controller, bool with_gradients) {
  return state_->evaluate(controller, with_gradients);
}

std::size_t LoopEvaluator::frequencies_used() const {
  return state_->frequencies_used();
}

Eigen::ArrayXd LoopEvaluator::wind_transmission(const Controller& controller) const {
  return state_->wind_transmission(controller);
}

const plant::PlantResponse& LoopEvaluator::response() const {
  return state_->response();
}

double LoopEvaluator::delay() const {
  return state_->delay();
}

const Eigen::ArrayXd& LoopEvaluator::integration_weight() const {
  return state_->integration_weight();
}

LoopEvaluator::State::State(LoopChannels channels, const GridConditions& conditions)
    : channels_(std::move(channels)), delay_(conditions.delay), noise_(conditions.noise) {
  const plant::PlantResponse& response = channels_.response;
  const auto& [lowest, highest] = conditions.band;
  weight_ = integration_weights(response.frequency, conditions.band);
  const Eigen::ArrayXd noise_weight =
      integration_weights(response.frequency, {lowest, std::min(highest, noise_.bandwidth)});
  const Eigen::ArrayXd& wind_spectrum = conditions.wind_spectrum;
  const Eigen::Index count = response.frequency.size();
  if (wind_spectrum.size() != count) {
    throw InvalidInput(
        fmt::format("LoopEvaluator: expected as many wind values as frequencies, found {} and {}",
                    wind_spectrum.size(), count));
  }
  packs_.resize(numerics::pack_count(static_cast<std::size_t>(count)));
  values_.resize(packs_.size());
  leaves_.resize(packs_.size());
  std::iota(leaves_.begin(), leaves_.end(), 0U);
  // The last pack is filled up with the last frequency, without weight.
  for (std::size_t i = 0; i < packs_.size() * numerics::pack_size; ++i) {
    const bool there = static_cast<Eigen::Index>(i) < count;
    const Eigen::Index k = std::min(static_cast<Eigen::Index>(i), count - 1);
    GridPack& pack = packs_[i / numerics::pack_size];
    const std::size_t lane = i % numerics::pack_size;
    pack.set(lane, response.frequency[k], plant::point(response, k), delay_);
    pack.set_weights(lane, there ? weight_[k] * wind_spectrum[k] : 0.0,
                     there ? noise_weight[k] : 0.0);
  }
}

void LoopEvaluator::State::GridPack::set(std::size_t lane, double w,
                                         const plant::ResponsePoint& response, double delay) {
  const Complex dead_time = std::polar(1.0, -w * delay);
  frequency.set(lane, w);
  period.set(lane, 1.0 / w);
  const auto put = [lane](numerics::ComplexPack& place, Complex value) {
    place.re.set(lane, value.real());
    place.im.set(lane, value.imag());
  };
  put(tachometer_command, response.tachometer_command * dead_time);
  put(torque_command, response.torque_command * dead_time);
  put(encoder_command, response.encoder_command * dead_time);
  put(boresight_command, response.boresight_command * dead_time);
  put(tachometer_wind, response.tachometer_wind);
  put(torque_wind, response.torque_wind);
  put(encoder_wind, response.encoder_wind);
  put(boresight_wind, response.boresight_wind);
}

void LoopEvaluator::State::GridPack::set_weights(std::size_t lane, double wind, double noise) {
  wind_weight.set(lane, wind);
  noise_weight.set(lane, noise);
  noisy = noisy || noise > 0.0;
  weighted = weighted || noisy || wind > 0.0;
}

void LoopEvaluator::State::count_unstable(const Controller& controller,
                                          LoopEvaluation& result) const {
  int rate_integrators = 0, position_integrators = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (block.kind != BlockKind::integral) continue;
    ++(block.path == LoopPath::rate ? rate_integrators : position_integrators);
  }
  // The position loop has the antenna's own integration besides.
  EncirclementCount rate_encirclements(rate_integrators);
  EncirclementCount both_encirclements(rate_integrators + position_integrators + 1);
  std::size_t left = points();
  for (const std::uint32_t i : leaves_) {
    const LoopValues& values = values_[i];
    const std::size_t lanes = std::min(numerics::pack_size, left);
    rate_encirclements.add(values.rate_return, lanes);
    both_encirclements.add(values.both_return, lanes);
    left -= lanes;
  }
  // A state space has no loop to leave closed alone.
  const bool rate_loop = controller.structure.state_space() == nullptr;
  result.unstable_rate_loop = rate_loop ? rate_encirclements.unstable() : 0;
  result.unstable_closed_loop = both_encirclements.unstable();
}

LoopEvaluation LoopEvaluator::State::evaluate(const Controller& controller, bool with_gradients) {
  validate(controller);
  LoopEvaluation result;
  const Sweep sweep = prepare(controller);
  if (panels_.empty()) {
    sweep_values(sweep, leaves_.data(), leaves_.size());
  } else {
    choose_leaves(sweep);
  }
  numerics::RealPack wind{}, noise{}, effort{}, wind_demand{}, wind_torque{};
  for (const std::uint32_t i : leaves_) {
    const LoopValues& values = values_[i];
    wind += values.wind;
    noise += values.noise;
    effort += values.effort;
    if (gusts_) {
      wind_demand += values.wind_demand;
      wind_torque += values.wind_torque;
    }
  }
  result.wind_variance = numerics::sum(wind);
  result.noise_variance = numerics::sum(noise);
  result.effort_variance = numerics::sum(effort);
  result.wind_demand_variance = numerics::sum(wind_demand);
  result.wind_torque_variance = numerics::sum(wind_torque);
  if (with_gradients) sweep_gradients(sweep, result);
  count_unstable(controller, result);
  for (std::size_t b = 0; b < loop_breaks.size(); ++b) {
    if (breaks_[b] && has_break(controller, loop_breaks[b])) {
      find_peaks(controller, loop_breaks[b], result.peaks[b]);
    }
  }
  return result;
}

Eigen::ArrayXd LoopEvaluator::State::wind_transmission(const Controller& controller) const {
  validate(controller);
  const plant::PlantResponse& plant = response();
  Eigen::ArrayXd square(plant.frequency.size());
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const plant::ResponsePoint here = plant::point(plant, i);
    const LoopPoint point = loop_point(here, controller, plant.frequency[i], delay_);
    const auto& c = point.compensator;
    const Complex measured =
        c.rate * (here.tachometer_wind +
                  c.position * (here.encoder_wind - c.compliance * here.torque_wind)) +
        c.pressure * here.torque_wind;
    square[i] = std::norm(here.boresight_wind -
                          here.boresight_command * point.dead_time * measured / point.both_return);
  }
  return square;
}

}  // namespace boresight::control
