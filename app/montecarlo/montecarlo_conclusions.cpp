#include <fmt/format.h>

#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

std::string per_cent(double fraction) {
  const double value = 100.0 * fraction;
  return value > 0.0 && value < 0.01 ? fmt::format("{:.2g} %", value)
                                     : fmt::format("{:.2f} %", value);
}

std::string between(const design::EstimatedNumber& number) {
  return fmt::format("{} ({} to {})", per_cent(number.value), per_cent(number.lower),
                     per_cent(number.upper));
}

}  // namespace

std::string evaluated_by(const design::NonlinearEffect& effect) {
  if (effect.factor == 1.0 && effect.amplitude == 0.0) return "linear";
  if (!std::isfinite(effect.factor)) return "as its simulation was lost";
  std::string text =
      fmt::format("each linear rms times {:.2f} as simulated", effect.for_budgets().factor);
  if (effect.amplitude > 0.0) {
    text += fmt::format(", with a limit cycle of +-{:.2f} mdeg", effect.amplitude / millidegree);
  }
  return text;
}

std::vector<std::string> conclude(const MonteCarloSection& section) {
  std::vector<std::string> sentences;
  const std::string wind = fmt::format("in the {} wind model at {:g} m/s mean speed",
                                       plant::to_string(section.wind_model), section.wind_speed);
  if (section.stable > 0) {
    const auto& q = section.boresight_rms.quantiles;
    sentences.push_back(fmt::format(
        "With {}, {}, the boresight rms over the stable plants has median {:.4f} mdeg "
        "and 95 % quantile {:.4f} mdeg.",
        section.controller.structure.state_space() ? "this controller" : "these fixed gains", wind,
        q[3].number.value / millidegree, q[5].number.value / millidegree));
  }
  const std::uint64_t lost = section.unstable + section.undecided;
  sentences.push_back(
      lost == 0
          ? fmt::format(
                "None of {} plants is unstable: with 95 % confidence fewer than {} of all are.",
                section.plants, per_cent(section.instability.upper))
          : fmt::format("The loop is not stable on {} of {} plants, {}; means exclude them.", lost,
                        section.plants, between(section.instability)));
  for (const auto& [budget, met] : section.budgets) {
    sentences.push_back(fmt::format(
        "The budget '{}' (band {}, {:.4f} mdeg) is met {} by {} of the plants, per axis, {}.",
        budget.name, budget.band, budget.rms / millidegree, wind, between(met),
        evaluated_by(section.effect)));
  }
  sentences.push_back(fmt::format("All constraints are met on {} of the plants.",
                                  between(section.all_constraints_met)));
  if (!section.correlations.empty() && section.stable > 9) {
    const auto& first = section.correlations.front();
    sentences.push_back(fmt::format("The rms depends most on the {} (rank correlation {:+.2f}).",
                                    to_string(first.input), first.with_rms.value));
  }
  if (section.retuned) {
    const auto& retuned = *section.retuned;
    sentences.push_back(
        retuned.fixed_gain_cost.random_samples > 0
            ? fmt::format("Fixed gains cost {:.1f} % of rms at the median and {:.1f} % at the 95 % "
                          "quantile, compared with plant-specific gains.",
                          100.0 * retuned.fixed_gain_cost.quantiles[3].number.value,
                          100.0 * retuned.fixed_gain_cost.quantiles[5].number.value)
            : std::string("No plant is stable with both fixed and plant-specific gains."));
  }
  return sentences;
}

}  // namespace boresight::app
