#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {
namespace {

// m/s on the nominal plant; none where it is not known.
std::optional<double> reached_speed(const Candidate& candidate, std::size_t budget) {
  if (!candidate.figures || budget >= candidate.figures->speed_limits.size()) return std::nullopt;
  const double limit = candidate.figures->speed_limits[budget];
  if (std::isnan(limit)) return std::nullopt;
  return std::min(limit, candidate.figures->torque_limited_wind_speed);
}

}  // namespace

std::string_view why_not(const Candidate& candidate) {
  const CandidateController* controller = candidate.chosen_controller();
  if (controller == nullptr) return "has no stable controller";
  if (!controller->constraints_met) return "violates a constraint on some plant";
  return candidate.has_limit_cycle() ? "has a limit cycle beyond the allowed amplitude"
                                     : "fails its verification";
}

std::vector<std::string> limit_cycle_candidates(const EvaluateSection& section) {
  std::vector<std::string> names;
  for (const auto& candidate : section.candidates) {
    if (candidate.has_limit_cycle()) names.push_back(candidate.name);
  }
  return names;
}

std::vector<std::string> unfit_but_counted(const EvaluateSection& section,
                                           const DecisionSection& decision) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
    const Candidate& candidate = section.candidates[decision.candidates[i].candidate];
    if (!candidate.feasible() && decision.statistics.options[i].best.value > 0.0) {
      names.push_back(candidate.name);
    }
  }
  return names;
}

std::string none_chosen(const EvaluateSection& section) {
  std::vector<const Candidate*> proposals;
  const Candidate* base = nullptr;
  for (const auto& candidate : section.candidates) {
    if (candidate.path.empty()) {
      base = &candidate;
    } else {
      proposals.push_back(&candidate);
    }
  }
  const auto feasible = [](const Candidate* one) { return one->feasible(); };
  if (proposals.empty() || std::ranges::any_of(proposals, feasible)) return "";
  const bool stays = base != nullptr && base->feasible();
  if (std::ranges::all_of(proposals, [](const Candidate* one) { return one->has_limit_cycle(); })) {
    return fmt::format("{} a limit cycle beyond the allowed amplitude{}: none is chosen.",
                       proposals.size() == 1 ? "The proposal has" : "All proposals have",
                       base != nullptr && base->has_limit_cycle() ? ", as does the antenna as it is"
                       : stays                                    ? ", unlike the antenna as it is"
                                                                  : "");
  }
  std::vector<std::string> reasons;
  std::ranges::transform(proposals, std::back_inserter(reasons), [](const Candidate* one) {
    return fmt::format("{} {}", one->name, why_not(*one));
  });
  if (base != nullptr && !stays)
    reasons.push_back(fmt::format("{} {}", base->name, why_not(*base)));
  return fmt::format("No proposal is eligible: {}.", fmt::join(reasons, ", "));
}

namespace {

// Those whose budget is met as far as the nearest one's, but for what decides nothing.
std::string as_near_text(const EvaluateSection& section, std::size_t budget,
                         const Candidate& nearest, double farthest) {
  std::vector<std::string> names;
  for (const auto& candidate : section.candidates) {
    const auto reached = reached_speed(candidate, budget);
    if (&candidate == &nearest || !reached || candidate.feasible() != nearest.feasible()) continue;
    if (*reached > (1.0 - negligible_change) * farthest) names.push_back(candidate.name);
  }
  if (names.empty()) return "";
  return fmt::format(" (and within {:.0f} % of it {})", 100.0 * negligible_change,
                     fmt::join(names, ", "));
}

}  // namespace

std::vector<std::string> unmet_needs(const EvaluateSection& section) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < section.budgets.size(); ++i) {
    const design::PointingBudget& budget = section.budgets[i];
    if (!budget.wind_speed) continue;
    const double needed = *budget.wind_speed * (1.0 - 1e-6);
    const Candidate* nearest = nullptr;
    double farthest = 0.0;
    bool met = false;
    for (const auto& candidate : section.candidates) {
      const auto reached = reached_speed(candidate, i);
      if (!reached) continue;
      met = met || (candidate.feasible() && *reached >= needed);
      const bool fitter = nearest == nullptr || (candidate.feasible() && !nearest->feasible());
      const bool alike = nearest != nullptr && candidate.feasible() == nearest->feasible();
      if (fitter || (alike && *reached > farthest)) {
        nearest = &candidate;
        farthest = *reached;
      }
    }
    if (met || nearest == nullptr) continue;
    sentences.push_back(fmt::format(
        "NOT MET: {} ({}: {:.3f} mdeg) is needed up to {:.3g} m/s{}; no eligible candidate meets "
        "it there. {} comes nearest, with {}{}{}.",
        budget.name, budget.band, budget.rms / millidegree, *budget.wind_speed,
        dish_and_mast(section.wind_mast, *budget.wind_speed), nearest->name,
        std::isfinite(farthest)
            ? fmt::format("{:.1f} m/s{}", farthest, dish_and_mast(section.wind_mast, farthest))
            : std::string("the 60 m/s searched"),
        as_near_text(section, i, *nearest, farthest),
        nearest->feasible() ? "" : fmt::format(", but {}", why_not(*nearest))));
  }
  return sentences;
}

}  // namespace boresight::app
