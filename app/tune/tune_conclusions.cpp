#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/assumed_demand.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/controllers_in_time.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {
namespace {

std::string mdeg(double angle) {
  return fmt::format("{:.4f} mdeg", angle / millidegree);
}

const TunedController* find(const TuneSection& section, const TunedController& like,
                            TunedFor purpose) {
  for (const auto& row : section.controllers) {
    if (row.structure == like.structure && row.wind_speed == like.wind_speed &&
        row.tuned_for == purpose) {
      return &row;
    }
  }
  return nullptr;
}

// Nothing of a state space, whose refinement knows no shadow prices.
std::string limits_text(const TunedController& row) {
  if (row.is_state_space()) return "";
  std::vector<std::string> texts;
  for (const auto& limit : row.design.tuning.limits) texts.push_back(limit.description());
  if (texts.empty()) texts = row.design.tuning.active_constraints;
  return fmt::format(" Active constraints: {}.",
                     texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, "; ")));
}

// Behind an rms of the linear plant what the nonlinear antenna says to it; nothing where no
// controller ran there.
std::string of_the_linear_plant(const TuneSection& section, const TunedController& row) {
  const bool some_ran = std::ranges::any_of(
      section.controllers, [](const TunedController& other) { return other.in_time.has_value(); });
  if (!some_ran) return "";
  if (!row.in_time) return " on the linear plant; not run on the nonlinear antenna";
  if (row.left_out()) {
    return fmt::format(" on the linear plant, but it {} on the nonlinear antenna",
                       evaluated_against(row));
  }
  return fmt::format(" on the linear plant, {} on the nonlinear antenna", mdeg(row.in_time->rms()));
}

// The best usable controller of each purpose and, if it is another, the one recommended; and what
// only the bounds of the search hold of them.
void conclude_best(const TuneSection& section, std::vector<std::string>& sentences) {
  std::vector<const TunedController*> concluded;
  const auto say = [&](const TunedController& row, const std::string& subject) {
    sentences.push_back(fmt::format("At {:.3g} m/s {} with {} rms{}.{}{}", row.wind_speed, subject,
                                    mdeg(row.boresight_rms), of_the_linear_plant(section, row),
                                    limits_text(row),
                                    assumed_demand(row.design.tuning, section.demand_assumption)));
    concluded.push_back(&row);
  };
  for (const double speed : section.wind_speeds) {
    for (const auto purpose : {TunedFor::nominal, TunedFor::robust}) {
      const TunedController* best = nullptr;
      for (const auto& row : section.controllers) {
        if (row.tuned_for != purpose || row.wind_speed != speed || !row.usable()) continue;
        if (best == nullptr || row.boresight_rms < best->boresight_rms) best = &row;
      }
      if (best == nullptr) continue;
      say(*best,
          fmt::format("the best {} is {}",
                      purpose == TunedFor::robust ? "robust controller" : "nominal controller",
                      best->structure));
    }
    const TunedController* recommended = recommended_tuned_controller(section, speed);
    if (recommended == nullptr) continue;
    if (std::ranges::find(concluded, recommended) != concluded.end()) continue;
    say(*recommended,
        fmt::format("the recommended controller is {}", name_and_purpose(*recommended)));
  }
  std::ranges::move(about_bounds(section, section.gain_units, concluded),
                    std::back_inserter(sentences));
}

void conclude_before_and_after(const TuneSection& section, std::vector<std::string>& sentences) {
  for (const auto& row : section.controllers) {
    if (row.tuned_for != TunedFor::present) continue;
    const TunedController* after = find(section, row, TunedFor::nominal);
    if (!row.stable()) {
      // The wind moves no pole: once is enough.
      if (row.wind_speed == section.wind_speeds.front()) {
        sentences.push_back(unstable_present_gains(row.structure));
      }
      continue;
    }
    std::string text = fmt::format(
        "The present gains of {} have {} rms in {:.3g} m/s{}", row.structure,
        mdeg(row.boresight_rms), row.wind_speed,
        row.constraints_met
            ? ""
            : fmt::format(" and violate a constraint ({})", row.design.verification.failure));
    if (after != nullptr && after->usable()) {
      text +=
          fmt::format("; tuned, {} has {} ({:+.1f} %)", row.structure, mdeg(after->boresight_rms),
                      100.0 * (after->boresight_rms / row.boresight_rms - 1.0));
    }
    sentences.push_back(text + ".");
  }
}

// Ensemble members on which a controller meets an rms, with what its simulation adds; 0 without an
// ensemble.
std::ptrdiff_t plants_kept(const TunedController& controller, double rms) {
  if (!controller.ensemble) return 0;
  const auto effect = controller.effect().for_budgets();
  return std::ranges::count_if(controller.ensemble->members, [&](const auto& one) {
    return one.stable && design::within_budget(effect.rms(one.boresight_rms), rms);
  });
}

// What a controller has of a budget's rms.
std::string figures_of(const TunedController& controller) {
  std::string text = fmt::format("{} has {} on the case's plant", name_and_purpose(controller),
                                 mdeg(controller.boresight_rms));
  if (controller.in_time) {
    text += fmt::format(", {} on the nonlinear antenna", mdeg(controller.in_time->rms()));
  }
  if (controller.left_out()) text += fmt::format(", where it {}", evaluated_against(controller));
  return text;
}

