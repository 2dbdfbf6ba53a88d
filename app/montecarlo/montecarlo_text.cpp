#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/loss_wording.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using design::DistributionSummary;
using design::EstimatedNumber;

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string with_interval(const EstimatedNumber& estimate, double unit, int decimals) {
  return fmt::format("{} [{}, {}]", fixed(estimate.value / unit, decimals),
                     fixed(estimate.lower / unit, decimals),
                     fixed(estimate.upper / unit, decimals));
}

std::string per_cent(const EstimatedNumber& estimate) {
  return fmt::format("{:.3f} % [{:.3f}, {:.3f}]", 100.0 * estimate.value, 100.0 * estimate.lower,
                     100.0 * estimate.upper);
}

// Of the quantiles, those that have a column.
bool is_shown(double fraction) {
  return fraction >= 0.05 && fraction != 0.25 && fraction != 0.75;
}

void add_distribution(Rows& rows, const std::string& name, const DistributionSummary& summary,
                      double unit, int decimals) {
  std::vector<std::string> row{name, with_interval(summary.mean, unit, decimals),
                               fixed(summary.standard_deviation.value / unit, decimals)};
  for (const auto& [fraction, value] : summary.quantiles) {
    if (is_shown(fraction)) row.push_back(with_interval(value, unit, decimals));
  }
  row.push_back(fixed(summary.largest / unit, decimals));
  rows.push_back(std::move(row));
}

// "0.7424 [0.7401, 0.7449]", or "> 3".
std::string loss_with_interval(const EstimatedNumber& estimate) {
  std::string value = loss_text(estimate.value);
  if (estimate.value > largest_parabola_loss) return value;
  return fmt::format("{} [{}, {}]", value, loss_text(estimate.lower), loss_text(estimate.upper));
}

// In dB. A spread that losses beyond the beam's parabola make up is none.
void add_losses(Rows& rows, const std::string& name, const DistributionSummary& summary) {
  const bool holds = summary.largest <= largest_parabola_loss;
  std::vector<std::string> row{name, loss_with_interval(summary.mean),
                               holds ? fixed(summary.standard_deviation.value, 4) : "-"};
  for (const auto& [fraction, value] : summary.quantiles) {
    if (is_shown(fraction)) row.push_back(loss_with_interval(value));
  }
  row.push_back(loss_text(summary.largest));
  rows.push_back(std::move(row));
}

bool has_losses_beyond(const MonteCarloSection& section) {
  return std::ranges::any_of(section.losses, [](const auto& band) {
    return std::max(band.loss.largest, band.climate_loss ? band.climate_loss->largest : 0.0) >
           largest_parabola_loss;
  });
}

Document distributions_part(const MonteCarloSection& section) {
  Rows rows{{"", "mean", "sd", "5 %", "50 %", "95 %", "99 %", "largest"}};
  add_distribution(rows, "boresight rms, mdeg", section.boresight_rms, millidegree, 4);
  for (const auto& [band, loss, climate_loss] : section.losses) {
    add_losses(rows, fmt::format("loss {}, dB", band.name), loss);
  }
  if (section.climate_rms) {
    add_distribution(rows, "climate rms, mdeg", *section.climate_rms, millidegree, 4);
    for (const auto& [band, loss, climate_loss] : section.losses) {
      if (climate_loss) {
        add_losses(rows, fmt::format("climate loss {}, dB", band.name), *climate_loss);
      }
    }
  }
  if (section.retuned) {
    add_distribution(rows, "rms re-tuned, mdeg", section.retuned->boresight_rms, millidegree, 4);
    add_distribution(rows, "cost of fixed gains, %", section.retuned->fixed_gain_cost, 0.01, 2);
  }
  Document text = heading("Distribution over the stable plants");
  text += essential(table(rows, "l"));
  text += wrapped(
      fmt::format("[ ]: 95 % sampling intervals, {} stable plants. Losses: mean of two equal axes "
                  "of a Gaussian beam. Per axis, linear, wind model {}, mean speed {:g} m/s{}.",
                  section.stable, plant::to_string(section.wind_model), section.wind_speed,
                  section.climate ? "; climate: the mean square over the site's wind climate" : ""),
      "  ");
  if (has_losses_beyond(section)) text += wrapped(beyond_the_parabola(), "  ");
  if (section.retuned) {
    text +=
        wrapped(fmt::format("Re-tuned: plant-specific gains of the same structure, found for {} of "
                            "{} plants; {} of these are unstable with the fixed gains. Cost: rms "
                            "with fixed gains / rms with plant-specific gains - 1.",
                            section.retuned->found, section.plants, section.retuned->only_retuned),
                "  ");
  }
  return text;
}

