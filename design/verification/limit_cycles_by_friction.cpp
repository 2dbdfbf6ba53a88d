#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/design/verification/limit_cycles_by_friction.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

void scale_torques(plant::FrictionCurve& curve, double factor) {
  curve.coulomb_torque *= factor;
  curve.breakaway_torque *= factor;
  curve.saturating_torque *= factor;
}

}  // namespace

std::vector<FrictionVariation> friction_variations(const plant::MotorFriction& stated) {
  if (!(plant::dry_friction(stated.curve, 0.0).value > 0.0)) return {};
  std::vector<FrictionVariation> variations{
      {"friction torques x 0.7", stated},
      {"friction torques x 1.3", stated},
      {"breakaway torque x 1.3, Stribeck rate x 0.5", stated},
      {"Stribeck rate x 2, bristle stiffness x 0.3", stated},
  };
  scale_torques(variations[0].friction.curve, 0.7);
  scale_torques(variations[1].friction.curve, 1.3);
  variations[2].friction.curve.breakaway_torque *= 1.3;
  variations[2].friction.curve.stribeck_rate *= 0.5;
  variations[3].friction.curve.stribeck_rate *= 2.0;
  variations[3].friction.bristle_stiffness *= 0.3;
  return variations;
}

std::vector<LimitCyclesWithFriction> limit_cycles_by_friction(
    const SimulatedLoop& loop, std::span<const FrictionVariation> frictions,
    const NonlinearVerificationOptions& options) {
  std::vector<double> rates{0.0};
  if (options.tracking_rate != 0.0) rates.push_back(options.tracking_rate);
  std::vector<SimulatedLoop> loops;
  std::vector<LimitCyclesWithFriction> result;
  for (const FrictionVariation& one : frictions) {
    loops.push_back(loop);
    loops.back().antenna.friction = one.friction;
    loops.back().stated_friction = loop.stated_friction.value_or(loop.antenna.friction.curve);
    for (const double rate : rates) result.push_back({one.name, rate});
  }
  std::vector<LimitCycleResult> runs(result.size() * limit_cycle_starts);
  numerics::for_each_index(runs.size(), options.threads, [&](std::size_t i) {
    const std::size_t place = i / limit_cycle_starts;
    runs[i] = confirmed_limit_cycle_run(loops[place / rates.size()], options, result[place].rate,
                                        i % limit_cycle_starts);
  });
  for (std::size_t i = 0; i < runs.size(); ++i) {
    LimitCyclesWithFriction& of = result[i / limit_cycle_starts];
    const bool complete = runs[i].status == RunStatus::complete;
    ++of.starts;
    if (!complete || runs[i].limit_cycle) ++of.limit_cycles;
    of.encoder_amplitude = complete && !std::isnan(of.encoder_amplitude)
                               ? std::max(of.encoder_amplitude, runs[i].encoder_amplitude)
                               : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

}  // namespace boresight::design
