#include <numbers>
#include <optional>

#include <boresight/design/held_gains_evaluator.hpp>
#include <boresight/plant/point_response.hpp>

namespace boresight::design {

struct HeldGainsEvaluator::State {
  TrackingProblem problem;
  control::ControlLaw law;
  bool gusts = false;
  HeldGainsOptions options;
  std::optional<WindTable> wind, climate;
  Eigen::ArrayXd frequency;
  std::size_t used = 0;

  control::LoopEvaluation look(const plant::AntennaPlant& plant, const WindTable& table) {
    control::LoopQuadrature quadrature;
    quadrature.analysis = analysis_band(problem);
    quadrature.band = problem.rms_band;
    quadrature.tolerance = options.tolerance;
    control::LoopEvaluator evaluator(
        plant::PointResponse(plant), problem.delay, problem.noise,
        [&](double hertz) { return table.spectrum(2.0 * std::numbers::pi * hertz); }, quadrature);
    evaluator.look_at_gusts(gusts);
    const auto values = evaluator.evaluate(law, false);
    used = evaluator.frequencies_used();
    return values;
  }
};

HeldGainsEvaluator::HeldGainsEvaluator(const TrackingProblem& problem,
                                       const control::ControlLaw& law, const HardGoals& goals,
                                       const HeldGainsOptions& options)
    : state_(std::make_unique<State>()) {
  control::validate(law);
  state_->problem = problem;
  state_->law = law;
  state_->gusts = goals.ask_for_gusts();
  state_->options = options;
  TrackingProblem at_speed = problem;
  at_speed.climate.clear();
  state_->wind = WindTable(at_speed);
  if (!problem.climate.empty()) state_->climate = WindTable(problem);
  state_->frequency = analysis_grid(problem);
}

HeldGainsEvaluator::~HeldGainsEvaluator() = default;
HeldGainsEvaluator::HeldGainsEvaluator(const HeldGainsEvaluator& other)
    : state_(std::make_unique<State>(*other.state_)) {}
HeldGainsEvaluator& HeldGainsEvaluator::operator=(const HeldGainsEvaluator& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
HeldGainsEvaluator::HeldGainsEvaluator(HeldGainsEvaluator&& other) noexcept = default;
HeldGainsEvaluator& HeldGainsEvaluator::operator=(HeldGainsEvaluator&& other) noexcept = default;

HeldGainsValues HeldGainsEvaluator::evaluate(const plant::AntennaPlant& plant) {
  const auto evaluation = state_->look(plant, *state_->wind);
  HeldGainsValues values;
  values.wind_variance = evaluation.wind_variance;
  values.noise_variance = evaluation.noise_variance;
  values.effort_variance = evaluation.effort_variance;
  values.wind_demand_variance = evaluation.wind_demand_variance;
  values.wind_torque_variance = evaluation.wind_torque_variance;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    values.sensitivity_peaks.at(b) = evaluation.highest_peak(control::loop_breaks.at(b));
  }
  values.stable = evaluation.stable();
  if (state_->climate) {
    values.climate_variance = state_->look(plant, *state_->climate).wind_variance;
  }
  return values;
}

bool HeldGainsEvaluator::near_the_axis(const HeldGainsValues& values) const {
  for (const double peak : values.sensitivity_peaks) {
    if (!(peak <= state_->options.confirm_peak)) return true;
  }
  return !values.stable;
}

control::StabilityVerdict HeldGainsEvaluator::confirm(const plant::AntennaPlant& plant) const {
  return control::stability(plant, state_->law, state_->problem.delay, state_->frequency);
}

const control::ControlLaw& HeldGainsEvaluator::law() const {
  return state_->law;
}

std::size_t HeldGainsEvaluator::frequencies_used() const {
  return state_->used;
}

}  // namespace boresight::design
