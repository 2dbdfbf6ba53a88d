#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/pairs_by_structure.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/report/climate_wording.hpp>
#include <boresight/app/report/expected_rms_wording.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/study_decision.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/matching_verdict.hpp>

namespace boresight::app {
namespace {

using Sentences = std::vector<std::string>;

double mdeg(double angle) {
  return angle / millidegree;
}

// Whether flywheels or loops come first, where both can be told; `others`: other structures were
// studied.
std::string first_change(const MatchSection& section, const MatchSeries& best, bool others) {
  const std::size_t built = as_built(section);
  const auto& run = best.values[built].time_domain;
  if (run && has_limit_cycle_at(section, best, built)) {
    const bool seen = limit_cycle_beyond(section, run->limit_cycles);
    return seen ? "As built, these loops limit-cycle beyond the allowed amplitude on the nonlinear "
                  "antenna."
                : "As built, these loops are not shown free of limit cycles on the nonlinear "
                  "antenna: a run did not complete.";
  }
  const design::StructuresAsBuilt structures = structures_as_built(section);
  const double by_disks =
      best.values[built].boresight_rms / best.values[best.best.value_or(built)].boresight_rms - 1.0;
  std::string text =
      fmt::format("Leaving the motors as built costs {:+.1f} % with these loops", 100.0 * by_disks);
  if (structures.count < 2) {
    return text + (by_disks < negligible_change ? ": leave them."
                   : others ? "; no other loops studied meet the constraints and are shown free of "
                              "limit cycles beyond the allowed amplitude."
                            : "; other loops were not studied.");
  }
  const double by_loops = structures.change;
  text += fmt::format(", and the choice of loops as built up to {:.1f} %", 100.0 * by_loops);
  if (std::max(by_disks, by_loops) < negligible_change)
    return text + ": neither is worth a change.";
  if (std::abs(by_loops - by_disks) < negligible_change) return text + ": the two matter equally.";
  return text + fmt::format(": change the {} first.", by_loops > by_disks ? "loops" : "flywheels");
}

// The friction slope that decides whether the inertia matters; empty without one.
std::string measure_friction(const MatchSection& section) {
  const FrictionThreshold* threshold = deciding_friction(section);
  if (section.friction_measured || threshold == nullptr || !threshold->slope) return "";
  return fmt::format(
      "Measure the friction slope at the tracking rate first: above {:.3g} N m s/rad the motors' "
      "inertia changes the rms of {} loops by less than {:.0f} %.",
      *threshold->slope, threshold->structure, 100.0 * threshold->spread);
}

// Of the gains that the antenna runs on now.
Sentences unstable_now(const TuneSection& section) {
  Sentences sentences;
  for (const auto& controller : section.controllers) {
    if (controller.tuned_for != TunedFor::present || controller.stable() ||
        controller.wind_speed != section.wind_speeds.front()) {
      continue;
    }
    sentences.push_back(unstable_present_gains(controller.structure));
  }
  return sentences;
}

// Motors compared with their recommended loops, by simulation; empty without runs of several.
std::string decide_motors(const MatchSection& section) {
  const auto ranked = ranked_motors(section);
  const auto built = std::ranges::find(ranked, as_built(section), &design::RankedMotors::point);
  if (ranked.size() < 2 || built == ranked.end()) return "";
  std::vector<std::string> figures;
  for (const auto& motors : ranked) {
    figures.push_back(fmt::format("{:.4g} disks{} {:.3f} mdeg with {}",
                                  section.points[motors.point].disks,
                                  motors.point == built->point ? " (as built)" : "",
                                  mdeg(motors.compared_rms), section.series[motors.series].name));
  }
  const MatchPoint& best = section.points[ranked.front().point];
  return fmt::format(
      "Compared with loops, simulated, over {} plants, limit cycle included: {}: {}.",
      std::max<std::size_t>(section.members, 1), fmt::join(figures, ", "),
      !built->tied
          ? fmt::format("change to {:.4g} disks, {:.1f} % better than as built", best.disks,
                        100.0 * (1.0 - ranked.front().compared_rms / built->compared_rms))
      : built == ranked.begin() ? std::string("keep the motors as built")
                                : std::string("a tie, keep the motors as built"));
}

// The least linear rms that a structure reaches, and the range of inertias around it.
std::string linear_minimum(const MatchSection& section, const MatchSeries& best,
                           bool others_limit_cycle) {
  const std::size_t place = best.best.value_or(as_built(section));
  const MatchPoint& point = section.points[place];
  const double minimum = best.values[place].boresight_rms;
  const bool least_of_all = std::ranges::none_of(section.series, [&](const MatchSeries& series) {
    return series.best && series.values[*series.best].boresight_rms < minimum;
  });
  const std::string lead = std::string(least_of_all ? "The minimum linear rms"
                                                    : "The linear rms of the structure to prefer") +
                           (others_limit_cycle ? ", of those free of limit cycles," : "");
  return fmt::format(
      "{} is {:.3f} mdeg in {:.3g} m/s, with {} loops and {:.4g} disks on each motor (ratio "
      "{:.2f}); "
      "from {:.1f} to {:.1f} disks it stays within 5 %.",
      lead, mdeg(minimum), section.wind_speed, best.name, point.disks, point.motor_to_load_ratio,
      best.within_5_percent.lowest, best.within_5_percent.highest);
}

// Of structures free of limit cycles; `others_limit_cycle`: some were excluded; `compared`:
// decide_motors decides on the flywheels.
Sentences decide_inertia(const MatchSection& section, bool others_limit_cycle, bool compared) {
  const MatchSeries* best = recommended_structure(section, [](const MatchSeries&) { return true; });
  if (best == nullptr) {
    return {others_limit_cycle
                ? "No structure that meets the constraints is shown free of limit cycles "
                  "beyond the allowed amplitude: examine friction before the motors."
                : "No structure meets the constraints at any motor inertia."};
  }
  const std::size_t built = as_built(section), best_point = best->best.value_or(built);
  const double minimum = best->values[best_point].boresight_rms;
  const MatchValue& present = best->values[built];
  const MatchSeries* moved = most_moved(section);
  if (!compared && moved != nullptr && is_eligible(section, *best) && hardly_matters(section)) {
    return {fmt::format(
        "Leave the flywheels as they are: with {} loops the rms as built is {:.3f} mdeg in {:g} "
        "m/s, and from {:g} to {:g} disks on each motor no structure's rms changes by more than "
        "{:.1f} %.{}",
        best->name, mdeg(present.boresight_rms), section.wind_speed, section.points.front().disks,
        section.points.back().disks, 100.0 * span_of(*moved), what_matters_more(section))};
  }
  const bool inertia_matters =
      !present.found || present.boresight_rms / minimum - 1.0 >= negligible_change;
  Sentences sentences;
  // Linear figures beside the simulated ones that decided would only name another structure.
  if (!compared) {
    sentences.push_back(linear_minimum(section, *best, others_limit_cycle));
    if (present.found) {
      sentences.push_back(
          first_change(section, *best, others_limit_cycle || section.series.size() > 1));
    }
  }
  if (auto text = measure_friction(section); inertia_matters && !text.empty()) {
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace

namespace {

// The one controller that every command recommends for the motors as built.
std::string recommended_first(const design::TuningStudy& study,
                              std::string_view of = "Recommended") {
  const TunedController* controller = recommended_tuned_controller(study);
  if (controller == nullptr) return "No controller is recommended: no tuned controller is fit.";
  const bool simulated = controller->in_time && std::isfinite(controller->in_time->rms());
  if (simulated && controller->in_time->expected) {
    const auto& expected = *controller->in_time->expected;
    return fmt::format("{}: {}, {:.3f} mdeg rms per axis in {:.3g} m/s wind, simulated ({}).", of,
                       name_and_purpose(*controller), mdeg(expected.rms.value),
                       controller->wind_speed, interval_text(expected, controller->boresight_rms));
  }
  return fmt::format(
      "{}: {}, {:.3f} mdeg rms per axis in {:.3g} m/s wind, {}.", of, name_and_purpose(*controller),
      mdeg(simulated ? controller->in_time->rms() : controller->boresight_rms),
      controller->wind_speed,
      simulated ? fmt::format("simulated ({:.3f} linear)", mdeg(controller->boresight_rms))
                : std::string("linear plant, not simulated"));
}

void add_ties(const design::TuningStudy& study, const TunedController* recommended,
              Sentences& sentences) {
  if (recommended == nullptr) return;
  if (std::string text = ties_text(study, *recommended); !text.empty()) {
    sentences.push_back(std::move(text));
  }
}

}  // namespace

std::vector<std::string> decision(const MatchSection& section) {
  MatchSection kept = section;
  std::erase_if(kept.series,
                [&](const MatchSeries& series) { return has_limit_cycle(section, series); });
  std::string motors = decide_motors(section);
  Sentences sentences =
      decide_inertia(kept, kept.series.size() < section.series.size(), !motors.empty());
  if (!motors.empty()) sentences.insert(sentences.begin(), std::move(motors));
  if (section.tuned_as_built) {
    sentences.insert(sentences.begin(),
                     recommended_first(*section.tuned_as_built, "Recommended as built"));
    add_ties(*section.tuned_as_built, recommended_tuned_controller(*section.tuned_as_built),
             sentences);
  }
  for (const auto& series : section.series) {
    if (!series.best || !has_limit_cycle(section, series) || kept.series.empty()) continue;
    const auto runs = limit_cycle_of(section, series);
    sentences.push_back(fmt::format(
        "Not {}, {:.3f} mdeg on the linear plant: on the nonlinear antenna it {}.", series.name,
        mdeg(series.values[*series.best].boresight_rms),
        limit_cycle_beyond(section, runs)
            ? fmt::format("limit-cycles by +-{:.2f} mdeg, beyond the allowed +-{:.3f} mdeg",
                          mdeg(design::limit_cycle_amplitude(runs)),
                          mdeg(section.allowed_limit_cycle))
            : std::string("is not shown free of limit cycles, as a run did not complete")));
  }
  return sentences;
}

namespace {

// The eligible candidates that tie with the best, it included, where there are others.
std::vector<std::string> ties_of(const EvaluateSection& section,
                                 const DecisionSection& random_samples) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < random_samples.tied.size(); ++i) {
    if (random_samples.tied[i])
      names.push_back(section.candidates[random_samples.candidates[i].candidate].name);
  }
  if (names.size() < 2) names.clear();
  return names;
}

// Whether every eligible candidate is among them.
bool all_alike(const EvaluateSection& section, const std::vector<std::string>& ties) {
  const auto eligible = std::ranges::count_if(section.candidates, &Candidate::feasible);
  return !ties.empty() && static_cast<std::ptrdiff_t>(ties.size()) == eligible;
}

// What makes a tie of two simulated or two linear rms.
std::string tie_rule(const EvaluateSection& section) {
  return fmt::format(
      "{:.0f} %{}", 100.0 * negligible_change,
      section.time_domain ? " or the 95 % interval of the difference over the same winds" : "");
}

}  // namespace

std::vector<std::string> decision(const EvaluateSection& section) {
  Sentences sentences = unmet_needs(section);
  const std::string none = none_chosen(section);
  if (section.decision && !section.candidates.empty()) {
    const DecisionSection& random_samples = *section.decision;
    const std::size_t choice = random_samples.worth;
    const auto& place = random_samples.candidates[choice];
    const Candidate& chosen = section.candidates[place.candidate];
    const Candidate& best =
        section.candidates[random_samples.candidates[random_samples.best].candidate];
    const std::string currency = section.currency.empty() ? "of cost" : section.currency;
    const auto& ranking = random_samples.ranking;
    const std::string mean = fmt::format(
        "{:.3f} mdeg rms {} {} {} samples in {:.3g} m/s, {}", ranking.losses[choice],
        measure_phrase(ranking.measure),
        ranking.measure == design::LossMeasure::mean ? "over" : "of", random_samples.random_samples,
        section.wind_speed, section.time_domain ? "simulated" : "linear");
    const bool fit = chosen.feasible();
    const std::string yet = none.empty() ? "Choose nothing yet." : none;
    std::string text =
        !fit            ? fmt::format("{} {} comes nearest with {}, but {}", yet, chosen.name, mean,
                                      why_not(chosen))
        : !none.empty() ? fmt::format("{} The antenna as it is has {}", none, mean)
        : chosen.path.empty()
            ? fmt::format("No proposal is worth its cost: the antenna as it is has {}", mean)
            : fmt::format("Choose {}: {}, {}", chosen.name, mean,
                          chosen.cost ? fmt::format("at {:g} {}", *chosen.cost, currency)
                                      : std::string("at a cost that its file does not state"));
    if (fit && choice != random_samples.best && best.feasible()) {
      text +=
          fmt::format("; {} would be only {:.1f} % better{}", best.name,
                      100.0 * (1.0 - ranking.losses[random_samples.best] / ranking.losses[choice]),
                      best.cost ? fmt::format(" for {:g} {}", *best.cost, currency) : "");
    }
    sentences.push_back(text + ".");
    const auto limit_cycles = limit_cycle_candidates(section);
    if (none.empty() && !limit_cycles.empty()) {
      sentences.push_back(
          fmt::format("Excluded, as they limit-cycle beyond the allowed amplitude: {}.",
                      fmt::join(limit_cycles, ", ")));
    }
    const std::string name = chosen.path.empty() ? "The antenna as it is" : chosen.name;
    const auto ties = ties_of(section, random_samples);
    if (all_alike(section, ties)) {
      sentences.push_back(
          fmt::format("All eligible proposals tie, within {}: choose by their "
                      "other effects.",
                      tie_rule(section)));
    } else if (!ties.empty()) {
      sentences.push_back(
          fmt::format("A tie, within {}: {}.", tie_rule(section), fmt::join(ties, ", ")));
    }
    if (fit) {
      sentences.push_back(
          fmt::format("{} violates a constraint on a fraction of {:.3f} of the samples.", name,
                      place.outside_goals.value));
    }
    if (auto cause = controller_or_hardware(section, random_samples, choice);
        fit && !cause.empty()) {
      sentences.push_back(std::move(cause));
    }
  } else if (section.candidates.size() == 1 && section.candidates.front().chosen) {
    const Candidate& only = section.candidates.front();
    const CandidateController& controller = only.controllers[*only.chosen];
    if (!std::isfinite(controller.compared_rms())) return sentences;
    sentences.push_back(
        fmt::format("No proposal to compare: {} has {:.3f} mdeg rms over {} plant models in "
                    "{:.3g} m/s with {} (robust){}.",
                    only.path.empty() ? "the antenna " + only.name : only.name,
                    mdeg(controller.compared_rms()), section.ensemble_size, section.wind_speed,
                    controller.structure, controller.usable() ? "" : ", which is not eligible"));
  }
  std::string front;
  bool has_proposals = false;
  double before = HUGE_VAL;
  for (const std::size_t i : section.front) {
    const Candidate& candidate = section.candidates[i];
    const CandidateController* controller = candidate.chosen_controller();
    if (controller == nullptr || controller->compared_rms() > (1.0 - negligible_change) * before)
      continue;
    before = controller->compared_rms();
    if (!candidate.cost) continue;
    has_proposals = has_proposals || !candidate.path.empty();
    front += fmt::format("{}{} ({:g} {}, {:.3f} mdeg)", front.empty() ? "" : ", ", candidate.name,
                         *candidate.cost, section.currency, mdeg(controller->compared_rms()));
  }
  if (has_proposals) {
    sentences.push_back(
        fmt::format("Pareto front, each at least {:.0f} % better than all cheaper ones: {}.",
                    100.0 * negligible_change, front));
  }
  return sentences;
}

std::vector<std::string> decision(const TuneSection& section,
                                  const std::optional<TimeDomainSection>& time_domain,
                                  const std::optional<design::PointingLimit>& limit) {
  const TunedController* best = best_controller(section);
  Sentences sentences{recommended_first(section)};
  std::ranges::move(unstable_now(section), std::back_inserter(sentences));
  if (best == nullptr) {
    sentences.emplace_back("No tuned controller meets the constraints of this case.");
    return sentences;
  }
  std::string text =
      fmt::format("On the linear plant {} is best, with {:.3f} mdeg rms in {:.3g} m/s, {}",
                  best->structure, mdeg(best->boresight_rms), best->wind_speed,
                  best->tuned_for == TunedFor::robust
                      ? fmt::format("constraints met on each of {} plants", section.ensemble_size)
                      : std::string("constraints met on the nominal plant only"));
  const TunedController* recommended = recommended_tuned_controller(section);
  if (!section.budgets.empty() && recommended != nullptr && !recommended->speed_limits.empty()) {
    const double by_wind = recommended->speed_limits.front();
    const double limit_speed = std::min(by_wind, section.torque_limited_wind_speed);
    text += fmt::format(
        "; {} meets {} ({}) up to {}{}{}",
        recommended == best
            ? std::string("it")
            : fmt::format("{}, the recommended controller,", name_and_purpose(*recommended)),
        section.budgets.front().name, section.budgets.front().band,
        std::isfinite(limit_speed) ? fmt::format("{:.1f} m/s", limit_speed)
                                   : std::string("the 60 m/s studied"),
        dish_and_mast(section.wind_mast, limit_speed), climate_text(section.climate, limit_speed));
    if (limit_speed < by_wind) {
      text += ", where the mean wind takes all supply torque that friction and offset leave";
    }
  }
  text += '.';
  for (const auto& shortfall : section.shortfalls) {
    text += fmt::format(" NOT MET: {}", shortfall.infeasible);
  }
  sentences.push_back(std::move(text));
  if (!time_domain) {
    sentences.emplace_back(
        "Friction, limit cycles and slewing were not examined: add a [simulation] to the case.");
  } else {
    if (auto others = decide(*time_domain); !others.empty()) {
      sentences.push_back(std::move(others));
    }
  }
  add_ties(section, recommended, sentences);
  if (limit && limit->min_rms > 0.0) {
    sentences.push_back(
        fmt::format("Lower bound with these sensors, sampling and control effort: {:.3f} mdeg on "
                    "the nominal plant; less requires other hardware.",
                    mdeg(limit->min_rms)));
  }
  return sentences;
}

}  // namespace boresight::app
