#include <algorithm>
#include <array>
#include <cmath>

#include <boresight/design/commissioning/stage_quantities.hpp>

namespace boresight::design {
namespace {

// None: as on the linear plant.
const ExperimentEffect no_effect{};
const ExperimentEffect no_term{StageQuantity::overshoot, 0.0, 0.0, 0.0};

const ExperimentEffect& effect_on(StageQuantity quantity,
                                  const std::vector<ExperimentEffect>& effects) {
  const auto found = std::ranges::find(effects, quantity, &ExperimentEffect::quantity);
  if (found != effects.end()) return *found;
  return quantity == StageQuantity::overshoot ? no_term : no_effect;
}

double combined_with(StageQuantity quantity, double linear, double effect) {
  return quantity == StageQuantity::overshoot ? std::max(0.0, linear + effect) : linear * effect;
}

std::optional<double> limit_of(StageQuantity quantity, const CommissioningStage& stage,
                               const std::vector<ExperimentEffect>& effects) {
  switch (quantity) {
    case StageQuantity::overshoot:
      return stage.abort.overshoot + std::max(0.0, effect_on(quantity, effects).upper);
    case StageQuantity::calm_valve:
      return stage.abort.calm_valve_rms;
    case StageQuantity::calm_encoder:
      return stage.abort.calm_encoder_rms;
    default:
      return std::nullopt;
  }
}

PassInterval interval_of(StageQuantity quantity, const CommissioningStage& stage,
                         double rms_allowance, const std::vector<ExperimentEffect>& effects) {
  const PlantBand& band = expected_of(quantity, stage.expected);
  PassInterval interval{band.lower, band.upper};
  if (quantity == StageQuantity::overshoot) {
    interval = {std::max(0.0, band.lower - overshoot_resolution),
                band.upper + overshoot_resolution};
  } else if (quantity == StageQuantity::rise_time || quantity == StageQuantity::settling_time) {
    interval = {band.lower * (1.0 - time_resolution), band.upper * (1.0 + time_resolution)};
  } else if (quantity == StageQuantity::valve_per_rate ||
             quantity == StageQuantity::flow_per_rate) {
    // No antenna as stated is below 1, where a normal distribution would go.
    interval = {band.minimum * (1.0 - valve_resolution), band.upper * (1.0 + valve_resolution)};
  } else if (quantity == StageQuantity::oil_stiffness) {
    interval = {band.lower * (1.0 - stiffness_resolution),
                band.upper * (1.0 + stiffness_resolution)};
  } else if (is_rms(quantity)) {
    interval = {band.lower / rms_allowance, band.upper * rms_allowance};
  }
  const ExperimentEffect& effect = effect_on(quantity, effects);
  interval = {combined_with(quantity, interval.lower, effect.lower),
              combined_with(quantity, interval.upper, effect.upper)};
  if (const auto limit = limit_of(quantity, stage, effects)) {
    interval.upper = std::min(interval.upper, *limit);
  }
  return interval;
}

StageVerdict verdict_by(StageQuantity quantity, double value, double uncertainty,
                        const CommissioningStage& stage, double rms_allowance,
                        const std::vector<ExperimentEffect>& effects) {
  constexpr double coverage = 2.0;
  const double allowed = coverage * uncertainty;
  const auto limit = limit_of(quantity, stage, effects);
  if (limit && !(value - allowed <= *limit)) return StageVerdict::abort;
  const PassInterval interval = interval_of(quantity, stage, rms_allowance, effects);
  return value + allowed >= interval.lower && value - allowed <= interval.upper
             ? StageVerdict::passes
             : StageVerdict::outside;
}

}  // namespace

std::string_view to_string(StageQuantity quantity) {
  static constexpr std::array names{"rise time 10 to 90 %",
                                    "overshoot",
                                    "settling time into 5 %",
                                    "valve command, still air",
                                    "tachometer, still air",
                                    "encoder error, still air",
                                    "largest encoder error of the move",
                                    "steady valve command over motor rate",
                                    "steady valve flow over motor rate",
                                    "oil stiffness"};
  return names.at(static_cast<std::size_t>(quantity));
}

bool is_rms(StageQuantity quantity) {
  return quantity == StageQuantity::calm_valve || quantity == StageQuantity::calm_tachometer ||
         quantity == StageQuantity::calm_encoder;
}

std::string_view to_string(StageVerdict verdict) {
  static constexpr std::array names{"passes", "outside", "abort"};
  return names.at(static_cast<std::size_t>(verdict));
}

std::vector<StageQuantity> measured_quantities(const CommissioningStage& stage) {
  using enum StageQuantity;
  if (!stage.expected.all_stable()) return {};
  std::vector<StageQuantity> quantities{rise_time, overshoot, settling_time};
  if (stage.controller.feedforward) quantities = {move_error};
  if (stage.controller.feedforward || stage.controller.position_open) {
    quantities.push_back(valve_per_rate);
    if (stage.flow) quantities.push_back(flow_per_rate);
  }
  if (stage.flow) quantities.push_back(oil_stiffness);
  quantities.push_back(calm_valve);
  quantities.push_back(stage.controller.position_open ? calm_tachometer : calm_encoder);
  std::erase_if(quantities, [&](StageQuantity quantity) {
    return !std::isfinite(expected_of(quantity, stage.expected).upper) ||
           !std::isfinite(effect_on(quantity, stage.effects).upper);
  });
  return quantities;
}

double value_of(StageQuantity quantity, const StageObservation& seen) {
  switch (quantity) {
    case StageQuantity::rise_time:
      return seen.rise_time;
    case StageQuantity::overshoot:
      return seen.overshoot;
    case StageQuantity::settling_time:
      return seen.settling_time;
    case StageQuantity::calm_valve:
      return seen.calm.valve_command;
    case StageQuantity::calm_tachometer:
      return seen.calm.tachometer;
    case StageQuantity::calm_encoder:
      return seen.calm.encoder_error;
    case StageQuantity::move_error:
      return seen.move_error;
    case StageQuantity::oil_stiffness:
      return seen.oil_stiffness;
    case StageQuantity::valve_per_rate:
    case StageQuantity::flow_per_rate:
      break;
  }
  return seen.valve_per_rate;
}

const PlantBand& expected_of(StageQuantity quantity, const StageExpectation& expected) {
  switch (quantity) {
    case StageQuantity::rise_time:
      return expected.rise_time;
    case StageQuantity::overshoot:
      return expected.overshoot;
    case StageQuantity::settling_time:
      return expected.settling_time;
    case StageQuantity::calm_valve:
      return expected.calm_valve;
    case StageQuantity::calm_tachometer:
      return expected.calm_tachometer;
    case StageQuantity::calm_encoder:
      return expected.calm_encoder;
    case StageQuantity::move_error:
      return expected.move_error;
    case StageQuantity::oil_stiffness:
      return expected.oil_stiffness;
    case StageQuantity::valve_per_rate:
    case StageQuantity::flow_per_rate:
      break;
  }
  return expected.valve_per_rate;
}

double with_effect(StageQuantity quantity, double linear, const CommissioningStage& stage) {
  return combined_with(quantity, linear, effect_on(quantity, stage.effects).nominal);
}

double expected_value(StageQuantity quantity, const CommissioningStage& stage) {
  return with_effect(quantity, expected_of(quantity, stage.expected).nominal, stage);
}

std::optional<double> abort_limit(StageQuantity quantity, const CommissioningStage& stage) {
  return limit_of(quantity, stage, stage.effects);
}

PassInterval pass_interval(StageQuantity quantity, const CommissioningStage& stage,
                           double rms_allowance) {
  return interval_of(quantity, stage, rms_allowance, stage.effects);
}

StageVerdict verdict_on(StageQuantity quantity, double value, double uncertainty,
                        const CommissioningStage& stage, double rms_allowance) {
  return verdict_by(quantity, value, uncertainty, stage, rms_allowance, stage.effects);
}

StageEvaluation evaluated(const StageObservation& seen, const CommissioningStage& stage,
                          double rms_allowance) {
  if (!seen.stable) return {StageVerdict::abort, false, std::nullopt, {}};
  StageEvaluation evaluation;
  for (const StageQuantity quantity : measured_quantities(stage)) {
    const StageVerdict verdict =
        verdict_by(quantity, value_of(quantity, seen), 0.0, stage, rms_allowance, {});
    if (verdict != StageVerdict::passes) evaluation.outside.push_back(quantity);
    if (verdict > evaluation.verdict) {
      evaluation.verdict = verdict;
      evaluation.worst = quantity;
    }
  }
  return evaluation;
}

}  // namespace boresight::design
