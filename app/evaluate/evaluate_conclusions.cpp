#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/pairs_by_structure.hpp>
#include <boresight/app/evaluate/proposal_effects.hpp>
#include <boresight/app/evaluate/sample_conclusions.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {
namespace {

// NaN without a stable controller.
double rms_of(const Candidate& candidate) {
  const CandidateController* controller = candidate.chosen_controller();
  return controller == nullptr ? std::numeric_limits<double>::quiet_NaN()
                               : controller->compared_rms();
}

// What has no cost may cost anything.
double cost_of(const Candidate& candidate) {
  return candidate.cost.value_or(std::numeric_limits<double>::infinity());
}

std::string against_as_it_is(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const CandidateController* controller = base.chosen_controller();
  if (!base.path.empty() || controller == nullptr || !std::isfinite(rms_of(base))) return "";
  std::vector<std::string> better, worse, limit_cycles;
  for (const auto& candidate : section.candidates) {
    if (candidate.path.empty() || !std::isfinite(rms_of(candidate))) continue;
    if (candidate.has_limit_cycle()) limit_cycles.push_back(candidate.name);
    if (!candidate.feasible()) continue;
    const double change = rms_of(candidate) / rms_of(base) - 1.0;
    const std::string& loops = candidate.chosen_controller()->structure;
    auto& list = change < 0.0 ? better : worse;
    list.push_back(
        fmt::format("{:.1f} % by {}{}", 100.0 * std::abs(change), candidate.name,
                    loops == controller->structure ? "" : fmt::format(" ({} loops)", loops)));
  }
  std::string text = fmt::format(
      "Conditions: {} loops on the antenna as it is, {} wind at {:.3g} m/s, gains re-tuned for "
      "each proposal{}. Rms boresight error over the plants, compared with the antenna as it is, "
      "re-tuned ({:.4f} mdeg{}): ",
      controller->structure, plant::to_string(section.wind_model), section.wind_speed,
      section.time_domain ? ", each linear rms times the simulated/linear rms ratio of its "
                            "controller, with its limit "
                            "cycle in quadrature"
                          : ", linear loops only",
      rms_of(base) / millidegree, base.has_limit_cycle() ? ", with a limit cycle" : "");
  if (better.empty()) {
    text += worse.empty() ? "no eligible proposal to compare" : "no proposal lowers it";
  } else {
    text += fmt::format("lowered {}", fmt::join(better, ", "));
  }
  if (!worse.empty()) text += fmt::format("; raised {}", fmt::join(worse, ", "));
  if (!limit_cycles.empty()) {
    text += fmt::format(". Excluded, limit cycle beyond the allowed amplitude: {}",
                        fmt::join(limit_cycles, ", "));
  }
  return text + ".";
}

// What the nonlinear antenna makes of the controllers: the widest spread of factors, limit cycles,
// and where it chose another structure or order than the linear plant.
std::string in_the_time_domain(const EvaluateSection& section) {
  if (!section.time_domain) return "";
  std::vector<std::string> factors, limit_cycles, failed;
  const Candidate* linear = nullptr;
  const Candidate* simulated = nullptr;
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || !controller->time_domain) continue;
    if (!std::isfinite(controller->simulated_to_linear_rms())) {
      failed.push_back(candidate.name);
      continue;
    }
    factors.push_back(
        fmt::format("{} {:.2f}", candidate.name, controller->simulated_to_linear_rms()));
    double amplitude = 0.0;
    for (const auto& one : controller->time_domain->limit_cycles) {
      if (one.limit_cycle) amplitude = std::max(amplitude, one.boresight_amplitude);
    }
    if (amplitude > 0.0) {
      limit_cycles.push_back(fmt::format("{} +-{:.2f}", candidate.name, amplitude / millidegree));
    }
    if (!controller->usable()) continue;
    if (linear == nullptr || controller->member_rms < linear->chosen_controller()->member_rms)
      linear = &candidate;
    if (simulated == nullptr || rms_of(candidate) < rms_of(*simulated)) simulated = &candidate;
  }
  std::string text;
  if (!factors.empty()) {
    text = fmt::format("Simulated/linear rms ratio: {}.", fmt::join(factors, ", "));
  }
  if (linear != simulated && linear != nullptr && simulated != nullptr) {
    text += fmt::format(" {} has the lowest linear rms, {} the lowest simulated rms.", linear->name,
                        simulated->name);
  }
  if (!limit_cycles.empty()) {
    text += fmt::format(" Limit cycles of the boresight (mdeg, at rest or tracking): {}.",
                        fmt::join(limit_cycles, ", "));
  }
  if (!failed.empty()) {
    text += fmt::format(" Simulation not completed, not compared: {}.", fmt::join(failed, ", "));
  }
  return text;
}

std::string on_the_front(const EvaluateSection& section) {
  if (section.front.empty()) return "";
  std::vector<std::string> steps;
  for (std::size_t k = 0; k < section.front.size(); ++k) {
    const auto& candidate = section.candidates[section.front[k]];
    std::string step = fmt::format("{} ({:g} {}, {:.4f} mdeg)", candidate.name, cost_of(candidate),
                                   section.currency, rms_of(candidate) / millidegree);
    if (k > 0) {
      const auto& before = section.candidates[section.front[k - 1]];
      const double gained = (rms_of(before) - rms_of(candidate)) / millidegree;
      const double paid = cost_of(candidate) - cost_of(before);
      const double fraction = 1.0 - rms_of(candidate) / rms_of(before);
      if (fraction < negligible_change) {
        step += fmt::format(", only {:.1f} % below the previous one: not worth its cost",
                            100.0 * fraction);
      } else if (gained > 0.0 && paid > 0.0) {
        step += fmt::format(", {:.0f} {} per mdeg of improvement", paid / gained, section.currency);
      }
    }
    steps.push_back(std::move(step));
  }
  const bool assumed = std::ranges::any_of(
      section.candidates, [](const auto& candidate) { return candidate.cost_assumed; });
  return fmt::format("Pareto front of cost and rms: {}.{}", fmt::join(steps, "; "),
                     assumed ? " Costs marked \"assumed\" are estimates, not quotations." : "");
}

