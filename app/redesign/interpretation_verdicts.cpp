#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/interpretation_verdicts.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {
namespace {

// What a choice's own controller does.
struct EvaluatedChoice {
  double boresight_rms = 0.0;        // rad
  std::vector<double> speed_limits;  // m/s, one a budget
};

std::optional<EvaluatedChoice> evaluated(const InterpretationResult& choice) {
  if (!choice.design || !choice.speed_limits || !choice.design->usable()) return std::nullopt;
  return EvaluatedChoice{choice.design->boresight_rms, *choice.speed_limits};
}

// The case's own, which is the first: tuned as the others are.
std::optional<EvaluatedChoice> own_choice(const Report& report) {
  return report.interpretations.empty() ? std::nullopt : evaluated(report.interpretations.front());
}

// Needed budgets with another verdict under one of those choices than under the case's own; empty
// without one.
template <typename Counts>
std::string turned_verdicts(const Report& report, const TuningSection& section,
                            const Counts& counts) {
  std::vector<std::string> verdicts;
  const auto own = own_choice(report);
  for (std::size_t i = 0; own && i < section.budgets.size(); ++i) {
    const design::PointingBudget& budget = section.budgets[i].budget;
    const bool met =
        meets_need(budget, std::min(own->speed_limits.at(i), section.torque_limited_wind_speed));
    std::vector<std::string> names;
    // The first is the case's own.
    for (const auto& choice : report.interpretations | std::views::drop(1)) {
      const auto found = evaluated(choice);
      if (!found || !counts(choice) || choice.missed_resonance()) continue;
      const double reached = std::min(found->speed_limits.at(i), section.torque_limited_wind_speed);
      if (meets_need(budget, reached) == met) continue;
      names.push_back(fmt::format("'{}' ({:.3f} mdeg in {:.3g} m/s)", choice.name,
                                  found->boresight_rms / millidegree, section.design_speed));
    }
    if (names.empty()) continue;
    verdicts.push_back(fmt::format("{} is {} up to its required wind speed with {}",
                                   budget_text(budget), met ? "not met" : "met",
                                   fmt::join(names, ", ")));
  }
  return fmt::format("{}", fmt::join(verdicts, "; "));
}

}  // namespace

std::string other_interpretations_text(const Report& report, const TuningSection& section) {
  const std::string verdicts =
      turned_verdicts(report, section, [](const InterpretationResult& choice) {
        return !choice.other_fractions && !choice.other_attitude;
      });
  if (verdicts.empty()) return "";
  return fmt::format(
      "Re-tuned for alternative interpretations of the case, {}; the case's own gives the opposite "
      "verdict.",
      verdicts);
}

std::string other_attitudes_text(const Report& report, const TuningSection& section) {
  const std::string verdicts = turned_verdicts(
      report, section, [](const InterpretationResult& choice) { return choice.other_attitude; });
  if (verdicts.empty()) return "";
  return fmt::format(
      "Re-tuned for the antenna's other attitudes, {}; the case's own gives the opposite verdict.",
      verdicts);
}

std::string guessed_fractions_text(const Report& report, const TuningSection& section) {
  struct Guess {
    std::string name;
    double boresight_rms;
    std::vector<double> reached;  // m/s
  };
  std::vector<Guess> guesses;
  const auto add = [&](std::string name, const EvaluatedChoice& found) {
    Guess guess{std::move(name), found.boresight_rms, found.speed_limits};
    for (double& speed : guess.reached) speed = std::min(speed, section.torque_limited_wind_speed);
    guesses.push_back(std::move(guess));
  };
  const auto own = own_choice(report);
  if (!own) return "";
  add("the case's own", *own);
  for (const auto& choice : report.interpretations) {
    const auto found = evaluated(choice);
    if (found && choice.other_fractions) add("'" + choice.name + "'", *found);
  }
  std::string verdicts;
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const design::PointingBudget& budget = section.budgets[i].budget;
    std::vector<std::string> meeting, missing;
    for (const Guess& guess : guesses) {
      (meets_need(budget, guess.reached.at(i)) ? meeting : missing).push_back(guess.name);
    }
    if (meeting.empty() || missing.empty()) continue;
    verdicts +=
        fmt::format("; {} is met up to its required wind speed with {}, but not with {}",
                    budget_text(budget), fmt::join(meeting, ", "), fmt::join(missing, ", "));
  }
  bool apart = false;
  std::vector<std::string> others;
  for (const Guess& guess : guesses) {
    if (&guess == &guesses.front()) continue;
    apart = apart ||
            std::abs(guess.boresight_rms / guesses.front().boresight_rms - 1.0) > telling_change;
    others.push_back(fmt::format("{:.3f} with {}", guess.boresight_rms / millidegree, guess.name));
  }
  if (verdicts.empty() && !apart) return "";
  return fmt::format(
      "The modal participation of wind torque and boresight is assumed. Re-tuned, {} has {:.3f} "
      "mdeg with the case's own and {}{}. A structural model (modes_file) states it.",
      report.interpretations.front().design->tuning.controller.structure.name(),
      guesses.front().boresight_rms / millidegree, fmt::join(others, ", "), verdicts);
}

}  // namespace boresight::app
