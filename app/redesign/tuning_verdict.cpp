#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/interpretation_verdicts.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/assumed_demand.hpp>
#include <boresight/app/report/climate_wording.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::app {
namespace {

// Whether the run on the nonlinear antenna says anything of the rms.
bool holds_in_wind(const TimeDomainSection& section) {
  return std::isfinite(section.own().simulated_rms());
}

// What the verdict on a budget rests on.
std::string evaluated_by(const std::optional<TimeDomainSection>& time_domain) {
  if (!time_domain) return ", by the linear plant";
  if (!holds_in_wind(*time_domain)) {
    return fmt::format(
        ", as the controller does not complete the run on the nonlinear antenna in "
        "{:.3g} m/s",
        time_domain->wind_speed);
  }
  const auto own = time_domain->own();
  const double amplitude = own.effect().amplitude;
  return fmt::format(", by simulation ({:.3f} mdeg in {:.3g} m/s{})",
                     own.simulated_rms() / millidegree, time_domain->wind_speed,
                     amplitude > 0.0
                         ? fmt::format(", limit cycle of +-{:.2f} mdeg", amplitude / millidegree)
                         : "");
}

// What the gains of the case do on its plant.
std::string present_text(const TuningSection& section,
                         const TuningSection::PresentController& controller) {
  if (controller.design.tuning.status == design::TuningStatus::unstable) {
    return unstable_present_gains(controller.structure);
  }
  std::string text = fmt::format(
      "{} {:.3f} mdeg rms in {:.3g} m/s{}",
      controller.retuned ? fmt::format("The case states no present gains. {} has",
                                       present_label(controller.structure, controller.retuned))
                         : fmt::format("The present gains of {} have", controller.structure),
      controller.design.boresight_rms / millidegree, section.design_speed,
      controller.design.verification.passed
          ? ""
          : fmt::format(" and violate a constraint ({})", controller.design.verification.failure));
  if (section.design.usable()) {
    text += fmt::format(
        "; the tuned {} changes that by {:+.1f} %", control::to_string(section.structure),
        100.0 * (section.design.boresight_rms / controller.design.boresight_rms - 1.0));
  }
  return text + ".";
}

bool keeps_goals_on_all(const TuningSection& section) {
  return !section.ensemble ||
         section.ensemble->within_constraints == static_cast<int>(section.ensemble->members.size());
}

// The ensemble members on which the controller meets the constraints.
std::string robustness_text(const TuningSection& section) {
  if (!section.ensemble) return "";
  const auto plants = static_cast<int>(section.ensemble->members.size());
  const int within = section.ensemble->within_constraints;
  if (keeps_goals_on_all(section)) {
    return fmt::format("With these gains all {} perturbed plant models meet the constraints.",
                       plants);
  }
  const int unstable = plants - section.ensemble->stable;
  // As the card: what recommend() calls fit on its own ensemble is loaded though some of more
  // samples violate a constraint.
  return fmt::format(
      "With these gains only {} of {} perturbed plant models meet the constraints{}.{}", within,
      plants, unstable > 0 ? fmt::format(" ({} unstable)", unstable) : "",
      section.fitness == design::Fitness::fit ? "" : " Do not install.");
}

// On how many plants the needed budgets are met in the wind they are needed up to; `short_of_all`:
// only those that the case's own plant meets there and some other plant does not.
std::string needs_on_plants(const TuningSection& section, bool short_of_all) {
  if (!section.ensemble) return "";
  const auto plants = static_cast<int>(section.ensemble->members.size());
  std::vector<std::string> needs;
  for (const auto& result : section.budgets) {
    const design::PointingBudget& budget = result.budget;
    if (!budget.wind_speed || !result.plants_met) continue;
    const bool nominal = meets_need(budget, reached_wind_speed(section, result));
    if (short_of_all && (!nominal || *result.plants_met == plants)) continue;
    needs.push_back(fmt::format("{} in {:.3g} m/s{} on {}", budget_text(budget), *budget.wind_speed,
                                dish_and_mast(section.wind_mast, *budget.wind_speed),
                                *result.plants_met));
  }
  if (needs.empty()) return "";
  return fmt::format("Of {} perturbed plant models it meets {}.", plants, fmt::join(needs, ", "));
}

// Where flexure beyond the encoder dominates the error.
std::string unseen_text(const TuningSection& section) {
  if (!(section.flexure_rms >= 0.9 * section.design.boresight_rms)) return "";
  return "Nearly all of the error is structural flexure beyond the encoder: stiffer loops, other "
         "motors or flywheels hardly lower it. A stiffer structure, less wind, or compensation of "
         "the flexure (structures with +C, LQG) does, if friction allows.";
}

// Gains that only the bounds of the search hold.
std::string bound_text(const TuningSection& section) {
  const auto& names = section.design.tuning.gains_at_bound;
  if (names.empty()) return "";
  std::string text = fmt::format(
      "Gains at their search limit: {}. Widen it with [[tuning.bound]] or in a [[loop]].",
      fmt::join(names, ", "));
  const SearchedController controller{section.structure.name(), &section.design.tuning,
                                      control::sample_time_of(section.problem.delay)};
  for (const auto& sentence : corners_beyond_sampling(controller)) text += " " + sentence;
  if (section.trade) {
    text += " " + trade_in_words(*section.trade, section.gain_units, controller.name,
                                 section.design.boresight_rms, 0);
  }
  return text;
}

// Of the wind models, those that meet a budget up to where it is needed, or those that do not.
std::vector<std::string_view> models(const TuningSection& section, std::size_t budget, bool met) {
  std::vector<std::string_view> names;
  for (const auto& one : section.wind_alternatives) {
    if (budget >= one.speed_limits.size()) continue;
    const double reached = std::min(one.speed_limits[budget], section.torque_limited_wind_speed);
    if (meets_need(section.budgets[budget].budget, reached) == met) {
      names.push_back(plant::to_string(one.model));
    }
  }
  return names;
}

// Where another wind model than the case's would give another answer.
std::string wind_model_text(const TuningSection& section) {
  std::string verdicts;
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const auto meeting = models(section, i, true), missing = models(section, i, false);
    if (meeting.empty() || missing.empty()) continue;
    verdicts += fmt::format("; {} is met up to its required wind speed with {}, but not with {}",
                            budget_text(section.budgets[i].budget), fmt::join(meeting, ", "),
                            fmt::join(missing, ", "));
  }
  const double own = section.design.boresight_rms;
  std::string others;
  bool apart = false;
  for (const auto& one : section.wind_alternatives) {
    if (one.model == section.wind_model) continue;
    apart = apart || std::abs(one.boresight_rms / own - 1.0) > telling_change;
    others += fmt::format("{}{:.3f} mdeg with {}", others.empty() ? "" : " and ",
                          one.boresight_rms / millidegree, plant::to_string(one.model));
  }
  if (verdicts.empty() && !apart) return "";
  return fmt::format(
      "Sensitive to the wind model: the same gains have {:.3f} mdeg with the case's, {}, but {}{}.",
      own / millidegree, plant::to_string(section.wind_model), others, verdicts);
}

