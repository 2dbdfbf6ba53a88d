#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>

namespace boresight::app {
namespace {

struct ReachedBound {
  std::string text;
  std::vector<std::string> laws;
};

// "the upper bound of the compliance, cs = 0.1 rad/(N.m)": the one that the gain is nearer to.
std::string bound_text(const control::GainDescription& gain, double value) {
  const bool upper = value > std::sqrt(gain.lower * gain.upper);
  return fmt::format("the {} bound of the {}, {} = {:g}{}", upper ? "upper" : "lower", gain.name,
                     gain.symbol, upper ? gain.upper : gain.lower,
                     gain.unit == "1" ? "" : " " + gain.unit);
}

}  // namespace

std::vector<std::string> gains_at_bounds(const std::vector<SearchedLaw>& laws) {
  std::vector<ReachedBound> reached;
  for (const auto& one : laws) {
    const auto& tuning = *one.tuning;
    if (tuning.status == design::TuningStatus::unstable) continue;
    const auto& descriptions = tuning.law.structure.gains();
    for (std::size_t k = 0; k < descriptions.size(); ++k) {
      const auto& names = tuning.gains_at_bound;
      if (std::ranges::find(names, descriptions[k].name) == names.end()) continue;
      const std::string text = bound_text(descriptions[k], tuning.law.gains.at(k));
      auto found = std::ranges::find(reached, text, &ReachedBound::text);
      if (found == reached.end()) found = reached.insert(found, {text, {}});
      found->laws.push_back(one.name);
    }
  }
  std::vector<std::string> sentences;
  for (const auto& bound : reached) {
    sentences.push_back(fmt::format(
        "The search ended at {}, with {}: no optimum, as what lies beyond was not looked at.",
        bound.text, fmt::join(bound.laws, ", ")));
  }
  return sentences;
}

std::vector<std::string> gains_at_bounds(const std::vector<const TunedLaw*>& laws) {
  std::vector<SearchedLaw> searched;
  for (const TunedLaw* row : laws) {
    if (row->tuned_for == TunedFor::present) continue;
    searched.push_back({fmt::format("{} ({}, {:.3g} m/s)", row->structure,
                                    to_string(row->tuned_for), row->wind_speed),
                        &row->design.tuning});
  }
  return gains_at_bounds(searched);
}

std::vector<std::string> gain_trades(const std::vector<const TunedLaw*>& laws) {
  std::vector<std::string> sentences;
  for (const TunedLaw* row : laws) {
    if (!row->trade) continue;
    const PositionGainTrade& trade = *row->trade;
    const std::string plants =
        row->ensemble ? fmt::format(", with every goal kept on {} of {} plants before tuning again",
                                    trade.within_goals, row->ensemble->members.size())
                      : "";
    sentences.push_back(
        fmt::format("{} ({}, {:.3g} m/s) has kp at its bound because its rate loop hardly acts, so "
                    "that kp x kr "
                    "counts. With the same product kp = {} and kr = {} have {:.4f} mdeg, {:+.1f} "
                    "%{}; what lies "
                    "beyond the bound a [[loop]] with bounds of its own tells.",
                    row->structure, to_string(row->tuned_for), row->wind_speed, trade.position_gain,
                    trade.rate_gain, trade.beam_rms / millidegree,
                    100.0 * (trade.beam_rms / row->beam_rms - 1.0), plants));
  }
  return sentences;
}

}  // namespace boresight::app
