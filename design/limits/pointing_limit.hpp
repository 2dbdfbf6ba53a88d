#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/lqg_search.hpp>

namespace boresight::design {

/// A sampled controller on one plant. Rms at the sky in rad, per axis; NaN if unstable.
struct SampledResult {
  std::string plant;
  double spectral_radius = 0.0;  // largest magnitude of a closed-loop eigenvalue
  double boresight_rms = 0.0;
  double wind_rms = 0.0, noise_rms = 0.0;  // its parts, on the nominal plant only
  double control_effort = 0.0;             // rad/s rms of the command from the sensors' noise
  SampledPeak peak;                        // Ms at the valve command

  bool stable() const { return spectral_radius < 1.0; }
};

/// A fixed-gain controller on the nominal plant and on every member of the ensemble.
struct SampledDesign {
  plant::StateSpace controller;
  SampledResult nominal;
  std::vector<SampledResult> members;
  int stable_members = 0;
  /// The largest rms of nominal and members; NaN without members or if one is unstable.
  double worst_rms = 0.0;
};

/// An LQG with optimised weights.
struct LimitedLqg {
  LqgWeights weights;  // rms in rad of motor
  SampledDesign design;
  Eigen::Index full_order = 0;  // of the LQG before any reduction
};

/// Lower bound for all linear sampled controllers (control/lqg/noise_effort_lqg.hpp). With a
/// noise-driven command of E rms the boresight mean square (rad^2 at the sky) is at least cost -
/// weight E^2, for each of the points.
struct EffortBound {
  struct Point {
    double weight = 0.0;  // rad^2 per (rad/s)^2
    double cost = 0.0;    // rad^2
  };
  std::vector<Point> points;  // in order of weight

  /// The largest bound of the points as rms (rad at the sky); 0 where no bound is positive.
  double min_rms(double control_effort) const;
};

/// A controller in its sampled form compared with the limits.
struct ControllerAgainstLimit {
  std::string name;
  SampledDesign design;
  double min_rms = 0.0;  // of any controller of the same effort
  // Nominal boresight rms of the controller over that of each; empty where there is none.
  std::optional<double> to_min, to_margin_limited, to_robustified, to_flexure, to_full_information;
  /// The controller's worst rms over that of the robustified LQG.
  std::optional<double> worst_to_robustified;
};

/// Compares controllers with the best achievable performance for the same sensors, sampling and
/// effort. All use a zero-order hold and one sample of computation delay. Wind is by its shaping
/// filter over all time; the noise of a sample follows its density.
struct PointingLimit {
  double sample_time = 0.0;        // s
  double computation_delay = 0.0;  // s
  double effort_limit = 0.0;       // rad/s
  double peak_limit = 0.0;
  /// Largest |ln(filter's spectrum / wind's)| over the fitted band.
  double wind_filter_log_error = 0.0;

  EffortBound bound;
  double min_rms = 0.0;  // lower bound at the effort limit
  /// The controller that reaches the bound, constrained by the effort only, not by margins.
  SampledDesign unconstrained;
  /// Benchmarks, not bounds; none where no weights meet the constraints.
  std::optional<LimitedLqg> margin_limited;  // Ms and effort on the nominal plant
  /// The same on every member, stable by itself and, with Constraints::standstill, while friction
  /// holds the motor (search_robust_lqg; the constraint's friction slopes, and 3 and 10 times the
  /// largest), of reduced order. None without members.
  std::optional<LimitedLqg> robustified;
  /// A controller refined by gradient (refine_controller). It starts from
  /// PointingLimitOptions::start with up to five pairs of poles about the hydraulic mode added. Its
  /// constraints: Ms at the valve on members and corners and the effort on members, both with a
  /// reserve for other plants; Ms of the position loop, cut at the encoder; stability and both
  /// peaks at the friction slopes of Constraints::standstill; |S| at its edges of the encoder; the
  /// gain from encoder to motor torque with the motor locked, 5 times
  /// Standstill::breakaway_stiffness, or 4 times where a step without violations has over 5 % more
  /// rms than the last step, or none is without; and bounds of the poles. Where the start is
  /// unstable on the edges, no step meets all of these, or 4 times does not help either, the edges
  /// are left out, then the limit of that gain too: for a result with fewer
  /// PointingLimitOptions::violations, or over 5 % less rms. If no step meets them then either, the
  /// same is tried without corners. If no start is given, or it has integrals or is unstable
  /// somewhere, it starts from the robustified LQG, under that one's constraints. None without
  /// members, with neither start, where poles are repeated, and where no step meets every
  /// constraint.
  std::optional<SampledDesign> refined;
  /// Where it starts: the name of PointingLimitOptions::start, or "robust LQG"; empty without it.
  std::string refined_from;
  /// The least rms of any controller that measures the whole state, wind included, without error at
  /// each sample, whatever its effort. It is the effect of the wind before the second-next command
  /// acts (to 1 %, from above).
  double full_information_rms = 0.0;
  /// Rms of boresight less encoder angle in the wind with the encoder at rest: flexure beyond the
  /// encoder. It is the floor of every loop that only keeps its encoder at rest. It is not a bound:
  /// a loop can move the encoder against its estimate of the flexure.
  double flexure_rms = 0.0;

  std::vector<ControllerAgainstLimit> controllers;
};

struct DescribedController {
  std::string name;
  control::Controller controller;
};

struct PointingLimitOptions {
  double sample_time = 0.02;  // s
  unsigned threads = 1;
  /// Where the refinement starts.
  std::optional<DescribedController> start = std::nullopt;
  /// Plants on which a refinement from there must also be stable and keep Ms at the valve, with the
  /// same reserve as on the members. Every peak is read at their frequencies too.
  std::vector<EnsembleMember> corners = {};
  /// RefinementOptions::violations of a refinement from there.
  CountViolations violations = {};
};

/// Computes the limits of the problem's plant in its wind (or its climate's mean spectrum) and
/// compares the controllers with them. The constraints are those on control effort and on Ms at the
/// valve command; PointingLimit::refined has further ones. Each design is evaluated from its closed
/// loop: eigenvalues, covariance, response. The result does not depend on the number of threads.
/// Takes about a second without members; the robust search takes some 0.3 s per member on one
/// thread, the refinement 0.6 s, besides what `violations` takes.
/// @throws InvalidInput for an encoder or tachometer without noise, a sample time that is not
/// positive, controllers that are not valid; NumericalFailure for a plant that is not controllable
/// or observable.
PointingLimit pointing_limit(const TrackingProblem& problem, const Constraints& goals,
                             const std::vector<EnsembleMember>& members,
                             const std::vector<DescribedController>& controllers,
                             const PointingLimitOptions& options = {});

/// See PointingLimit::flexure_rms.
double flexure_rms(const TrackingProblem& problem);

}  // namespace boresight::design