std::string plants_text(const TunedController& controller, double rms) {
  if (!controller.ensemble) return "";
  return fmt::format(", and meets it on {} of {} plants", plants_kept(controller, rms),
                     controller.ensemble->members.size());
}

// The controller tuned like the recommended one that meets a budget on more plants than that one.
std::string alternative_text(const TuneSection& section, const design::PointingBudget& budget,
                             const TunedController& recommended) {
  if (!recommended.ensemble) return "";
  const TunedController* maximum = nullptr;
  std::ptrdiff_t plants = plants_kept(recommended, budget.rms);
  for (const auto& row : section.controllers) {
    if (row.tuned_for != recommended.tuned_for || row.wind_speed != recommended.wind_speed) {
      continue;
    }
    if (!row.usable() || row.left_out() || !row.keeps(budget.rms)) continue;
    if (plants_kept(row, budget.rms) <= plants) continue;
    plants = plants_kept(row, budget.rms);
    maximum = &row;
  }
  if (maximum == nullptr) return "";
  return fmt::format("; {} meets it on {}, but {}", name_and_purpose(*maximum), plants,
                     why_not_recommended(section, *maximum, recommended));
}

// Where a state space was asked for and none was found.
void conclude_state_space(const TuneSection& section, std::vector<std::string>& sentences) {
  const bool asked =
      std::ranges::find(section.structures, design::state_space_name) != section.structures.end();
  if (!asked || !section.not_run.empty() || best_controller(section) == nullptr ||
      std::ranges::any_of(section.controllers, &TunedController::is_state_space)) {
    return;
  }
  sentences.emplace_back(
      "No state-space controller (SS) was found that meets every constraint on every plant.");
}

// The budgets that are needed up to a wind speed, and are met there: by the controller recommended
// or, where that does not, by another.
void conclude_budgets(const TuneSection& section, std::vector<std::string>& sentences) {
  for (const auto& budget : section.budgets) {
    if (!budget.wind_speed || section.torque_limited_wind_speed < *budget.wind_speed) continue;
    const TunedController* nearest = nearest_to_budget(section, budget.wind_speed);
    if (nearest == nullptr || !nearest->keeps(budget.rms)) continue;
    std::string text =
        fmt::format("The budget '{}' in band {} ({}) is met up to the required {:.3g} m/s{}",
                    budget.name, budget.band, mdeg(budget.rms), *budget.wind_speed,
                    dish_and_mast(section.wind_mast, *budget.wind_speed));
    const TunedController* recommended = recommended_tuned_controller(section, budget.wind_speed);
    if (recommended == nullptr) {
      text += ": " + figures_of(*nearest) + plants_text(*nearest, budget.rms);
    } else if (recommended->keeps(budget.rms)) {
      text += ": " + figures_of(*recommended) + plants_text(*recommended, budget.rms) +
              alternative_text(section, budget, *recommended);
    } else {
      text += fmt::format(", but not by the recommended controller: {}; {}{}, but {}",
                          figures_of(*recommended), figures_of(*nearest),
                          plants_text(*nearest, budget.rms),
                          why_not_recommended(section, *nearest, *recommended));
    }
    sentences.push_back(text + ".");
  }
}

// Controllers that are good for the nominal plant only, and what it costs to be good for all.
void conclude_robustness(const TuneSection& section, std::vector<std::string>& sentences) {
  for (const auto& row : section.controllers) {
    if (row.tuned_for != TunedFor::nominal || !row.usable() || !row.ensemble) continue;
    const auto& ensemble = *row.ensemble;
    const auto all = static_cast<int>(ensemble.members.size());
    if (ensemble.within_constraints == all) continue;
    const auto& worst = ensemble.members[ensemble.worst];
    std::string text = fmt::format(
        "Tuned for the nominal plant, {} at {:.3g} m/s meets the constraints on {} of {} plants; "
        "the worst, {}, {}",
        row.structure, row.wind_speed, ensemble.within_constraints, all, worst.name,
        worst.stable
            ? fmt::format("exceeds a limit by {:.0f} %", 100.0 * (worst.worst_constraint - 1.0))
            : "is unstable");
    const TunedController* robust = find(section, row, TunedFor::robust);
    if (robust != nullptr && robust->usable()) {
      text += fmt::format(". Meeting them on every plant costs {:+.1f} % of rms ({})",
                          100.0 * (robust->boresight_rms / row.boresight_rms - 1.0),
                          mdeg(robust->boresight_rms));
    } else if (robust != nullptr && robust->stable()) {
      text += fmt::format(
          ". No {} controller found meets them on every plant; the nearest exceeds a limit by "
          "{:.1f} %",
          row.structure, 100.0 * (robust->design.tuning.worst_constraint - 1.0));
    }
    sentences.push_back(text + ".");
  }
}

}  // namespace

std::vector<std::string> conclude(const TuneSection& section) {
  std::vector<std::string> sentences;
  if (section.wind_mast) sentences.push_back(conclude_mast(*section.wind_mast));
  for (const auto& shortfall : section.shortfalls) {
    sentences.push_back("INFEASIBLE: " + shortfall.infeasible + " " + shortfall.closest);
  }
  conclude_before_and_after(section, sentences);
  if (section.unverified) {
    sentences.emplace_back(
        "No controller that meets the constraints passes verification: no conclusion.");
    return sentences;
  }
  conclude_best(section, sentences);
  conclude_state_space(section, sentences);
  conclude_budgets(section, sentences);
  conclude_robustness(section, sentences);
  return sentences;
}

}  // namespace boresight::app
