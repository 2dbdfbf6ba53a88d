#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/limits/lqg_search.hpp>

namespace boresight::design {

/// A sampled controller on one plant. Rms at the sky in rad, one axis; NaN if unstable.
struct SampledResult {
  std::string plant;
  double spectral_radius = 0.0;  // largest magnitude of a closed-loop eigenvalue
  double beam_rms = 0.0;
  double wind_rms = 0.0, noise_rms = 0.0;  // its parts, of the nominal plant only
  double valve_effort = 0.0;               // rad/s rms of the command from the sensors' noise
  SampledPeak peak;                        // of |S| at the valve command

  bool stable() const { return spectral_radius < 1.0; }
};

/// A controller, its gains held, on the nominal plant and on every member of the ensemble.
struct SampledDesign {
  plant::StateSpace controller;
  SampledResult nominal;
  std::vector<SampledResult> members;
  int stable_members = 0;
  /// The largest rms of nominal and members; NaN without members or if one is unstable.
  double worst_rms = 0.0;
};

/// An LQG of searched weights.
struct LimitedLqg {
  LqgWeights weights;  // rms in rad of motor
  SampledDesign design;
};

/// What no sampled controller gets below: the mean square of the beam (rad^2 at the sky) of every
/// linear controller whose noise-driven command is E rms is at least cost - weight E^2, for each
/// of the points (control/lqg/noise_effort_lqg.hpp).
struct EffortBound {
  struct Point {
    double weight = 0.0;  // rad^2 per (rad/s)^2
    double cost = 0.0;    // rad^2
  };
  std::vector<Point> points;  // by weight

  /// The largest bound of the points as rms (rad at the sky); 0 where none is above.
  double least_rms(double valve_effort) const;
};

/// A law in its sampled form against the limits.
struct LawAgainstLimit {
  std::string name;
  SampledDesign design;
  double least_rms = 0.0;  // of any controller of the law's own effort
  // Nominal beam rms of the law over that of each; empty where there is none.
  std::optional<double> to_least, to_margin_limited, to_robustified, to_encoder_held,
      to_full_information;
  /// The law's worst rms over the robustified LQG's.
  std::optional<double> worst_to_robustified;
};

/// How far laws are from the best that any controller can do with the same sensors, sampling and
/// effort. Zero-order hold and one sample of computation delay throughout, wind by its shaping
/// filter over all time, noise of a sample as its density says.
struct PointingLimit {
  double sample_time = 0.0;        // s
  double computation_delay = 0.0;  // s
  double effort_limit = 0.0;       // rad/s
  double peak_limit = 0.0;
  /// Largest |ln(filter's spectrum / wind's)| over the fitted band.
  double wind_filter_log_error = 0.0;

  EffortBound bound;
  double least_rms = 0.0;  // at the effort limit: the lower bound
  /// The controller that reaches it, whatever its margins: unconstrained but for the effort.
  SampledDesign unconstrained;
  /// Benchmarks, no bounds; none where no weights keep the goals.
  std::optional<LimitedLqg> margin_limited;  // peak and effort on the nominal plant
  std::optional<LimitedLqg> robustified;     // the same on every member; none without members
  /// The least of any controller that knows the whole state, wind included, at each sample without
  /// error, whatever its effort: what the wind does before the next command but one arrives (to 1
  /// %, from above).
  double full_information_rms = 0.0;
  /// Rms of beam less encoder under the wind with the encoder held perfectly still: bending that no
  /// encoder sees. The floor of every loop that only keeps its encoder still; no bound, since a
  /// loop can move the encoder against what it infers of the bending.
  double encoder_held_rms = 0.0;

  std::vector<LawAgainstLimit> laws;
};

struct NamedLaw {
  std::string name;
  control::ControlLaw law;
};

struct PointingLimitOptions {
  double sample_time = 0.02;  // s
  unsigned threads = 1;
};

/// Limits of the problem's plant in its wind (or its climate's mean spectrum) under the goals'
/// valve effort and peak of |S| at the valve command, and the laws against them. Each design is
/// judged from its closed loop: eigenvalues, covariance, response. The result does not depend on
/// the number of threads. Without members about a second; the robust search takes some 0.3 s a
/// member.
/// @throws InvalidInput for an encoder or tachometer without noise, a sample time that is not
/// positive, laws that are not valid; NumericalFailure for a plant that cannot be controlled or
/// observed.
PointingLimit pointing_limit(const TrackingProblem& problem, const HardGoals& goals,
                             const std::vector<EnsembleMember>& members,
                             const std::vector<NamedLaw>& laws,
                             const PointingLimitOptions& options = {});

/// See PointingLimit::encoder_held_rms.
double encoder_held_rms(const TrackingProblem& problem);

}  // namespace boresight::design