// Where the static error exceeds the tightest budget.
std::string static_error_text(const TuningSection& section) {
  const auto smallest = std::ranges::min_element(
      section.budgets, {}, [](const BudgetResult& one) { return one.budget.rms; });
  if (smallest == section.budgets.end()) return "";
  if (!(section.static_error > smallest->budget.rms)) return "";
  return fmt::format(
      "The static boresight error in the mean wind of {:.3g} m/s, {:.3f} mdeg, exceeds the whole "
      "budget of {}; it is not in the rms, and the pointing model must remove it.",
      section.design_speed, section.static_error / millidegree, budget_text(smallest->budget));
}

}  // namespace

std::string met_text(const TuningSection& section, const BudgetResult& budget) {
  const double reached = reached_wind_speed(section, budget);
  if (!(reached > 0.0)) return "is met in no wind";
  const std::string mast = dish_and_mast(section.wind_mast, reached);
  const std::string fraction = climate_text(section.climate, reached);
  if (!std::isfinite(reached)) return "is met up to the 60 m/s studied" + fraction;
  if (reached < budget.wind_speed_limit) {
    return fmt::format(
        "would be met up to the {:.1f} m/s{} at which the mean wind takes all supply torque that "
        "friction and offset leave{}",
        reached, mast, fraction);
  }
  return fmt::format("is met up to {:.1f} m/s{}{}", reached, mast, fraction);
}

