#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/studies/matching_variants.hpp>
#include <boresight/design/studies/matching_verdict.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// One thing that is not as the mission has it.
struct Change {
  std::string name;
  std::vector<plant::AntennaChange> antenna = {};
  std::optional<plant::WindModel> wind = std::nullopt;
};

std::vector<Change> changes_of(const Mission& mission, const MatchingStudy& study) {
  std::vector<Change> changes{{"", {}, {}},
                              {"leakage x 0.3", {plant::scaled_by("drive.leakage_rate", 0.3)}, {}},
                              {"leakage x 2", {plant::scaled_by("drive.leakage_rate", 2.0)}, {}}};
  if (!one_friction(study)) {
    changes.push_back(
        {fmt::format("friction slope {:.3g} N.m.s/rad (at tracking rate)", study.tracking_friction),
         {plant::set_to("drive.viscous_friction", study.tracking_friction)},
         {}});
  }
  changes.insert(
      changes.end(),
      {{"structure frequencies x 0.9", {plant::scaled_by("structure.frequencies", 0.9)}, {}},
       {"structure frequencies x 1.1", {plant::scaled_by("structure.frequencies", 1.1)}, {}}});
  for (const auto& alternative : mission.alternatives) {
    changes.push_back({alternative.name, alternative.changes, {}});
  }
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    if (model == study.wind_model) continue;
    changes.push_back({fmt::format("wind model {}", plant::to_string(model)), {}, model});
  }
  return changes;
}

// Rms at the sky along some disks, tuned on single plants.
std::vector<double> curve_of(const Mission& mission, const MatchingStudy& study,
                             const MatchOptions& options, const control::LoopStructure& structure,
                             const std::vector<double>& disks, const Change& change) {
  MatchingTask task;
  task.problem = tracking_problem(mission, change.antenna);
  if (change.wind) task.problem.wind.model = *change.wind;
  task.structures = {structure};
  task.goals = study.goals;
  for (const double count : disks) {
    auto changes = change.antenna;
    changes.push_back(plant::set_to("motor.flywheel_disks", count));
    task.motor_inertia.push_back(
        linear_plant(changed(mission.antenna, changes)).drive.motor_inertia);
  }
  MatchingOptions how;
  how.starts = options.starts;
  how.seed = options.seed;
  how.threads = options.threads;
  how.stop = options.interrupted;
  const auto curves = match_motors(task, how);
  std::vector<double> rms;
  for (const auto& controller : curves.curves.front().controllers) {
    const bool met = controller.status == TuningStatus::optimal;
    rms.push_back(met ? controller.soft_rms / task.problem.gear_ratio : nan);
  }
  return rms;
}

// The largest over the least, less 1; NaN with a gap.
double spread_of(const std::vector<double>& rms) {
  if (std::ranges::any_of(rms, [](double value) { return !std::isfinite(value); })) return nan;
  const auto [minimum, largest] = std::ranges::minmax(rms);
  return largest / minimum - 1.0;
}

// The slope at which the spread falls below what counts, on the way up from the mission's: by
// doubling, then bisection in its logarithm to 2 %.
FrictionThreshold find_threshold(const MatchingStudy& study, const MatchSeries& series,
                                 const std::function<double(double)>& spread_at) {
  FrictionThreshold threshold;
  threshold.structure = series.name;
  threshold.spread_at_nominal = spread_at(study.friction);
  threshold.spread_at_tracking = spread_at(study.tracking_friction);
  const auto small = [&](double slope) { return spread_at(slope) < threshold.spread; };
  constexpr double maximum = 300.0;
  double low = std::max(study.friction, 0.5), high = low;
  threshold.searched_to = maximum;
  if (small(low)) {
    threshold.slope = study.friction;
    return threshold;
  }
  while (high < maximum) {
    high = std::min(2.0 * high, maximum);
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
std::vector<const MatchSeries*> worth_varying(const MatchingStudy& study) {
  const auto plain = [](const MatchSeries& series) {
    const auto& structure = series.curve.structure;
    return !structure.has(control::LoopPath::pressure) &&
           !structure.has(control::LoopPath::compliance) && !leads(structure);
  };
  const bool some = most_moved(study) != nullptr;
  const auto counts = [&](const MatchSeries& series) {
    return !some || is_eligible(study, series);
  };
  const MatchSeries* best = recommended_structure(study, counts);
  const MatchSeries* best_pi = recommended_structure(
      study, [&](const MatchSeries& series) { return counts(series) && plain(series); });
  std::vector<const MatchSeries*> chosen;
  if (best_pi != nullptr) chosen.push_back(best_pi);
  if (best != nullptr && best != best_pi) chosen.push_back(best);
  return chosen;
}

}  // namespace

void vary(const Mission& mission, const MatchOptions& options, MatchingStudy& study) {
  constexpr int coarse = 7;
  std::vector<double> disks;
  const double maximum = study.points.back().disks;
  for (int i = 0; i < coarse; ++i) disks.push_back(maximum * i / (coarse - 1));
  const auto changes = changes_of(mission, study);
  const auto chosen = worth_varying(study);
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
      variant.rms = curve_of(mission, study, options, series->curve.structure, disks, change);
      if (stopped()) return;
      variant.best = least_of(variant.rms);
      variant.within_5_percent = flat_range(disks, variant.rms, 0.05);
      variants.variants.push_back(std::move(variant));
      step();
    }
    const std::vector<double> few{0.0, maximum / 4.0, maximum / 2.0, maximum};
    auto threshold = find_threshold(study, *series, [&](double slope) {
      return spread_of(curve_of(mission, study, options, series->curve.structure, few,
                                {"", {plant::set_to("drive.viscous_friction", slope)}, {}}));
    });
    if (stopped()) return;
    study.variants.push_back(std::move(variants));
    study.thresholds.push_back(std::move(threshold));
    step();
  }
}

}  // namespace boresight::design
