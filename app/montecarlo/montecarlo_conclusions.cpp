#include <fmt/format.h>

#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

std::string per_cent(double share) {
  const double value = 100.0 * share;
  return value > 0.0 && value < 0.01 ? fmt::format("{:.2g} %", value)
                                     : fmt::format("{:.2f} %", value);
}

std::string between(const design::EstimatedNumber& number) {
  return fmt::format("{} ({} to {})", per_cent(number.value), per_cent(number.lower),
                     per_cent(number.upper));
}

}  // namespace

std::vector<std::string> conclude(const MonteCarloSection& section) {
  std::vector<std::string> sentences;
  const std::string wind = fmt::format("in the {} wind model at {:g} m/s mean speed",
                                       plant::to_string(section.wind_model), section.wind_speed);
  if (section.stable > 0) {
    const auto& q = section.beam_rms.quantiles;
    sentences.push_back(fmt::format(
        "With these gains held, {} beam rms is {:.4f} mdeg in the middle and up to {:.4f} mdeg on "
        "95 "
        "% of the plants that are stable: so far as the plants are what they are drawn from.",
        wind, q[3].number.value / millidegree, q[5].number.value / millidegree));
  }
  const std::uint64_t lost = section.unstable + section.undecided;
  sentences.push_back(
      lost == 0 ? fmt::format("None of {} plants is unstable: fewer than {} of all may be (95 %).",
                              section.plants, per_cent(section.instability.upper))
                : fmt::format(
                      "The loop is not stable on {} of {} plants, {}: they are counted and listed, "
                      "and enter no mean.",
                      lost, section.plants, between(section.instability)));
  for (const auto& [budget, met] : section.budgets) {
    sentences.push_back(
        fmt::format("The budget '{}' (band {}, {:.4f} mdeg) is met {} by {} of the "
                    "plants, one axis, linear.",
                    budget.name, budget.band, budget.rms / millidegree, wind, between(met)));
  }
  sentences.push_back(fmt::format("All hard goals are met by {}.", between(section.all_goals_met)));
  if (!section.correlations.empty() && section.stable > 9) {
    const auto& first = section.correlations.front();
    sentences.push_back(fmt::format(
        "What moves the rms most among the inputs is the {} (rank correlation {:+.2f}): a rank "
        "correlation sees trends, not causes that turn.",
        to_string(first.input), first.with_rms.value));
  }
  if (section.retuned) {
    const auto& retuned = *section.retuned;
    sentences.push_back(
        retuned.price.draws > 0
            ? fmt::format(
                  "Holding one law for all costs {:.1f} % of rms in the middle and {:.1f} % "
                  "on 5 % of the plants, against a law tuned for each plant alone.",
                  100.0 * retuned.price.quantiles[3].number.value,
                  100.0 * retuned.price.quantiles[5].number.value)
            : std::string("No plant is stable under both the held law and one of its own."));
  }
  return sentences;
}

}  // namespace boresight::app