std::vector<std::string> unmet_needs(const TuningSection& section,
                                     const std::optional<TimeDomainSection>& time_domain) {
  std::vector<std::string> sentences;
  if (!section.design.usable()) return sentences;
  for (const auto& result : section.budgets) {
    const design::PointingBudget& budget = result.budget;
    if (!budget.wind_speed || meets_need(budget, reached_wind_speed(section, result))) continue;
    sentences.push_back(fmt::format(
        "NOT MET: {} is required up to {:.3g} m/s{}; as built, with {} ({}), it {}{}.{}",
        budget_text(budget), *budget.wind_speed,
        dish_and_mast(section.wind_mast, *budget.wind_speed), control::to_string(section.structure),
        to_string(section.tuned_for), met_text(section, result), evaluated_by(time_domain),
        meets_need(budget, section.torque_limited_wind_speed)
            ? ""
            : " No loop structure changes that: the drive lacks torque."));
  }
  return sentences;
}

std::string not_examined(const Report& report) {
  if (report.time_domain || !report.tuning || !report.tuning->design.usable()) return "";
  return "Friction, limit cycles and slewing were not examined: the case has no [simulation], and "
         "every rms is of linear loops.";
}

void conclude_tuning(const Report& report, const TuningSection& section,
                     std::vector<std::string>& sentences) {
  const auto add = [&](std::string text) {
    if (!text.empty()) sentences.push_back(std::move(text));
  };
  for (const auto& controller : section.present) add(present_text(section, controller));
  const auto& design = section.design;
  if (design.tuning.status == design::TuningStatus::unstable) {
    add(fmt::format("No {} controller found stabilises this antenna.",
                    control::to_string(section.structure)));
    return;
  }
  if (design.tuning.status != design::TuningStatus::optimal) {
    add(fmt::format(
        "No {} controller meets the constraints; the nearest exceeds a limit by {:.1f} %.{}",
        control::to_string(section.structure), 100.0 * (design.tuning.worst_constraint - 1.0),
        assumed_demand(design.tuning, section.demand_assumption)));
    return;
  }
  if (!design.verification.passed) {
    add(fmt::format("The best {} controller found fails verification ({}): no conclusion.",
                    control::to_string(section.structure), design.verification.failure));
    return;
  }
  const bool repeated = section.seeds.empty() ||
                        2 * section.seeds_within_1_percent > static_cast<int>(section.seeds.size());
  std::string text = fmt::format(
      "As built, the recommended controller, {} ({}){}, has {:.3f} mdeg rms per axis in {:.3g} m/s "
      "of wind, linear",
      control::to_string(section.structure), to_string(section.tuned_for),
      repeated ? "" : " (not repeated by most seeds: search further)",
      design.boresight_rms / millidegree, section.design_speed);
  for (const auto& budget : section.budgets) {
    text += fmt::format("; {} {}", budget_text(budget.budget), met_text(section, budget));
  }
  if (!section.budgets.empty()) text += evaluated_by(report.time_domain);
  add(text + ".");
  if (!section.ties.empty()) {
    add(fmt::format("A tie with it, within {:.0f} % or what the same winds leave open: {}.",
                    100.0 * negligible_change, fmt::join(section.ties, "; ")));
  }
  for (auto& need : unmet_needs(section, report.time_domain)) add(std::move(need));
  add(robustness_text(section));
  add(needs_on_plants(section, false));
  add(bound_text(section));

  const auto by_rms = [](const TuningSection::WindAlternative& x,
                         const TuningSection::WindAlternative& y) {
    return x.boresight_rms < y.boresight_rms;
  };
  const auto [minimum, maximum] = std::minmax_element(section.wind_alternatives.begin(),
                                                      section.wind_alternatives.end(), by_rms);
  add(fmt::format(
      "The rms uses the wind model {}: the same gains give {:.3f} mdeg with {} and {:.3f} with {}. "
      "Structural flexure beyond the encoder alone contributes {:.3f} mdeg.",
      plant::to_string(section.wind_model), minimum->boresight_rms / millidegree,
      plant::to_string(minimum->model), maximum->boresight_rms / millidegree,
      plant::to_string(maximum->model), section.flexure_rms / millidegree));
  add(other_interpretations_text(report, section));
  add(other_attitudes_text(report, section));
  add(guessed_fractions_text(report, section));
  add(unseen_text(section));
  add(static_error_text(section));
  add(not_examined(report));
}

