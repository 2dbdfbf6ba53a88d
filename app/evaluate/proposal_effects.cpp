#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/proposal_effects.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

// Of what the antenna as it is has.
bool worth_a_sentence(double change) {
  return std::abs(change) > 0.1;
}

// One quantity of every proposal beside that of the antenna as it is.
std::string changes_of(const EvaluateSection& section, const char* quantity, const char* unit,
                       int decimals, std::optional<double> (*value)(const Candidate&)) {
  const Candidate& base = section.candidates.front();
  const auto as_it_is = base.path.empty() ? value(base) : std::nullopt;
  if (!as_it_is || !(*as_it_is > 0.0)) return "";
  std::vector<std::string> changes;
  for (const auto& candidate : section.candidates) {
    const auto found = value(candidate);
    if (candidate.path.empty() || !found) continue;
    const double change = *found / *as_it_is - 1.0;
    if (!worth_a_sentence(change)) continue;
    changes.push_back(fmt::format("{} {:.{}f} {} ({:+.0f} %)", candidate.name, *found, decimals,
                                  unit, 100.0 * change));
  }
  if (changes.empty()) return "";
  return fmt::format("{}: {:.{}f} {} as it is; {}.", quantity, *as_it_is, decimals, unit,
                     fmt::join(changes, ", "));
}

// Half of peak to peak of the beam (rad); 0 where nothing was seen.
double limit_cycle_of(const CandidateController& controller) {
  return controller.time_domain
             ? design::limit_cycle_amplitude(controller.time_domain->limit_cycles)
             : 0.0;
}

bool moves_otherwise(const Candidate& candidate, const Candidate& base) {
  const auto error = candidate.reversal_error(), own = base.reversal_error();
  if (error && own && worth_a_sentence(*error / *own - 1.0)) return true;
  const CandidateController* controller = candidate.chosen_controller();
  const CandidateController* base_controller = base.chosen_controller();
  if (controller == nullptr || base_controller == nullptr) return false;
  const double cycle = limit_cycle_of(*controller), own_cycle = limit_cycle_of(*base_controller);
  return own_cycle > 0.0 ? worth_a_sentence(cycle / own_cycle - 1.0) : cycle > 0.0;
}

// Which proposals' changes of reversals and limit cycles their controllers may have made; empty
// without such.
std::string controllers_of_other_families(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const CandidateController* own = base.chosen_controller();
  if (!base.path.empty() || own == nullptr) return "";
  std::vector<std::string> controllers;
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (candidate.path.empty() || controller == nullptr || !moves_otherwise(candidate, base))
      continue;
    std::vector<std::string> gains;
    for (const std::size_t k : other_family(*controller, *own)) {
      const auto& gain = controller->design.tuning.controller.structure.gains()[k];
      gains.push_back(fmt::format(
          "{} {:.3g} against {:.3g}{}", gain.symbol, controller->design.tuning.controller.gains[k],
          own->design.tuning.controller.gains[k], gain.unit == "1" ? "" : " " + gain.unit));
    }
    if (gains.empty()) continue;
    controllers.push_back(
        fmt::format("{} has a different kind of {} controller from the antenna as it is: {}",
                    candidate.name, controller->structure, fmt::join(gains, ", ")));
  }
  if (controllers.empty()) return "";
  return fmt::format(
      "{}. Differences in reversal error and limit cycle may come from the controller, not the "
      "hardware. Narrow the search with [[tuning.bound]], or the bounds of a [[loop]], to obtain "
      "one kind.",
      fmt::join(controllers, "; "));
}

}  // namespace

std::vector<std::size_t> other_family(const CandidateController& controller,
                                      const CandidateController& other) {
  constexpr double far_apart = 5.0;
  const auto& gains = controller.design.tuning.controller.gains;
  const auto& others = other.design.tuning.controller.gains;
  std::vector<std::size_t> places;
  if (controller.structure != other.structure || gains.size() != others.size()) return places;
  for (std::size_t k = 0; k < gains.size(); ++k) {
    if (std::max(gains[k], others[k]) > far_apart * std::min(gains[k], others[k])) {
      places.push_back(k);
    }
  }
  return places;
}

std::string changed_motion(const EvaluateSection& section) {
  if (section.candidates.empty()) return "";
  const std::string reversal =
      changes_of(section, "Peak boresight error at a velocity reversal at tracking rate", "mdeg", 2,
                 [](const Candidate& candidate) -> std::optional<double> {
                   const auto error = candidate.reversal_error();
                   return error ? std::optional(*error / millidegree) : std::nullopt;
                 });
  const std::string acceleration =
      changes_of(section, "Acceleration available at the slew rate", "deg/s2", 3,
                 [](const Candidate& candidate) -> std::optional<double> {
                   if (!candidate.figures || !candidate.figures->slew) return std::nullopt;
                   return candidate.figures->slew->reachable_acceleration / degree;
                 });
  std::vector<std::string> sentences{reversal, controllers_of_other_families(section),
                                     acceleration};
  std::erase_if(sentences, [](const std::string& one) { return one.empty(); });
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string plants_within_needs(const EvaluateSection& section) {
  std::vector<std::string> needs;
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const design::PointingBudget& budget = section.budgets[i];
    if (!budget.wind_speed) continue;
    std::vector<std::string> counts;
    for (const auto& candidate : section.candidates) {
      const CandidateController* controller = candidate.chosen_controller();
      if (controller == nullptr || i >= controller->budgets_met.size()) continue;
      const auto& met = controller->budgets_met[i];
      if (met) counts.push_back(fmt::format("{} on {}", candidate.name, *met));
    }
    if (counts.empty()) continue;
    needs.push_back(fmt::format("{} ({}: {:.3f} mdeg) is met in {:.3g} m/s{} by {}", budget.name,
                                budget.band, budget.rms / millidegree, *budget.wind_speed,
                                dish_and_mast(section.wind_mast, *budget.wind_speed),
                                fmt::join(counts, ", ")));
  }
  if (needs.empty()) return "";
  return fmt::format("Ensemble of {} plants: {}.", section.ensemble_size, fmt::join(needs, "; "));
}

}  // namespace boresight::app
