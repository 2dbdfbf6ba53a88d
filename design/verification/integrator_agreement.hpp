#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::design {

/// Options for repeating a run with a second integrator.
struct IntegratorAgreementOptions {
  double settling = 20.0;  // s at the start, excluded from the rms values
  std::uint64_t seed = 1;  // of the sensors' noise
  /// Of the exponential collocation: as in LoopRunOptions for the run that is checked.
  double relative_tolerance = LoopRunOptions{}.relative_tolerance;
  double absolute_tolerance = LoopRunOptions{}.absolute_tolerance;
  /// Of CVODES, on the states: relative rms error of 1e-6 on the reference antenna.
  double cvodes_relative_tolerance = 1e-7;
  double cvodes_absolute_tolerance = 1e-7;
};

/// One run by two integrators. Both use the same equations (FeedbackSystem), wind, noise and
/// sampled controller; only the integration differs. Boresight errors, angles at the sky.
struct IntegratorAgreement {
  /// Of the collocation run or, if that completed, of the CVODES run.
  RunStatus status = RunStatus::complete;
  std::string message;    // empty if complete
  double duration = 0.0;  // s compared, after settling
  // NaN for runs that did not complete.
  double collocation_rms = std::numeric_limits<double>::quiet_NaN();  // rad, about the mean
  double cvodes_rms = std::numeric_limits<double>::quiet_NaN();       // rad, about the mean
  /// rad, rms of the difference sample by sample, its mean included.
  double difference_rms = std::numeric_limits<double>::quiet_NaN();
  double cvodes_relative_tolerance = 0.0;
  double cvodes_absolute_tolerance = 0.0;
  long long collocation_steps = 0;
  long long cvodes_steps = 0;

  /// difference_rms over cvodes_rms; NaN unless complete.
  double ratio() const { return difference_rms / cvodes_rms; }
  /// The same of two more runs with white noise instead of steps of encoder and tachometer, where
  /// ratio() exceeds the limit; none if one did not complete. Rounding decides which code a sample
  /// at an edge is read as; a loop of high gain amplifies that, and the runs part, however well
  /// each is integrated.
  std::optional<double> ratio_without_quantisation = std::nullopt;
};

/// Largest ratio() at which a simulated rms counts as correctly integrated.
inline constexpr double integrator_agreement_limit = 1e-4;
/// True if both runs completed and agree within that limit, or agree so without quantisation.
bool agree(const IntegratorAgreement& agreement);

/// Runs the trajectory by the exponential collocation (FastIntegrator) and, if that completes, by
/// CVODES (OdeIntegrator); both again without quantisation where they differ by more than
/// integrator_agreement_limit. A failed run is returned as a result with its status. The same calls
/// give bit-identical results.
/// @throws InvalidInput for a settling time below 0 or not shorter than the trajectory, and as
/// run_loop.
IntegratorAgreement integrator_agreement(const SimulatedLoop& loop,
                                         const ReferenceTrajectory& course,
                                         const IntegratorAgreementOptions& options = {});

}  // namespace boresight::design
