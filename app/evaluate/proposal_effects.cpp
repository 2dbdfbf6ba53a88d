#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/proposal_effects.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>

namespace boresight::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// One quantity of every proposal beside that of the antenna as it is.
std::string changes_of(const EvaluateSection& section, const char* quantity, const char* unit,
                       int decimals, std::optional<double> (*value)(const Candidate&)) {
  constexpr double worth_a_sentence = 0.1;
  const Candidate& base = section.candidates.front();
  const auto as_it_is = base.path.empty() ? value(base) : std::nullopt;
  if (!as_it_is || !(*as_it_is > 0.0)) return "";
  std::vector<std::string> changes;
  for (const auto& candidate : section.candidates) {
    const auto found = value(candidate);
    if (candidate.path.empty() || !found) continue;
    const double change = *found / *as_it_is - 1.0;
    if (!(std::abs(change) > worth_a_sentence)) continue;
    changes.push_back(fmt::format("{} {:.{}f} {} ({:+.0f} %)", candidate.name, *found, decimals,
                                  unit, 100.0 * change));
  }
  if (changes.empty()) return "";
  return fmt::format("{}: {:.{}f} {} as it is; {}.", quantity, *as_it_is, decimals, unit,
                     fmt::join(changes, ", "));
}

}  // namespace

std::string changed_motion(const EvaluateSection& section) {
  if (section.candidates.empty()) return "";
  const std::string reversal =
      changes_of(section, "Largest error of the beam after turning round at the tracking rate",
                 "mdeg", 2, [](const Candidate& candidate) -> std::optional<double> {
                   const auto error = candidate.reversal_error();
                   return error ? std::optional(*error / millidegree) : std::nullopt;
                 });
  const std::string acceleration =
      changes_of(section, "Acceleration that the drive reaches at the slew rate", "deg/s2", 3,
                 [](const Candidate& candidate) -> std::optional<double> {
                   if (!candidate.figures || !candidate.figures->slew) return std::nullopt;
                   return candidate.figures->slew->reachable_acceleration / degree;
                 });
  return reversal + (reversal.empty() || acceleration.empty() ? "" : " ") + acceleration;
}

std::string plants_within_needs(const EvaluateSection& section) {
  std::vector<std::string> needs;
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const PointingBudget& budget = section.budgets[i];
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
  return fmt::format("Of {} plants that may be the true one {}.", section.ensemble_size,
                     fmt::join(needs, "; "));
}

}  // namespace boresight::app
