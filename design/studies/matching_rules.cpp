#include <cmath>
#include <limits>

#include <boresight/design/studies/matching_rules.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {

std::vector<RuleVerdict> evaluate_rules(const Mission& mission, const MatchingStudy& study) {
  const plant::Antenna& antenna = mission.antenna;
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  const auto disks_at = [&](double ratio) { return disks_at_unit_ratio(antenna, ratio * load); };
  std::vector<RuleVerdict> rules{
      {ClassicRule::one_to_one, 1.0, disks_at(1.0), {}},
      {ClassicRule::equal_poles_damped_0_7, 0.5, disks_at(0.5), {}},
      {ClassicRule::equal_poles_damped_1, 0.25, disks_at(0.25), {}},
      {ClassicRule::no_flywheels, study.points.front().motor_to_load_ratio, 0.0, {}}};
  for (auto& rule : rules) {
    for (const auto& series : study.series) {
      rule.cost.push_back(std::numeric_limits<double>::quiet_NaN());
      if (!rule.disks || !series.best || *rule.disks > study.points.back().disks) continue;
      const double disks = *rule.disks, minimum = series.values[*series.best].boresight_rms;
      for (std::size_t i = 0; i + 1 < study.points.size(); ++i) {
        const double from = study.points[i].disks, to = study.points[i + 1].disks;
        if (disks < from || disks > to) continue;
        const auto& one = series.values[i];
        const auto& other = series.values[i + 1];
        if (!one.found || !other.found) break;
        const double part = (disks - from) / (to - from);
        rule.cost.back() = std::lerp(one.boresight_rms, other.boresight_rms, part) / minimum - 1.0;
        break;
      }
    }
  }
  return rules;
}

}  // namespace boresight::design