std::vector<std::string> decide_tuning(const Report& report, const TuningSection& section) {
  std::vector<std::string> sentences = unmet_needs(section, report.time_domain);
  const bool met = sentences.empty();
  for (const auto& controller : section.present) {
    if (controller.design.tuning.status == design::TuningStatus::unstable) {
      sentences.push_back(unstable_present_gains(controller.structure));
    }
  }
  const std::string structure =
      fmt::format("{} ({})", control::to_string(section.structure), to_string(section.tuned_for));
  if (section.design.tuning.status != design::TuningStatus::optimal) {
    sentences.push_back(
        fmt::format("No tuned controller meets the constraints of this case.{}",
                    assumed_demand(section.design.tuning, section.demand_assumption)));
    return sentences;
  }
  if (!section.design.verification.passed) {
    sentences.push_back(fmt::format(
        "The best controller found, {}, fails verification: do not use it.", structure));
    return sentences;
  }
  const bool limit_cycle_free =
      !report.time_domain || limit_cycle_remark(*report.time_domain).empty();
  const bool holds = !report.time_domain || holds_in_wind(*report.time_domain);
  const bool robust = keeps_goals_on_all(section);
  std::string text =
      fmt::format("{} {}: {:.3f} mdeg rms per axis in {:.3g} m/s of wind",
                  met && robust && holds && limit_cycle_free && sentences.empty()
                      ? "Run the drive as built on"
                      : "The best controller found for the drive as built is",
                  structure, section.design.boresight_rms / millidegree, section.design_speed);
  if (report.time_domain) {
    text += holds ? fmt::format(" on the linear plant ({:.3f} simulated{})",
                                report.time_domain->own().simulated_rms() / millidegree,
                                report.time_domain->rms ? "" : " in one record")
                  : " (the run on the nonlinear antenna did not complete)";
  }
  if (!section.budgets.empty() && met) {
    const auto& budget = section.budgets.front();
    text += fmt::format("; {} {}{}", budget_text(budget.budget), met_text(section, budget),
                        evaluated_by(report.time_domain));
  }
  sentences.push_back(text + ".");
  return sentences;
}

std::vector<std::string> tuning_reservations(const Report& report, const TuningSection& section) {
  if (!section.design.usable()) return {};
  std::vector<std::string> sentences;
  if (!keeps_goals_on_all(section)) sentences.push_back(robustness_text(section));
  sentences.push_back(needs_on_plants(section, true));
  if (report.time_domain) sentences.push_back(limit_cycle_remark(*report.time_domain));
  sentences.push_back(bound_text(section));
  sentences.push_back(other_interpretations_text(report, section));
  sentences.push_back(other_attitudes_text(report, section));
  sentences.push_back(guessed_fractions_text(report, section));
  sentences.push_back(wind_model_text(section));
  sentences.push_back(static_error_text(section));
  sentences.push_back(unseen_text(section));
  if (report.time_domain) {
    sentences.push_back(slew_not_achievable(*report.time_domain));
    sentences.push_back(assumed_stroke(*report.time_domain));
    sentences.push_back(report.time_domain->friction_doubt);
  }
  sentences.push_back(not_examined(report));
  if (report.matching) {
    sentences.emplace_back(
        "Motor inertias are compared with linear loops tuned for the nominal plant only: "
        "`boresight evaluate` compares them with robust controllers on the nonlinear antenna.");
  }
  sentences.push_back(measure_first(section.input_effects, section.design.boresight_rms,
                                    report.time_domain,
                                    is_superseded(report.superseded, "friction_curve.")));
  std::erase(sentences, std::string());
  return sentences;
}

}  // namespace boresight::app
