#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/match/match_study.hpp>
#include <boresight/app/match/match_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// One thing that is not as the case has it.
struct Change {
  std::string name;
  std::vector<plant::AntennaChange> antenna = {};
  std::optional<plant::WindModel> wind = std::nullopt;
};

std::vector<Change> changes_of(const io::Case& antenna, const MatchSection& section) {
  std::vector<Change> changes{{"the case's plant", {}, {}},
                              {"leakage x 0.3", {plant::scaled_by("drive.leakage_rate", 0.3)}, {}},
                              {"leakage x 2", {plant::scaled_by("drive.leakage_rate", 2.0)}, {}}};
  if (!one_friction(section)) {
    changes.push_back({fmt::format("friction slope {:.3g} N.m.s/rad (at tracking rate)",
                                   section.tracking_friction),
                       {plant::set_to("drive.viscous_friction", section.tracking_friction)},
                       {}});
  }
  changes.insert(
      changes.end(),
      {{"structure frequencies x 0.9", {plant::scaled_by("structure.frequencies", 0.9)}, {}},
       {"structure frequencies x 1.1", {plant::scaled_by("structure.frequencies", 1.1)}, {}},
       {antenna.oil.efficiency_in_stiffness ? "oil stiffness without efficiencies"
                                            : "oil stiffness with efficiencies",
        {plant::set_to("at_shaft.oil_stiffness",
                       oil_stiffness(antenna, antenna.oil.efficiency_in_stiffness
                                                  ? plant::EfficiencyInStiffness::none
                                                  : plant::EfficiencyInStiffness::both))},
        {}}});
  for (const auto& alternative : antenna.antenna.alternatives) {
    changes.push_back(
        {"antenna inertia of " + alternative.name, changes_of(antenna, alternative), {}});
  }
  for (const auto place : io::other_guesses) {
    if (!moves_guessed_shares(antenna.structure, place)) continue;
    changes.push_back(
        {std::string(to_string(place)), guessed_share_changes(antenna.structure, place), {}});
  }
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    if (model == section.wind_model) continue;
    changes.push_back({fmt::format("wind model {}", plant::to_string(model)), {}, model});
  }
  return changes;
}

// Rms at the sky along some disks, tuned on single plants.
std::vector<double> curve_of(const io::Case& antenna, const MatchSection& section,
                             const MatchOptions& options, const control::LoopStructure& structure,
                             const std::vector<double>& disks, const Change& change) {
  design::MatchingTask task;
  task.problem = make_problem(antenna, change.antenna);
  if (change.wind) task.problem.wind.model = *change.wind;
  task.structures = {structure};
  task.goals = section.goals;
  for (const double count : disks) {
    auto changes = change.antenna;
    changes.push_back(plant::set_to("motor.flywheel_disks", count));
    task.motor_inertia.push_back(make_plant(antenna, changes).drive.motor_inertia);
  }
  design::MatchingOptions how;
  how.starts = options.starts;
  how.seed = options.seed;
  how.threads = options.threads;
  how.stop = options.interrupted;
  const auto curves = design::match_motors(task, how);
  std::vector<double> rms;
  for (const auto& law : curves.curves.front().laws) {
    const bool met = law.status == design::TuningStatus::optimal;
    rms.push_back(met ? law.soft_rms / task.problem.gear_ratio : nan);
  }
  return rms;
}

// The largest over the least, less 1; NaN with a gap.
double spread_of(const std::vector<double>& rms) {
  if (std::ranges::any_of(rms, [](double value) { return !std::isfinite(value); })) return nan;
  const auto [least, largest] = std::ranges::minmax(rms);
  return largest / least - 1.0;
}

// The slope at which the spread falls below what counts, on the way up from the case's: by
// doubling, then bisection in its logarithm to 2 %.
FrictionThreshold find_threshold(const MatchSection& section, const MatchSeries& series,
                                 const std::function<double(double)>& spread_at) {
  FrictionThreshold threshold;
  threshold.structure = series.name;
  threshold.spread_at_nominal = spread_at(section.friction);
  threshold.spread_at_tracking = spread_at(section.tracking_friction);
  const auto small = [&](double slope) { return spread_at(slope) < threshold.spread; };
  constexpr double most = 300.0;
  double low = std::max(section.friction, 0.5), high = low;
  threshold.searched_to = most;
  if (small(low)) {
    threshold.slope = section.friction;
    return threshold;
  }
  while (high < most) {
    high = std::min(2.0 * high, most);
    if (small(high)) break;
    low = high;
  }
  if (low == high) return threshold;
  while (high > 1.02 * low) {
    const double middle = std::sqrt(low * high);
    (small(middle) ? high : low) = middle;
  }
  threshold.slope = high;
  return threshold;
}

