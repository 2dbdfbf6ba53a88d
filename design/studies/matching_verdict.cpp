#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <boresight/design/decisions/negligible_change.hpp>
#include <boresight/design/decisions/recommend.hpp>
#include <boresight/design/studies/matching_verdict.hpp>
#include <boresight/design/studies/time_domain_study.hpp>

namespace boresight::design {

double span_of(const MatchSeries& series) {
  double minimum = HUGE_VAL, largest = 0.0;
  for (const auto& value : series.values) {
    if (!value.found) continue;
    minimum = std::min(minimum, value.boresight_rms);
    largest = std::max(largest, value.boresight_rms);
  }
  return largest > 0.0 ? largest / minimum - 1.0 : 0.0;
}

bool hardly_matters(const MatchingStudy& study) {
  bool any = false;
  for (const auto& series : study.series) {
    if (!is_eligible(study, series)) continue;
    any = true;
    const bool everywhere = std::ranges::all_of(series.values, &MatchValue::found);
    if (!everywhere || span_of(series) >= negligible_change) return false;
  }
  return any;
}

std::vector<VariantChange> variant_changes(const MatchingStudy& study) {
  std::vector<VariantChange> changes;
  for (const auto& variants : study.variants) {
    const MatchVariant& own = variants.variants.front();
    if (!own.best || !is_eligible(study, variants.structure)) continue;
    const double minimum = own.rms[*own.best];
    for (const auto& variant : variants.variants) {
      if (!variant.best) continue;
      changes.push_back(
          {variant.name, variants.structure, std::abs(variant.rms[*variant.best] / minimum - 1.0)});
    }
  }
  return changes;
}

std::size_t limit_cycle_point(const MatchingStudy& study, const MatchSeries& series) {
  const std::size_t built = as_built(study);
  const std::size_t best = series.best.value_or(built);
  return series.values[best].time_domain ? best : built;
}

std::vector<LimitCycleResult> limit_cycle_of(const MatchingStudy& study,
                                             const MatchSeries& series) {
  const auto& run = series.values[limit_cycle_point(study, series)].time_domain;
  return run ? run->limit_cycles : std::vector<LimitCycleResult>();
}

bool limit_cycle_beyond(const MatchingStudy& study,
                        const std::vector<LimitCycleResult>& limit_cycles) {
  return limit_cycle_amplitude(limit_cycles) > study.allowed_limit_cycle;
}

bool has_limit_cycle_at(const MatchingStudy& study, const MatchSeries& series, std::size_t point) {
  const auto& run = series.values[point].time_domain;
  return run && !is_limit_cycle_free(run->limit_cycles, study.allowed_limit_cycle);
}

bool has_limit_cycle(const MatchingStudy& study, const MatchSeries& series) {
  return has_limit_cycle_at(study, series, limit_cycle_point(study, series));
}

// The span of a structure has its best motors at one end, the comparison of structures those as
// built: a controller with a limit cycle at either has no such rms there.
bool is_eligible(const MatchingStudy& study, const MatchSeries& series) {
  return series.best && !has_limit_cycle(study, series) &&
         !has_limit_cycle_at(study, series, as_built(study));
}

bool is_eligible(const MatchingStudy& study, std::string_view structure) {
  return std::ranges::any_of(study.series, [&](const MatchSeries& series) {
    return series.name == structure && is_eligible(study, series);
  });
}

namespace {

// A structure's controller at a point that meets every constraint, as recommend() compares it, with
// the limit cycles of a point where it ran.
Assessment assessment_of(const MatchSeries& series, std::size_t point, double limit_cycle,
                         const std::vector<LimitCycleResult>& limit_cycles) {
  Assessment candidate;
  candidate.structure = series.name;
  candidate.purpose = DesignPurpose::robust;
  candidate.parts = series.curve.structure.gains().size();
  candidate.stable = candidate.verified = true;
  candidate.nominal_constraints_met = candidate.member_constraints_met = true;
  candidate.linear_rms = series.values[point].boresight_rms;
  if (!limit_cycles.empty()) {
    candidate.limit_cycle_amplitude = limit_cycle_amplitude(limit_cycles);
    candidate.limit_cycles = limit_cycle_verdict(is_limit_cycle_free(limit_cycles, limit_cycle),
                                                 limit_cycle_runs_complete(limit_cycles));
  }
  return candidate;
}

// None where no controller ran in wind at that point, or none of them is to be chosen.
std::optional<RankedMotors> motors_at(const MatchingStudy& study, std::size_t point) {
  std::vector<std::size_t> places;
  std::vector<Assessment> candidates;
  for (std::size_t s = 0; s < study.series.size(); ++s) {
    const MatchValue& value = study.series[s].values[point];
    if (!value.found || !value.time_domain || !value.time_domain->expected) continue;
    const MatchTimeDomain& run = *value.time_domain;
    places.push_back(s);
    candidates.push_back(
        assessment_of(study.series[s], point, study.allowed_limit_cycle, run.limit_cycles));
    candidates.back().expected = run.expected;
    candidates.back().simulated_rms = run.expected->rms.value;
  }
  const auto winner = recommend(candidates).winner;
  if (!winner) return std::nullopt;
  const std::size_t series = places[*winner];
  const double members = study.series[series].values[point].time_domain->member_rms;
  return RankedMotors{point, series, nonlinear_effect(candidates[*winner]).rms(members), false};
}

SimulatedFigure figure_of(const MatchingStudy& study, const RankedMotors& motors) {
  const auto& run = study.series[motors.series].values[motors.point].time_domain;
  return {*run->expected, limit_cycle_amplitude(run->limit_cycles)};
}

}  // namespace

std::vector<RankedMotors> ranked_motors(const MatchingStudy& study) {
  std::vector<RankedMotors> ranked;
  for (std::size_t point = 0; point < study.points.size(); ++point) {
    if (auto motors = motors_at(study, point)) ranked.push_back(*motors);
  }
  std::ranges::stable_sort(ranked, {}, &RankedMotors::compared_rms);
  for (auto& motors : ranked) {
    const double open = left_open(figure_of(study, ranked.front()), figure_of(study, motors));
    motors.tied = motors.compared_rms <=
                  (1.0 + std::max(negligible_change, open)) * ranked.front().compared_rms;
  }
  return ranked;
}

const MatchSeries* recommended_structure(const MatchingStudy& study,
                                         const std::function<bool(const MatchSeries&)>& counts) {
  std::vector<const MatchSeries*> structures;
  std::vector<Assessment> candidates;
  for (const auto& series : study.series) {
    if (!series.best || !counts(series)) continue;
    structures.push_back(&series);
    candidates.push_back(assessment_of(series, *series.best, study.allowed_limit_cycle,
                                       limit_cycle_of(study, series)));
  }
  const auto winner = recommend(candidates, {.accepted = Fitness::limit_cycle}).winner;
  return winner ? structures[*winner] : nullptr;
}

const MatchSeries* most_moved(const MatchingStudy& study) {
  const MatchSeries* maximum = nullptr;
  for (const auto& series : study.series) {
    if (!is_eligible(study, series)) continue;
    if (maximum == nullptr || span_of(series) > span_of(*maximum)) maximum = &series;
  }
  return maximum;
}

StructuresAsBuilt structures_as_built(const MatchingStudy& study) {
  const std::size_t built = as_built(study);
  const auto rms = [&](const MatchSeries& series) { return series.values[built].boresight_rms; };
  StructuresAsBuilt result;
  for (const auto& series : study.series) {
    if (!series.values[built].found || !is_eligible(study, series)) continue;
    ++result.count;
    if (result.minimum == nullptr || rms(series) < rms(*result.minimum)) result.minimum = &series;
    if (result.largest == nullptr || rms(series) > rms(*result.largest)) result.largest = &series;
  }
  if (result.count > 0) result.change = rms(*result.largest) / rms(*result.minimum) - 1.0;
  return result;
}

std::vector<double> as_good_elsewhere(const MatchingStudy& study, const MatchSeries& series) {
  const std::size_t best = series.best.value_or(0);
  const FlatRange& range = series.within_1_percent;
  std::vector<double> disks;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const MatchValue& value = series.values[i];
    const double at = study.points[i].disks;
    if (!value.found || (range.lowest <= at && at <= range.highest)) continue;
    if (value.boresight_rms <= 1.01 * series.values[best].boresight_rms) disks.push_back(at);
  }
  std::ranges::stable_sort(disks, {},
                           [&](double at) { return std::abs(at - study.points[best].disks); });
  return disks;
}

