#pragma once

#include <vector>

#include <boresight/identification/impulse/impulse_momentum.hpp>

namespace boresight::identification {

/// The Monte Carlo of impulse_momentum: one set of instrument and friction samples, common to all
/// estimates.
class ImpulseSamples {
 public:
  /// Samples from the friction tests found so far; keeps references to its arguments.
  ImpulseSamples(const Campaign& campaign, const ImpulseMomentumOptions& options,
                 const ImpulseMomentum& tests);

  /// Whether the tests allow a treatment.
  bool has(FrictionTreatment treatment) const;

  /// Inertia from windows, with intervals and fractions of variance.
  ImpulseEstimate estimate(WindowRule rule, FrictionTreatment treatment,
                           const std::vector<ImpulseWindow>& windows) const;

  /// The friction curve's own estimate of the inertia; without a curve only a name.
  ImpulseEstimate whole_records() const;

 private:
  struct Sources;
  ImpulseFriction friction(FrictionTreatment treatment, const Sources& on, int draw) const;
  std::vector<std::vector<WindowImpulse>> variants(WindowRule rule,
                                                   const std::vector<ImpulseWindow>& windows) const;
  WindowImpulse measure(WindowRule rule, const ImpulseWindow& source) const;
  double window_scatter(const std::vector<WindowImpulse>& windows, ImpulsePooling pooling,
                        const ImpulseFriction& friction, double jerk_inertia, double inertia) const;

  const Campaign* campaign_;
  const ImpulseMomentumOptions* options_;
  const ImpulseMomentum* tests_;
  double torque_per_pressure_;
  numerics::Uncertain jerk_inertia_;
  Eigen::MatrixXd factor_;
  std::vector<InstrumentErrors> errors_;
};

}  // namespace boresight::identification