std::string without_cost(const EvaluateSection& section) {
  std::vector<std::string> names;
  for (const auto& candidate : section.candidates) {
    if (!candidate.path.empty() && !candidate.cost) names.push_back(candidate.name);
  }
  if (names.empty()) return "";
  return section.currency.empty()
             ? std::string(
                   "No proposal states a cost ([cost] of its file): there is no Pareto front.")
             : fmt::format("Not on the Pareto front (no [cost] stated): {}.",
                           fmt::join(names, ", "));
}

std::optional<double> slew_margin(const Candidate& candidate) {
  return candidate.figures ? candidate.figures->slew_rate_margin : std::nullopt;
}

// What the antenna as it is does not reach either is no fault of a proposal, and says more of the
// case's numbers than of the drive.
std::vector<std::string> short_of_slewing(const EvaluateSection& section) {
  const Candidate& base = section.candidates.front();
  const double as_it_is = base.path.empty() ? slew_margin(base).value_or(1.0) : 1.0;
  const bool stated_too_high = as_it_is < 1.0;
  // Rounding lowers nothing.
  const double enough = stated_too_high ? as_it_is * (1.0 - 1e-9) : 1.0;
  std::vector<std::string> slow;
  for (const auto& candidate : section.candidates) {
    const auto margin = slew_margin(candidate);
    if (!margin || *margin >= enough) continue;
    slow.push_back(fmt::format("{} ({:.2f} of the slew rate)", candidate.name, *margin));
  }
  std::vector<std::string> sentences;
  if (stated_too_high) {
    sentences.push_back(
        fmt::format("The drive as it is cannot reach the stated slew rate: against friction and "
                    "offset it sustains {:.2f} of it. Check drive.slew_rate, the friction curve, "
                    "the valve and the supply.",
                    as_it_is));
  }
  if (!slow.empty()) {
    sentences.push_back(fmt::format(
        "{}: {}. The cost of larger pumps and valves is not included.",
        stated_too_high ? "Still slower slewing"
                        : "Unable to sustain the present slew rate against friction and offset",
        fmt::join(slow, "; ")));
  }
  return sentences;
}

std::string out_of_reach(const EvaluateSection& section) {
  std::vector<std::string> infeasible, limit_cycles;
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (candidate.has_limit_cycle() && controller->time_domain) {
      limit_cycles.push_back(fmt::format(
          "{} with {} (+-{:.2f} mdeg)", candidate.name, controller->structure,
          design::limit_cycle_amplitude(controller->time_domain->limit_cycles) / millidegree));
    } else if (!candidate.feasible()) {
      infeasible.push_back(candidate.name);
    }
  }
  std::vector<std::string> sentences = short_of_slewing(section);
  if (!infeasible.empty()) {
    sentences.insert(sentences.begin(),
                     fmt::format("Not eligible: no controller of {} meets every constraint on "
                                 "every plant and passes its verification.",
                                 fmt::join(infeasible, ", ")));
  }
  if (!limit_cycles.empty()) {
    sentences.push_back(fmt::format("Excluded, limit cycle beyond the allowed amplitude: {}.",
                                    fmt::join(limit_cycles, ", ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

// Of the controllers compared.
std::string ended_at_bounds(const EvaluateSection& section) {
  std::vector<SearchedController> controllers;
  for (const auto& candidate : section.candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr) continue;
    controllers.push_back({fmt::format("{} ({})", candidate.name, controller->structure),
                           &controller->design.tuning});
  }
  std::vector<std::string> sentences = gains_at_bounds(controllers);
  if (std::ranges::any_of(controllers, [](const SearchedController& controller) {
        return ends_at_position_gain(*controller.tuning);
      })) {
    sentences.emplace_back(trade_not_looked_for());
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace

std::string_view measure_phrase(design::LossMeasure measure) {
  switch (measure) {
    case design::LossMeasure::mean:
      return "on average";
    case design::LossMeasure::quantile_95:
      return "at the 95 % quantile";
    case design::LossMeasure::median:
      return "at the median";
  }
  return "";
}

std::vector<std::string> conclude(const EvaluateSection& section) {
  std::vector<std::string> sentences;
  const auto add = [&](std::string text) {
    if (!text.empty()) sentences.push_back(std::move(text));
  };
  if (section.candidates.empty()) return sentences;
  if (section.wind_mast) add(conclude_mast(*section.wind_mast));
  add(none_chosen(section));
  add(against_as_it_is(section));
  if (section.decision) add(controller_or_hardware(section, *section.decision));
  add(in_the_time_domain(section));
  for (auto& need : unmet_needs(section)) add(std::move(need));
  add(plants_within_needs(section));
  add(changed_motion(section));
  add(on_the_front(section));
  add(without_cost(section));
  if (section.decision) {
    for (auto& text : conclude_samples(section, *section.decision)) add(std::move(text));
  }
  add(out_of_reach(section));
  add(ended_at_bounds(section));
  return sentences;
}

}  // namespace boresight::app
