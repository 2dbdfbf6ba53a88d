#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// How a run is repeated by a second integrator.
struct IntegratorAgreementOptions {
  double settling = 20.0;  // s at the start that the rms values leave out
  std::uint64_t seed = 1;  // of the sensors' noise
  /// Of the exponential collocation: those of the run that is checked, LoopRunOptions.
  double relative_tolerance = LoopRunOptions{}.relative_tolerance;
  double absolute_tolerance = LoopRunOptions{}.absolute_tolerance;
  /// Of CVODES, of the states: an rms to 1e-6 of itself on the reference antenna.
  double cvodes_relative_tolerance = 1e-7;
  double cvodes_absolute_tolerance = 1e-7;
};

/// One course by two integrators. Both read the same equations (FeedbackSystem), wind, noise and
/// sampled controller; only the integration differs. Angles at the sky, of the beam's error.
struct IntegratorAgreement {
  /// Of the collocation's run or, if that completed, of CVODES'.
  RunStatus status = RunStatus::complete;
  std::string message;    // empty if complete
  double duration = 0.0;  // s compared, after settling
  // NaN for runs that did not complete.
  double collocation_rms = std::numeric_limits<double>::quiet_NaN();  // rad, about the mean
  double cvodes_rms = std::numeric_limits<double>::quiet_NaN();       // rad, about the mean
  /// rad, of the difference sample by sample, its mean included.
  double difference_rms = std::numeric_limits<double>::quiet_NaN();
  double cvodes_relative_tolerance = 0.0;
  double cvodes_absolute_tolerance = 0.0;
  long long collocation_steps = 0;
  long long cvodes_steps = 0;

  /// difference_rms over cvodes_rms; NaN unless complete.
  double ratio() const { return difference_rms / cvodes_rms; }
};

/// Largest ratio() by which a simulated rms counts as integrated right.
inline constexpr double integrator_agreement_limit = 1e-4;
/// Whether both runs completed and agree within that limit.
bool agree(const IntegratorAgreement& agreement);

/// Runs the course by the exponential collocation (FastIntegrator) and, if that completes, by
/// CVODES (OdeIntegrator). A run without a usable end is a stated result. The same calls give the
/// same bits.
/// @throws InvalidInput for a settling time below 0 or not shorter than the course, and as
/// run_loop.
IntegratorAgreement integrator_agreement(const SimulatedLoop& loop, const LoopCourse& course,
                                         const IntegratorAgreementOptions& options = {});

}  // namespace boresight::design
