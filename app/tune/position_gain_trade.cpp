#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {
namespace {

// Places in a law's gains.
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
std::optional<TradedGains> traded_gains(const design::TuningResult& tuning) {
  const auto rate = place_of(tuning.law.structure, "kr");
  const auto position = place_of(tuning.law.structure, "kp");
  if (!rate || !position || *position >= tuning.law.gains.size()) return std::nullopt;
  const control::GainDescription& gain = tuning.law.structure.gains()[*position];
  const bool at_bound =
      std::ranges::find(tuning.gains_at_bound, gain.name) != tuning.gains_at_bound.end();
  if (!at_bound || !ends_at_upper(gain, tuning.law.gains[*position])) return std::nullopt;
  return TradedGains{*rate, *position};
}

}  // namespace

bool ends_at_position_gain(const design::TuningResult& tuning) {
  return traded_gains(tuning).has_value();
}

std::optional<PositionGainTrade> position_gain_trade(
    const io::Case& antenna, design::TrackingProblem problem, const design::TuningResult& tuning,
    double beam_rms, const design::HardGoals& goals,
    const std::vector<design::EnsembleMember>& members) {
  const auto traded = traded_gains(tuning);
  if (!traded) return std::nullopt;
  problem.climate.clear();
  const auto lowered = [&](double factor) {
    control::ControlLaw law = tuning.law;
    law.gains.at(traded->position) /= factor;
    law.gains.at(traded->rate) *= factor;
    return law;
  };
  const auto rms = [&](double factor) {
    return design::judge(problem, {{"nominal", problem.plant}}, lowered(factor), goals, 1)
        .members.front()
        .beam_rms;
  };
  constexpr double alike = 1.01, worth_saying = 2.0;
  double held = 1.0, beyond = 100.0;
  while (beyond > 1.02 * held) {
    const double middle = std::sqrt(held * beyond);
    (rms(middle) <= alike * beam_rms ? held : beyond) = middle;
  }
  if (held < worth_saying) return std::nullopt;
  const control::ControlLaw law = lowered(held);
  const auto texts = in_engineers_units(antenna, law);
  PositionGainTrade trade{texts.at(traded->position), texts.at(traded->rate), rms(held), 0};
  if (!members.empty()) {
    trade.within_goals = design::judge(problem, members, law, goals, 1).within_goals;
  }
  return trade;
}

std::string trade_in_words(const PositionGainTrade& trade, std::string_view law, double beam_rms,
                           std::size_t plants) {
  return fmt::format(
      "{} has kp at its bound because its rate loop hardly acts, so that kp x kr counts. With the "
      "same product kp = {} and kr = {} have {:.4f} mdeg, {:+.1f} %{}. A lower upper bound of kp "
      "([[tuning.bound]], or that of a [[loop]]) has the search look for laws whose rate loop "
      "acts.",
      law, trade.position_gain, trade.rate_gain, trade.beam_rms / millidegree,
      100.0 * (trade.beam_rms / beam_rms - 1.0),
      plants > 0 ? fmt::format(", with every goal kept on {} of {} plants before tuning again",
                               trade.within_goals, plants)
                 : "");
}

std::string_view trade_not_looked_for() {
  return "Where the rate loop hardly acts only the product kp x kr counts, and the bound of kp is "
         "no sharp limit: `boresight tune` of that case says whether this is so.";
}

}  // namespace boresight::app
