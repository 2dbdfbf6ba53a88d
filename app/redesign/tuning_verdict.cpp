#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

std::string budget_text(const PointingBudget& budget) {
  return fmt::format("{} ({}: {:.3f} mdeg)", budget.name, budget.band, budget.rms / millidegree);
}

// What the gains of the case do on its plant.
std::string present_text(const TuningSection& section, const TuningSection::PresentLaw& law) {
  if (law.design.tuning.status == design::TuningStatus::unstable) {
    return unstable_present_gains(law.structure);
  }
  std::string text =
      fmt::format("The present gains of {} point within {:.3f} mdeg in {:g} m/s{}", law.structure,
                  law.design.beam_rms / millidegree, section.design_speed,
                  law.design.verification.passed
                      ? ""
                      : fmt::format(" and miss a goal ({})", law.design.verification.failure));
  if (section.design.usable()) {
    text += fmt::format("; the tuned {} changes that by {:+.1f} %",
                        control::to_string(section.structure),
                        100.0 * (section.design.beam_rms / law.design.beam_rms - 1.0));
  }
  return text + ".";
}

// What becomes of the law, tuned on one plant, on others.
std::string robustness_text(const TuningSection& section) {
  if (!section.ensemble) return "";
  const auto plants = static_cast<int>(section.ensemble->members.size());
  const int within = section.ensemble->within_goals;
  if (within == plants) {
    return fmt::format("Held on {} plants that may be the true one, it keeps its goals on all.",
                       plants);
  }
  const int unstable = plants - section.ensemble->stable;
  return fmt::format(
      "It was tuned on one plant: held on {} that may be the true one, it keeps its goals on "
      "{}{}. `boresight tune` tunes laws to keep them on all.",
      plants, within, unstable > 0 ? fmt::format(" and is unstable on {}", unstable) : "");
}

// Where most of the error is what no loop sees.
std::string unseen_text(const TuningSection& section) {
  if (!(section.encoder_held_rms >= 0.9 * section.design.beam_rms)) return "";
  return "Nearly all of the error is bending of the structure that the encoder does not see: a "
         "loop "
         "that holds the encoder still, other motors or flywheels hardly lower it. What does is a "
         "stiffer structure, less wind on it, or a loop that moves the encoder against the bending "
         "(structures with +C, LQG), if friction lets it.";
}

// Gains that only the bounds of the search hold.
std::string bound_text(const TuningSection& section) {
  const auto& names = section.design.tuning.gains_at_bound;
  if (names.empty()) return "";
  return fmt::format(
      "The search ended at its bound for: {}. A gain there is no optimum; what lies beyond was not "
      "looked at.",
      fmt::join(names, ", "));
}

// The mean wind bends what no servo sees.
std::string bending_text(const TuningSection& section) {
  const auto smallest = std::ranges::min_element(
      section.budgets, {}, [](const BudgetResult& one) { return one.budget.rms; });
  if (smallest == section.budgets.end()) return "";
  const double bending = std::abs(section.static_bending);
  if (!(bending > smallest->budget.rms)) return "";
  return fmt::format(
      "The mean wind of {:g} m/s bends the antenna by {:.3f} mdeg, which is no part of these rms "
      "values and more than all of {}: calibration has to take it away.",
      section.design_speed, bending / millidegree, budget_text(smallest->budget));
}

}  // namespace

double reached_wind_speed(const TuningSection& section, const BudgetResult& budget) {
  const double supply = section.supply_wind_speed > 0.0 ? section.supply_wind_speed
                                                        : std::numeric_limits<double>::infinity();
  return std::min(budget.wind_speed_limit, supply);
}

std::string met_text(const TuningSection& section, const BudgetResult& budget) {
  const double reached = reached_wind_speed(section, budget);
  if (!(reached > 0.0)) return "is met in no wind";
  if (!std::isfinite(reached)) return "is met up to the 60 m/s looked at";
  if (reached < budget.wind_speed_limit) {
    return fmt::format(
        "would be met up to the {:.1f} m/s at which the mean wind torque alone reaches the "
        "supply's",
        reached);
  }
  return fmt::format("is met up to {:.1f} m/s", reached);
}

std::vector<std::string> unmet_needs(const TuningSection& section) {
  std::vector<std::string> sentences;
  for (const auto& result : section.budgets) {
    if (!result.budget.wind_speed) continue;
    const double needed = *result.budget.wind_speed;
    if (reached_wind_speed(section, result) >= needed * (1.0 - 1e-6)) continue;
    sentences.push_back(fmt::format(
        "NOT MET: {} is needed up to {:g} m/s; with this law it {}. `boresight tune` looks for a "
        "loop structure that meets it.",
        budget_text(result.budget), needed, met_text(section, result)));
  }
  return sentences;
}

std::string not_examined(const Report& report) {
  if (report.time_domain || !report.tuning || !report.tuning->design.usable()) return "";
  return "Friction, hunting and slewing were not examined: the case has no [simulation], and every "
         "rms here is of linear loops.";
}

