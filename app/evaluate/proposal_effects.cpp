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
double limit_cycle_of(const CandidateLaw& law) {
  return law.time_domain ? design::hunting_amplitude(law.time_domain->hunting) : 0.0;
}

bool moves_otherwise(const Candidate& candidate, const Candidate& base) {
  const auto error = candidate.reversal_error(), own = base.reversal_error();
  if (error && own && worth_a_sentence(*error / *own - 1.0)) return true;
  const CandidateLaw* law = candidate.chosen_law();
  const CandidateLaw* base_law = base.chosen_law();
  if (law == nullptr || base_law == nullptr) return false;
  const double cycle = limit_cycle_of(*law), own_cycle = limit_cycle_of(*base_law);
  return own_cycle > 0.0 ? worth_a_sentence(cycle / own_cycle - 1.0) : cycle > 0.0;
}

// Which proposals' changes of reversals and hunting their laws may have made; empty without such.
std::string laws_of_other_families(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const CandidateLaw* own = base.chosen_law();
  if (!base.path.empty() || own == nullptr) return "";
  std::vector<std::string> laws;
  for (const auto& candidate : section.candidates) {
    const CandidateLaw* law = candidate.chosen_law();
    if (candidate.path.empty() || law == nullptr || !moves_otherwise(candidate, base)) continue;
    std::vector<std::string> gains;
    for (const std::size_t k : other_family(*law, *own)) {
      const auto& gain = law->design.tuning.law.structure.gains()[k];
      gains.push_back(fmt::format("{} {:.3g} against {:.3g}{}", gain.symbol,
                                  law->design.tuning.law.gains[k], own->design.tuning.law.gains[k],
                                  gain.unit == "1" ? "" : " " + gain.unit));
    }
    if (gains.empty()) continue;
    laws.push_back(
        fmt::format("{} has a different kind of {} controller from the antenna as it is: {}",
                    candidate.name, law->structure, fmt::join(gains, ", ")));
  }
  if (laws.empty()) return "";
  return fmt::format(
      "{}. Differences in reversal error and limit cycle may come from the controller, not the "
      "hardware. Narrow the search with [[tuning.bound]], or the bounds of a [[loop]], to obtain "
      "one kind.",
      fmt::join(laws, "; "));
}

}  // namespace

std::vector<std::size_t> other_family(const CandidateLaw& law, const CandidateLaw& other) {
  constexpr double far_apart = 5.0;
  const auto& gains = law.design.tuning.law.gains;
  const auto& others = other.design.tuning.law.gains;
  std::vector<std::size_t> places;
  if (law.structure != other.structure || gains.size() != others.size()) return places;
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
  std::vector<std::string> sentences{reversal, laws_of_other_families(section), acceleration};
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
      const CandidateLaw* law = candidate.chosen_law();
      if (law == nullptr || i >= law->budgets_met.size()) continue;
      const auto& met = law->budgets_met[i];
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
