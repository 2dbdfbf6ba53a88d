#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/matching_verdict.hpp>

namespace boresight::app {
namespace {

std::string per_cent(double fraction) {
  return fmt::format("{:+.1f} %", 100.0 * fraction);
}

std::optional<std::size_t> marked(const MatchSection& section, bool MatchPoint::*which) {
  const auto point = std::ranges::find_if(section.points, which);
  if (point == section.points.end()) return std::nullopt;
  return static_cast<std::size_t>(point - section.points.begin());
}

std::string feedback_of(const MatchSeries& series) {
  const bool pressure = series.curve.structure.has(control::LoopPath::pressure);
  const bool compliance = series.curve.structure.has(control::LoopPath::compliance);
  if (pressure && compliance) return "pressure feedback and compliance compensation";
  if (pressure) return "pressure feedback";
  if (compliance) return "compliance compensation";
  return "no torque feedback";
}

// Inertias as good beyond the flat range; empty without one.
std::string elsewhere(const MatchSection& section, const MatchSeries& series) {
  constexpr std::size_t maximum = 3;
  auto disks = as_good_elsewhere(section, series);
  if (disks.empty()) return "";
  const std::size_t more = disks.size() > maximum ? disks.size() - maximum : 0;
  disks.resize(disks.size() - more);
  std::vector<std::string> named;
  for (const double at : disks) named.push_back(fmt::format("{:.3g}", at));
  return fmt::format("; {} disks{} within 1 % too", fmt::join(named, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string best_of(const MatchSection& section, const MatchSeries& series) {
  const std::size_t best = series.best.value_or(0);
  const double minimum = series.values[best].boresight_rms;
  std::string text = fmt::format(
      "With {} ({}) the minimum rms is {:.4f} mdeg at {:.3g} disks (R = {:.2f}){}; within 1 % of "
      "it from {:.1f} to {:.1f} disks, within 5 % from {:.1f} to {:.1f}{}.",
      series.name, feedback_of(series), minimum / millidegree, section.points[best].disks,
      section.points[best].motor_to_load_ratio,
      series.best_at_end ? ", an end of the range studied" : "", series.within_1_percent.lowest,
      series.within_1_percent.highest, series.within_5_percent.lowest,
      series.within_5_percent.highest, elsewhere(section, series));
  const auto at = [&](bool MatchPoint::*which, const char* words) {
    const auto point = marked(section, which);
    if (!point || !series.values[*point].found) return;
    text += fmt::format(" {} costs {}.", words,
                        per_cent(series.values[*point].boresight_rms / minimum - 1.0));
  };
  at(&MatchPoint::as_built, "As built");
  at(&MatchPoint::unit_ratio, "One to one");
  return text;
}

// Structures excluded because they limit-cycle.
void conclude_limit_cycles(const MatchSection& section, std::vector<std::string>& sentences) {
  const std::size_t built = as_built(section);
  std::vector<std::string> as_they_are, with_best, unseen;
  for (const auto& series : section.series) {
    if (!series.best) continue;
    bool seen = true;
    const auto look = [&](std::size_t point, std::vector<std::string>& list, std::string_view at) {
      const auto& run = series.values[point].time_domain;
      if (!run || !has_limit_cycle_at(section, series, point)) return;
      if (limit_cycle_beyond(section, run->limit_cycles)) {
        list.push_back(fmt::format("{} (+-{:.2f} mdeg{})", series.name,
                                   design::limit_cycle_amplitude(run->limit_cycles) / millidegree,
                                   at));
      } else {
        seen = false;
      }
    };
    look(built, as_they_are, "");
    if (const std::size_t best = limit_cycle_point(section, series); best != built) {
      look(best, with_best, fmt::format(" at {:.3g} disks", section.points[best].disks));
    }
    if (!seen) unseen.push_back(series.name);
  }
  std::vector<std::string> places;
  if (!as_they_are.empty()) {
    places.push_back(fmt::format("as built {}", fmt::join(as_they_are, ", ")));
  }
  if (!with_best.empty()) {
    places.push_back(fmt::format("with its best motors {}", fmt::join(with_best, ", ")));
  }
  std::vector<std::string> reasons;
  if (!places.empty()) {
    reasons.push_back(
        fmt::format("On the nonlinear antenna these limit-cycle beyond the allowed "
                    "boresight amplitude of +-{:.3f} mdeg: {}.",
                    section.allowed_limit_cycle / millidegree, fmt::join(places, "; ")));
  }
  if (!unseen.empty()) {
    reasons.push_back(
        fmt::format("Freedom from limit cycles is not shown for {}: a run on the nonlinear antenna "
                    "did not complete.",
                    fmt::join(unseen, ", ")));
  }
  if (reasons.empty()) return;
  sentences.push_back(
      fmt::format("{} They are excluded from the comparisons of inertia, structures and rules.",
                  fmt::join(reasons, " ")));
}

// Effect of the inertia on a structure against that of the structure at one inertia.
void conclude_weight(const MatchSection& section, std::vector<std::string>& sentences) {
  const MatchSeries* maximum = most_moved(section);
  if (maximum == nullptr) {
    if (std::ranges::any_of(section.series,
                            [](const auto& series) { return series.best.has_value(); })) {
      sentences.emplace_back(
          "No structure that meets the constraints is shown free of limit cycles beyond the "
          "allowed amplitude: examine friction before the motors.");
    }
    return;
  }
  const double widest = span_of(*maximum);
  if (hardly_matters(section)) {
    sentences.push_back(
        fmt::format("Over all inertias studied no structure's rms changes by more than {:.1f} %: "
                    "the motors' inertia hardly matters here.{}",
                    100.0 * widest, what_matters_more(section)));
    return;
  }
  const design::StructuresAsBuilt built = structures_as_built(section);
  if (built.count == 0 || !marked(section, &MatchPoint::as_built)) return;
  if (built.minimum == built.largest) {
    sentences.push_back(fmt::format(
        "Over all inertias studied the rms changes most with {}, by {:.0f} %; the effect of "
        "another structure at the inertia as built is not known from this study.",
        maximum->name, 100.0 * widest));
    return;
  }
  sentences.push_back(fmt::format(
      "Over all inertias studied the rms changes most with {}, by {:.0f} %; at the inertia as "
      "built the choice of structure changes it by {:.0f} % ({} against {}): {} matters more.",
      maximum->name, 100.0 * widest, 100.0 * built.change, built.minimum->name, built.largest->name,
      built.change > widest ? "the structure" : "the inertia"));
}

void conclude_variants(const MatchSection& section, std::vector<std::string>& sentences) {
  for (const auto& variants : section.variants) {
    std::string moved;
    const auto& own = variants.variants.front();
    if (!own.best || !is_eligible(section, variants.structure)) continue;
    for (const auto& variant : variants.variants) {
      if (!variant.best) {
        moved += fmt::format("; with {} no controller meets the constraints", name_of(variant));
        continue;
      }
      const double now = variant.rms[*variant.best];
      const double kept = variant.rms[*own.best];
      if (std::isfinite(kept) && kept / now - 1.0 < negligible_change) continue;
      moved += fmt::format("; with {} it is at {:.3g} disks", name_of(variant),
                           variants.disks[*variant.best]);
    }
    sentences.push_back(fmt::format(
        "With {}, tuned on single plants, the minimum rms is at {:.3g} disks{}{}.",
        variants.structure, variants.disks[*own.best], moved,
        moved.empty() ? fmt::format(", and no variant makes that more than {:.0f} % worse than its "
                                    "own best",
                                    100.0 * negligible_change)
                      : ""));
  }
  for (const auto& one : section.thresholds) {
    if (!is_eligible(section, one.structure)) continue;
    const std::string at_tracking =
        one_friction(section)
            ? ""
            : fmt::format(", {:.0f} % with the {:.3g} of the friction curve at the tracking rate",
                          100.0 * one.spread_at_tracking, section.tracking_friction);
    const std::string told = fmt::format(
        "({:.0f} % between the best and the worst number of disks with the linear plant's {:.3g} "
        "N.m.s/rad{}; tuned on single plants)",
        100.0 * one.spread_at_nominal, section.friction, at_tracking);
    if (one.slope && one.spread_at_nominal < one.spread) {
      sentences.push_back(
          fmt::format("With {}, the inertia matters less than {:.0f} % already with the friction "
                      "slope of the linear plant {}.",
                      one.structure, 100.0 * one.spread, told));
    } else if (one.slope) {
      sentences.push_back(
          fmt::format("With {}, if the friction slope at the tracking speed exceeds {:.3g} "
                      "N.m.s/rad at the motors, the inertia matters less than {:.0f} % {}.",
                      one.structure, *one.slope, 100.0 * one.spread, told));
    } else {
      sentences.push_back(
          fmt::format("With {}, no friction slope up to {:.3g} N.m.s/rad at the motors makes the "
                      "inertia matter less than {:.0f} % {}.",
                      one.structure, one.searched_to, 100.0 * one.spread, told));
    }
  }
}

void conclude_rules(const MatchSection& section, std::vector<std::string>& sentences) {
  const bool optimum = has_optimum(section);
  for (const auto& rule : section.rules) {
    if (hardly_matters(section)) break;
    if (!rule.disks) {
      sentences.push_back(fmt::format(
          "The rule \"{}\" requires R = {:.2f}, less than the motors have without flywheels.",
          text_of(rule.rule), rule.motor_to_load_ratio));
      continue;
    }
    const design::RuleCosts costs = costs_of(section, rule);
    if (costs.cheapest == nullptr) continue;
    const bool one = costs.cheapest == costs.dearest;
    std::string verdict = one ? "no good rule here" : "no rule for every structure here";
    if (costs.largest < negligible_change) {
      verdict = optimum ? "a good rule here"
                        : "it costs little, but the minimum is at the upper end of the range "
                          "studied: not confirmed";
    }
    sentences.push_back(fmt::format(
        "The rule \"{}\" (R = {:.2f}, {:.1f} disks) costs {} of rms with {}{}, against {} own "
        "best: {}.",
        text_of(rule.rule), rule.motor_to_load_ratio, *rule.disks, per_cent(costs.minimum),
        costs.cheapest->name,
        one ? "" : fmt::format(" and {} with {}", per_cent(costs.largest), costs.dearest->name),
        one ? "its" : "each structure's", verdict));
  }
  const auto built = marked(section, &MatchPoint::as_built);
  if (!built) return;
  const auto& now = section.points[*built];
  const auto& bare = section.points.front();
  if (!(now.acceleration > 0.0) || bare.disks >= now.disks) return;
  sentences.push_back(fmt::format(
      "At this gear ratio less inertia gives more acceleration: without flywheels {:.2f} times "
      "that as built. Over the gear ratio, the maximum for given torque is at R = 1; as built the "
      "motors reach {:.0f} % of it, without flywheels {:.0f} %.",
      bare.acceleration / now.acceleration, 100.0 * now.acceleration_of_best_ratio,
      100.0 * bare.acceleration_of_best_ratio));
}

// Inertias at which a structure limit-cycles; empty without one.
std::string limit_cycle_at(const MatchSection& section, const MatchSeries& series) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const auto& run = series.values[i].time_domain;
    if (!run) continue;
    std::vector<std::string> rates;
    for (const auto& one : run->limit_cycles) {
      if (!one.limit_cycle || one.status != design::RunStatus::complete) continue;
      rates.emplace_back(one.rate == 0.0 ? "at rest" : "at the tracking rate");
    }
    if (rates.empty()) continue;
    places.push_back(
        fmt::format("{:.3g} disks {}", section.points[i].disks, fmt::join(rates, " and ")));
  }
  return fmt::format("{}", fmt::join(places, ", "));
}

void conclude_friction(const MatchSection& section, std::vector<std::string>& sentences) {
  std::vector<std::string> errors;
  std::set<double> disks;                                 // where a reversal was simulated
  std::map<std::string, std::vector<std::string>> alike;  // structures by their limit cycles
  for (const auto& series : section.series) {
    double minimum = HUGE_VAL, largest = 0.0;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const auto& run = series.values[i].time_domain;
      if (!run) continue;
      const auto& reversal = run->reversal;
      if (!reversal || reversal->status != design::RunStatus::complete) continue;
      disks.insert(section.points[i].disks);
      minimum = std::min(minimum, reversal->boresight_error);
      largest = std::max(largest, reversal->boresight_error);
    }
    if (!(largest > 0.0)) continue;
    errors.push_back(fmt::format("{:.2f} to {:.2f} mdeg with {}", minimum / millidegree,
                                 largest / millidegree, series.name));
    alike[limit_cycle_at(section, series)].push_back(series.name);
  }
  if (errors.empty()) return;
  std::vector<std::string> cycles;
  for (const auto& [places, names] : alike) {
    cycles.push_back(
        fmt::format("{} with {}", places.empty() ? "none seen" : places, fmt::join(names, ", ")));
  }
  sentences.push_back(
      fmt::format("Peak boresight error at a velocity reversal at the tracking rate of {:.4g} "
                  "mdeg/s, over the inertias simulated ({}): {}. Limit cycles: {}.",
                  section.tracking_rate / millidegree,
                  disks.size() == 1 ? fmt::format("{:.3g} disks", *disks.begin())
                                    : fmt::format("{} from {:.3g} to {:.3g} disks", disks.size(),
                                                  *disks.begin(), *disks.rbegin()),
                  fmt::join(errors, ", "), fmt::join(cycles, "; ")));
}

// The controller for the motors as built; empty where it was not asked for.
std::string recommended_as_built(const MatchSection& section) {
  if (!section.tuned_as_built) return "";
  const TunedController* controller = recommended_tuned_controller(*section.tuned_as_built);
  if (controller == nullptr) {
    return "For the motors as built no controller is recommended: `boresight tune` says why.";
  }
  return fmt::format(
      "For the motors as built the recommended controller is {}: {:.4f} mdeg rms in {:.3g} m/s, "
      "linear{}.",
      name_and_purpose(*controller), controller->boresight_rms / millidegree,
      controller->wind_speed,
      controller->in_time ? fmt::format(", {:.4f} on the nonlinear antenna",
                                        controller->in_time->rms() / millidegree)
                          : "");
}

}  // namespace

std::string what_matters_more(const MatchSection& section) {
  Influences influences;
  influences.add(structures_as_built(section).change, "the loop structure");
  for (const auto& one : variant_changes(section)) {
    influences.add(one.change, fmt::format("'{}' with {}", one.variant, one.structure));
  }
  return influences.sentence();
}

std::vector<std::string> conclude(const MatchSection& section) {
  std::vector<std::string> sentences;
  if (section.wind_mast) sentences.push_back(conclude_mast(*section.wind_mast));
  sentences.push_back(
      fmt::format("Conditions: {} wind model, {:.3g} m/s; all constraints met on each of {} "
                  "plants. Results scale with the assumed inputs.",
                  plant::to_string(section.wind_model), section.wind_speed,
                  std::max<std::size_t>(section.members, 1)));
  if (std::string text = recommended_as_built(section); !text.empty()) sentences.push_back(text);
  for (const auto& series : section.series) {
    if (series.best) {
      sentences.push_back(best_of(section, series));
    } else {
      sentences.push_back(fmt::format(
          "No controller of {} found meets the constraints at any inertia.", series.name));
    }
  }
  conclude_limit_cycles(section, sentences);
  conclude_weight(section, sentences);
  conclude_rules(section, sentences);
  conclude_variants(section, sentences);
  conclude_friction(section, sentences);
  return sentences;
}

}  // namespace boresight::app