void conclude_tuning(const Report& report, const TuningSection& section,
                     std::vector<std::string>& sentences) {
  const auto add = [&](std::string text) {
    if (!text.empty()) sentences.push_back(std::move(text));
  };
  for (const auto& law : section.present) add(present_text(section, law));
  const auto& design = section.design;
  if (design.tuning.status == design::TuningStatus::unstable) {
    add(fmt::format("No {} law of the search stabilises this antenna.",
                    control::to_string(section.structure)));
    return;
  }
  if (design.tuning.status != design::TuningStatus::optimal) {
    add(fmt::format("No {} law meets the hard goals; the nearest exceeds one by {:.1f} %.",
                    control::to_string(section.structure),
                    100.0 * (design.tuning.worst_goal_ratio - 1.0)));
    return;
  }
  if (!design.verification.passed) {
    add(fmt::format(
        "The best {} law found fails its verification ({}): nothing is concluded from it.",
        control::to_string(section.structure), design.verification.failure));
    return;
  }
  const bool repeated = 2 * section.seeds_within_1_percent > static_cast<int>(section.seeds.size());
  std::string text = fmt::format(
      "As built, the best {} law found{} points within {:.3f} mdeg rms an axis in {:g} m/s of wind",
      control::to_string(section.structure),
      repeated ? "" : " (not repeated by most seeds: look further)", design.beam_rms / millidegree,
      section.design_speed);
  for (const auto& budget : section.budgets) {
    text += fmt::format("; {} {}", budget_text(budget.budget), met_text(section, budget));
  }
  add(text + ".");
  for (auto& need : unmet_needs(section)) add(std::move(need));
  add(robustness_text(section));
  add(bound_text(section));

  const auto by_rms = [](const TuningSection::WindAlternative& x,
                         const TuningSection::WindAlternative& y) {
    return x.beam_rms < y.beam_rms;
  };
  const auto [least, most] = std::minmax_element(section.wind_alternatives.begin(),
                                                 section.wind_alternatives.end(), by_rms);
  add(fmt::format(
      "These rms values stand on the wind model {}: the same gains give {:.3f} mdeg by the {} "
      "model and {:.3f} by the {} model. With the encoder held perfectly still, bending that it "
      "cannot see would leave {:.3f} mdeg.",
      plant::to_string(section.wind_model), least->beam_rms / millidegree,
      plant::to_string(least->model), most->beam_rms / millidegree, plant::to_string(most->model),
      section.encoder_held_rms / millidegree));
  add(unseen_text(section));
  add(bending_text(section));
  add(not_examined(report));
}

std::vector<std::string> decide_tuning(const Report& report, const TuningSection& section) {
  std::vector<std::string> sentences;
  for (const auto& law : section.present) {
    if (law.design.tuning.status == design::TuningStatus::unstable) {
      sentences.push_back(unstable_present_gains(law.structure));
    }
  }
  const std::string structure(control::to_string(section.structure));
  if (section.design.tuning.status != design::TuningStatus::optimal) {
    sentences.push_back(fmt::format("No {} law meets the hard goals of this case.", structure));
    return sentences;
  }
  if (!section.design.verification.passed) {
    sentences.push_back(fmt::format(
        "The best {} law found fails its verification: decide nothing on it.", structure));
    return sentences;
  }
  auto needs = unmet_needs(section);
  const bool met = needs.empty();
  std::string unsteady = report.time_domain ? not_still(*report.time_domain) : "";
  const bool robust = !section.ensemble || section.ensemble->within_goals ==
                                               static_cast<int>(section.ensemble->members.size());
  std::string text =
      fmt::format("{} {}: it points within {:.3f} mdeg rms an axis in {:g} m/s of wind",
                  met && robust && unsteady.empty() && sentences.empty()
                      ? "Run the drive as built on"
                      : "The best law found for the drive as built is",
                  structure, section.design.beam_rms / millidegree, section.design_speed);
  if (report.time_domain) {
    text += fmt::format(" ({:.3f} on the nonlinear antenna)",
                        report.time_domain->result.wind.beam_rms / millidegree);
  }
  if (!section.budgets.empty() && met) {
    const auto& budget = section.budgets.front();
    text += fmt::format("; {} {}", budget_text(budget.budget), met_text(section, budget));
    // In the wind of the simulation the linear speed can be judged.
    if (report.time_domain &&
        reached_wind_speed(section, budget) >= report.time_domain->wind_speed &&
        !(report.time_domain->result.wind.beam_rms <= budget.budget.rms)) {
      text += fmt::format(" by the linear figure, but simulated not in {:g} m/s",
                          report.time_domain->wind_speed);
    }
  }
  if (!robust) needs.push_back(robustness_text(section));
  if (!unsteady.empty()) needs.push_back(std::move(unsteady));
  const std::string slow = report.time_domain ? slew_out_of_reach(*report.time_domain) : "";
  const std::string first = measure_first(section.input_effects, section.design.beam_rms);
  for (auto sentence : {unseen_text(section), slow, not_examined(report), first}) {
    if (!sentence.empty()) needs.push_back(std::move(sentence));
  }
  sentences.push_back(
      fmt::format("{}.{}{}", text, needs.empty() ? "" : " ", fmt::join(needs, " ")));
  return sentences;
}

}  // namespace boresight::app