bool has_optimum(const MatchingStudy& study) {
  return std::ranges::any_of(study.series, [&](const MatchSeries& series) {
    return series.best && is_eligible(study, series) && *series.best + 1 < study.points.size() &&
           span_of(series) >= negligible_change;
  });
}

RuleCosts costs_of(const MatchingStudy& study, const RuleVerdict& rule) {
  RuleCosts costs{nullptr, nullptr, HUGE_VAL, -HUGE_VAL};
  for (std::size_t s = 0; s < rule.cost.size(); ++s) {
    const MatchSeries& series = study.series[s];
    if (!std::isfinite(rule.cost[s]) || !is_eligible(study, series)) continue;
    if (rule.cost[s] < costs.minimum) {
      costs.minimum = rule.cost[s];
      costs.cheapest = &series;
    }
    if (rule.cost[s] > costs.largest) {
      costs.largest = rule.cost[s];
      costs.dearest = &series;
    }
  }
  return costs;
}

const FrictionThreshold* deciding_friction(const MatchingStudy& study) {
  const FrictionThreshold* threshold = nullptr;
  const double maximum = 1.5 * std::max(study.friction, study.tracking_friction);
  for (const auto& one : study.thresholds) {
    if (!one.slope || *one.slope > maximum || one.spread_at_nominal < one.spread) continue;
    if (!is_eligible(study, one.structure)) continue;
    if (threshold != nullptr && *one.slope >= threshold->slope) continue;
    threshold = &one;
  }
  return threshold;
}

bool one_friction(const MatchingStudy& study) {
  constexpr double same = 1e-9;
  return std::abs(study.tracking_friction - study.friction) <= same * study.friction;
}

std::size_t as_built(const MatchingStudy& study) {
  const auto point = std::ranges::find_if(study.points, &MatchPoint::as_built);
  return point == study.points.end() ? study.points.size() - 1
                                     : static_cast<std::size_t>(point - study.points.begin());
}

}  // namespace boresight::design