Document probabilities_part(const MonteCarloSection& section) {
  Rows rows{{"", "probability"}};
  rows.push_back({"not stable", per_cent(section.instability)});
  for (const auto& [budget, met] : section.budgets) {
    rows.push_back({fmt::format("budget met: {} ({}, {:.4f} mdeg)", budget.name, budget.band,
                                budget.rms / millidegree),
                    per_cent(met)});
  }
  for (const auto& [goal, broken] : section.constraints_violated) {
    rows.push_back({fmt::format("constraint violated: {}", goal), per_cent(broken)});
  }
  rows.push_back({"all constraints met", per_cent(section.all_constraints_met)});
  Document text = heading("Probabilities");
  text += essential(table(rows, "l"));
  text += wrapped(
      fmt::format("{} plants, 95 % Clopper-Pearson intervals. A plant that is not stable meets no "
                  "budget. Budgets: {}. Violations: stable plants beyond 1.0001 times the limit.",
                  section.plants, evaluated_by(section.effect)),
      "  ");
  return text;
}

Document stability_part(const MonteCarloSection& section) {
  Document text = heading("Stability");
  text += wrapped(
      fmt::format("{} plants stable, {} unstable, {} undecided. Eigenvalues were computed for the "
                  "{} plants with Ms above {:g}, unstable by the Nyquist criterion, or with an "
                  "index divisible by {}. They contradicted the Nyquist criterion {} times.",
                  section.stable, section.unstable, section.undecided, section.confirmed,
                  section.confirm_peak, section.confirm_every, section.contradicted),
      "  ");
  return text;
}

Document plants_part(const MonteCarloSection& section, const std::vector<NotablePlant>& plants,
                     std::size_t maximum) {
  Rows rows{{"plant"}};
  for (const auto input : section.inputs) rows[0].emplace_back(to_string(input));
  for (const auto* name : {"rms mdeg", "Ms rate", "Ms valve", "Ms pos.", "effort rad/s"}) {
    rows[0].emplace_back(name);
  }
  for (const auto& plant : plants) {
    if (rows.size() > maximum) break;
    std::vector<std::string> row{fmt::format("{}", plant.index)};
    for (const auto input : section.inputs) row.push_back(fmt::format("{:.4f}", plant.draw[input]));
    row.push_back(fixed(plant.outcome.boresight_rms / millidegree, 4));
    for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
      const bool cut = control::has_break(section.controller, control::loop_breaks.at(b));
      row.push_back(cut ? fixed(plant.outcome.sensitivity_peaks.at(b), 3) : "-");
    }
    row.push_back(fixed(plant.outcome.control_effort, 3));
    rows.push_back(std::move(row));
  }
  return table(rows, "r");
}

}  // namespace

Document document_of(const MonteCarloSection& section) {
  Document text =
      report_title("montecarlo", section.title, words_beside(section.title, section.axis),
                   section.case_path, section.seed);
  if (section.interrupted) {
    text += fmt::format("INTERRUPTED: results cover {} of {} plants.\n", section.plants,
                        section.plants_asked);
  }
  text += lead(decision(section));
  text += heading("Controller and plants");
  Document controller =
      wrapped(fmt::format("{}: {}.", section.structure, section.controller_source), "  ");
  if (section.gains.empty()) {
    text += essential(std::move(controller));
  } else {
    Rows gains{{"gain", "value"}};
    for (std::size_t i = 0; i < section.gains.size(); ++i) {
      gains.push_back({section.controller.structure.gains()[i].name, section.gains[i]});
    }
    text += std::move(controller) + essential(table(gains, "ll"));
  }
  std::vector<std::string_view> names;
  for (const auto input : section.inputs) names.push_back(to_string(input));
  text += wrapped(fmt::format("{} plants, {}: {}.", section.plants, section.distribution,
                              fmt::join(names, ", ")),
                  "  ");
  text += distributions_part(section);
  text += probabilities_part(section);
  text += stability_part(section);
  if (!section.unstable_plants.empty()) {
    constexpr std::size_t maximum = 10;
    text += heading("Plants that are not stable");
    text += plants_part(section, section.unstable_plants, maximum);
    if (section.unstable + section.undecided > maximum) {
      text +=
          wrapped(fmt::format("The first {} of {}; --json lists {}, --csv all.", maximum,
                              section.unstable + section.undecided, section.unstable_plants.size()),
                  "  ");
    }
  }
  text += heading("Worst stable plants");
  text += plants_part(section, section.worst, section.worst.size());
  text += wrapped(
      "Inputs: factors on the case's values (on identified values, where there are records); "
      "friction slope in N m s/rad at the motor shaft.",
      "  ");
  text += heading("Correlation of inputs with the rms");
  Rows rows{{"input", "rank correlation"}};
  for (const auto& [input, with_rms] : section.correlations) {
    rows.push_back(
        {std::string(to_string(input)), fmt::format("{:+.3f} [{:+.3f}, {:+.3f}]", with_rms.value,
                                                    with_rms.lower, with_rms.upper)});
  }
  text += table(rows, "l");
  text += document_of(section.assumed);
  text += heading("What the numbers mean");
  for (const auto& sentence : section.conclusions) text += wrapped(sentence, "  ") + "\n";
  return text;
}

std::string to_text(const MonteCarloSection& section) {
  return to_text(document_of(section));
}

}  // namespace boresight::app