bool leads(const control::LoopStructure& structure) {
  return std::ranges::any_of(
      structure.blocks(), [](const auto& block) { return block.kind == control::BlockKind::lead; });
}

// The structure recommended, and the same of the plain PI loops, without lead and torque feedback.
std::vector<const MatchSeries*> worth_varying(const MatchSection& section) {
  const auto plain = [](const MatchSeries& series) {
    const auto& structure = series.curve.structure;
    return !structure.has(control::LoopPath::pressure) &&
           !structure.has(control::LoopPath::compliance) && !leads(structure);
  };
  const bool some = most_moved(section) != nullptr;
  const auto counts = [&](const MatchSeries& series) { return !some || weighed(section, series); };
  const MatchSeries* best = recommended_structure(section, counts);
  const MatchSeries* best_pi = recommended_structure(
      section, [&](const MatchSeries& series) { return counts(series) && plain(series); });
  std::vector<const MatchSeries*> chosen;
  if (best_pi != nullptr) chosen.push_back(best_pi);
  if (best != nullptr && best != best_pi) chosen.push_back(best);
  return chosen;
}

}  // namespace

void vary(const io::Case& antenna, const MatchOptions& options, MatchSection& section) {
  constexpr int coarse = 7;
  std::vector<double> disks;
  const double most = section.points.back().disks;
  for (int i = 0; i < coarse; ++i) disks.push_back(most * i / (coarse - 1));
  const auto changes = changes_of(antenna, section);
  const auto chosen = worth_varying(section);
  const std::size_t all = chosen.size() * (changes.size() + 1);
  std::size_t done = 0;
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  const auto step = [&] {
    ++done;
    if (options.progress) options.progress("varying", done, all);
  };
  for (const MatchSeries* series : chosen) {
    MatchVariants variants{series->name, disks, {}};
    for (const auto& change : changes) {
      MatchVariant variant{change.name, {}, {}, {}};
      variant.rms = curve_of(antenna, section, options, series->curve.structure, disks, change);
      if (stopped()) return;
      variant.best = least_of(variant.rms);
      variant.within_5_percent = flat_range(disks, variant.rms, 0.05);
      variants.variants.push_back(std::move(variant));
      step();
    }
    const std::vector<double> few{0.0, most / 4.0, most / 2.0, most};
    auto threshold = find_threshold(section, *series, [&](double slope) {
      return spread_of(curve_of(antenna, section, options, series->curve.structure, few,
                                {"", {plant::set_to("drive.viscous_friction", slope)}, {}}));
    });
    if (stopped()) return;
    section.variants.push_back(std::move(variants));
    section.thresholds.push_back(std::move(threshold));
    step();
  }
}

std::vector<RuleVerdict> judge_rules(const io::Case& antenna, const MatchSection& section) {
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  const auto disks_at = [&](double ratio) { return disks_at_unit_ratio(antenna, ratio * load); };
  std::vector<RuleVerdict> rules{
      {"one to one: motors as heavy as their load", 1.0, disks_at(1.0), {}},
      {"equal pole pairs, zeta = 1/2 sqrt(J_L/J_m) = 0.71", 0.5, disks_at(0.5), {}},
      {"equal pole pairs, zeta = 1/2 sqrt(J_L/J_m) = 1", 0.25, disks_at(0.25), {}},
      {"most acceleration at this gear ratio: no flywheels",
       section.points.front().motor_to_load_ratio,
       0.0,
       {}}};
  for (auto& rule : rules) {
    for (const auto& series : section.series) {
      rule.cost.push_back(nan);
      if (!rule.disks || !series.best || *rule.disks > section.points.back().disks) continue;
      const double least = series.values[*series.best].beam_rms;
      for (std::size_t i = 0; i + 1 < section.points.size(); ++i) {
        const double from = section.points[i].disks, to = section.points[i + 1].disks;
        if (*rule.disks < from || *rule.disks > to) continue;
        const auto& one = series.values[i];
        const auto& other = series.values[i + 1];
        if (!one.found || !other.found) break;
        const double part = (*rule.disks - from) / (to - from);
        rule.cost.back() = std::lerp(one.beam_rms, other.beam_rms, part) / least - 1.0;
        break;
      }
    }
  }
  return rules;
}

}  // namespace boresight::app
