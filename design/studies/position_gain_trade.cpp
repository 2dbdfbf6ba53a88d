#include <algorithm>
#include <cmath>

#include <boresight/design/studies/position_gain_trade.hpp>

namespace boresight::design {
namespace {

// Places in a controller's gains.
struct TradedGains {
  std::size_t rate = 0, position = 0;
};

std::optional<std::size_t> place_of(const control::LoopStructure& structure,
                                    std::string_view symbol) {
  const auto& descriptions = structure.gains();
  const auto found = std::ranges::find(descriptions, symbol, &control::GainDescription::symbol);
  if (found == descriptions.end()) return std::nullopt;
  return static_cast<std::size_t>(found - descriptions.begin());
}

// None where the search did not end at the upper bound of the position gain.
std::optional<TradedGains> traded_gains(const TuningResult& tuning) {
  const auto rate = place_of(tuning.controller.structure, "kr");
  const auto position = place_of(tuning.controller.structure, "kp");
  if (!rate || !position || *position >= tuning.controller.gains.size()) return std::nullopt;
  const control::GainDescription& gain = tuning.controller.structure.gains()[*position];
  const bool at_bound =
      std::ranges::find(tuning.gains_at_bound, gain.name) != tuning.gains_at_bound.end();
  if (!at_bound || !ends_at_upper(gain, tuning.controller.gains[*position])) return std::nullopt;
  return TradedGains{*rate, *position};
}

}  // namespace

bool ends_at_upper(const control::GainDescription& gain, double value) {
  return value > std::sqrt(gain.lower * gain.upper);
}

bool ends_at_position_gain(const TuningResult& tuning) {
  return traded_gains(tuning).has_value();
}

std::optional<PositionGainTrade> position_gain_trade(TrackingProblem problem,
                                                     const TuningResult& tuning,
                                                     double boresight_rms, const Constraints& goals,
                                                     const std::vector<EnsembleMember>& members) {
  const auto traded = traded_gains(tuning);
  if (!traded) return std::nullopt;
  problem.climate.clear();
  const auto lowered = [&](double factor) {
    control::Controller controller = tuning.controller;
    controller.gains.at(traded->position) /= factor;
    controller.gains.at(traded->rate) *= factor;
    return controller;
  };
  const auto rms = [&](double factor) {
    return evaluate(problem, {{"nominal", problem.plant}}, lowered(factor), goals, 1)
        .members.front()
        .boresight_rms;
  };
  constexpr double alike = 1.01, worth_saying = 2.0;
  double held = 1.0, beyond = 100.0;
  while (beyond > 1.02 * held) {
    const double middle = std::sqrt(held * beyond);
    (rms(middle) <= alike * boresight_rms ? held : beyond) = middle;
  }
  if (held < worth_saying) return std::nullopt;
  PositionGainTrade trade{lowered(held), traded->position, traded->rate, rms(held), 0};
  if (!members.empty()) {
    trade.within_constraints =
        evaluate(problem, members, trade.controller, goals, 1).within_constraints;
  }
  return trade;
}

}  // namespace boresight::design
