#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/control/controllers/sample_time.hpp>

namespace boresight::app {
namespace {

// "the upper bound of the compliance, cs = 0.1 rad/(N.m)": the one that the gain is nearer to.
std::string bound_text(const design::ReachedBound& bound) {
  const control::GainDescription& gain = bound.gain;
  return fmt::format("the {} bound of the {}, {} = {:g}{}", bound.upper ? "upper" : "lower",
                     gain.name, gain.symbol, bound.value(),
                     gain.unit == "1" ? "" : " " + gain.unit);
}

// Empty where the bound's corner, if it is one, lies where a sampled controller acts.
std::string beyond_sampling(const design::ReachedBound& bound) {
  if (!bound.idle) return "";
  std::string text = fmt::format(
      "Sampled every {:g} s, a controller has no effect above {:.0f} rad/s, and such a {} has none",
      bound.sample_time, design::highest_frequency(bound.sample_time),
      control::to_string(*bound.idle));
  std::vector<std::string> ways;
  for (const auto& one : bound.simpler) {
    ways.push_back(fmt::format("{} instead of {}",
                               one.name.empty() ? "a [[loop]] without it" : "structure " + one.name,
                               fmt::join(one.in_place_of, ", ")));
  }
  return text + (ways.empty() ? "." : fmt::format(": omit it ({}).", fmt::join(ways, "; ")));
}

}  // namespace

std::vector<std::string> gains_at_bounds(const std::vector<SearchedController>& controllers) {
  std::vector<std::string> sentences;
  for (const auto& bound : reached_bounds(controllers)) {
    std::string text = fmt::format(
        "The search ended at {}, with {}: widen it with [[tuning.bound]] or in the [[loop]].",
        bound_text(bound), fmt::join(bound.controllers, ", "));
    if (const std::string more = beyond_sampling(bound); !more.empty()) text += " " + more;
    sentences.push_back(std::move(text));
  }
  return sentences;
}

std::vector<std::string> gains_at_bounds(const std::vector<const TunedController*>& controllers,
                                         double sample_time) {
  std::vector<SearchedController> searched;
  for (const TunedController* row : controllers) {
    if (row->tuned_for == TunedFor::present) continue;
    searched.push_back({fmt::format("{} ({}, {:.3g} m/s)", row->structure,
                                    to_string(row->tuned_for), row->wind_speed),
                        &row->design.tuning, sample_time});
  }
  return gains_at_bounds(searched);
}

std::vector<std::string> corners_beyond_sampling(const SearchedController& controller) {
  std::vector<std::string> sentences;
  for (const auto& bound : design::reached_bounds({controller})) {
    if (std::string text = beyond_sampling(bound); !text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences;
}

std::vector<std::string> gain_trades(const std::vector<const TunedController*>& controllers,
                                     const io::GainUnits& units) {
  std::vector<std::string> sentences;
  for (const TunedController* row : controllers) {
    if (!row->trade) continue;
    sentences.push_back(trade_in_words(*row->trade, units,
                                       fmt::format("{} ({}, {:.3g} m/s)", row->structure,
                                                   to_string(row->tuned_for), row->wind_speed),
                                       row->boresight_rms,
                                       row->ensemble ? row->ensemble->members.size() : 0));
  }
  return sentences;
}

std::vector<std::string> about_bounds(const design::TuningStudy& study, const io::GainUnits& units,
                                      const std::vector<const TunedController*>& controllers) {
  auto sentences = gains_at_bounds(controllers, control::sample_time_of(study.problem.delay));
  std::ranges::move(gain_trades(controllers, units), std::back_inserter(sentences));
  return sentences;
}

}  // namespace boresight::app
