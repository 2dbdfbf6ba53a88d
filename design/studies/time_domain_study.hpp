#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/verification/limit_cycle_prediction.hpp>
#include <boresight/design/verification/limit_cycles_by_friction.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/shared_winds.hpp>
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {

/// One of several controllers compared on the nonlinear antenna.
struct SimulatedCandidate {
  std::string controller;  // NamedController::name
  NonlinearVerification result;
  std::optional<SimulatedRms> rms = std::nullopt;  // over several records of wind

  /// The rms by which it is compared (rad): over several records, or of the single record without
  /// them. NaN where a run did not complete.
  double simulated_rms() const { return rms ? rms->rms.value : result.wind.boresight_rms; }
  /// Its effect beyond the linear prediction.
  NonlinearEffect effect() const;
};

/// relative_change of their rms, limit cycles included; none without records of the same winds.
std::optional<numerics::Interval> figure_change(const SimulatedCandidate& from,
                                                const SimulatedCandidate& to);

/// A tuned controller simulated on the nonlinear antenna of its mission.
struct TimeDomainStudy {
  std::string controller;    // NamedController::name
  double wind_speed = 0.0;   // m/s, mean
  double sample_time = 0.0;  // s, of the controller
  /// Encoder steps at the sky (rad) whose rounding error equals the encoder noise.
  double encoder_resolution = 0.0;
  /// Of the commanded motion (feedforward_of), and the fraction of the friction torque in it.
  control::Feedforward feedforward;
  double friction_feedforward = 0.0;
  NonlinearVerificationOptions options;
  NonlinearVerification result;
  /// The rms over several records of wind, one of which is in `result`.
  std::optional<SimulatedRms> rms;
  /// The mission's first present controller, or that of add_present, in the wind record of
  /// `result`; its trace is empty where that run did not complete. None without one, and for
  /// controllers that were only compared.
  struct Present {
    std::string structure;
    ErrorTrace in_wind;
    bool retuned = false;  // not the antenna's own gains: of retuned_present
    /// Of the mission's own controller, over the records of `rms`; none where a run did not
    /// complete.
    std::optional<double> simulated_rms = std::nullopt;  // rad
  };
  std::optional<Present> present;
  /// The requested slew rate exceeds the drive's capability only for lack of stroke: twice the
  /// stroke suffices.
  bool slew_hangs_on_stroke = false;
  /// The controllers among which this one was chosen, itself included, without separate influences.
  /// Empty where there was no choice.
  using Candidate = SimulatedCandidate;
  std::vector<Candidate> candidates;

  /// With friction_variations; empty for a controller that is only compared.
  std::vector<LimitCyclesWithFriction> limit_cycles_by_friction;
  /// At rest (design::predicted_limit_cycle). None where limit_cycles_by_friction is empty.
  std::optional<PredictedLimitCycle> predicted_limit_cycle;

  /// This controller as a candidate.
  Candidate own() const { return {controller, result, rms}; }
};

/// Runs beyond those that compare controllers: CVODES repeats the run in wind
/// (integrator_agreement), about as long as all other runs together, and limit_cycles_by_friction
/// with friction_variations.
enum class FurtherRuns { none, all };

/// Detail of the results for the controller chosen among several: as for the others, or as
/// verify_in_time_domain with all further runs, for a report.
enum class ChoiceDetail { compared, verified };

/// Simulates a controller on a problem made of the mission: 300 s of wind with each influence
/// switched off in turn, limit cycles, slow reversals and a slew. The slew covers one degree at the
/// mission's rate and 0.2 deg/s2, settled within the tightest pointing budget (1 mdeg without one).
/// It also computes the rms with its interval by simulated_rms. Takes some 4 s of computing on the
/// 70-m antenna, over `threads`, and 6 s more for the further runs. None without
/// Antenna::nonlinear. The result does not depend on the number of threads. @throws as
/// verify_in_time.
std::optional<TimeDomainStudy> verify_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::Controller& controller,
    std::string_view description, std::uint64_t seed, unsigned threads, FurtherRuns further);

/// Simulates a controller in the wind record of the study's result, as its `present`. The problem
/// is that of the study. @throws as verify_in_time.
void add_present(const Mission& mission, const TrackingProblem& problem,
                 const NamedController& controller, bool retuned, TimeDomainStudy& study);

/// `allowed`: is_limit_cycle_free up to the allowed_limit_cycle; `shown`:
/// limit_cycle_runs_complete.
LimitCycleVerdict limit_cycle_verdict(bool allowed, bool shown);

/// The assessment that recommend() compares, of a controller that meets every constraint, from its
/// simulation. It uses the expected rms where there is one. `limit_cycle`: the amplitude
/// allowed (rad). It counts no pointing budgets.
Assessment assessment_of(const NamedController& controller, const NonlinearVerification& result,
                         const std::optional<SimulatedRms>& expected, double limit_cycle);

/// The choice among controllers that meet every constraint, on the nonlinear antenna of a mission,
/// which must outlive it.
class TimeDomainChoice {
 public:
  /// The problem is one of the mission, which must have Antenna::nonlinear.
  TimeDomainChoice(const Mission& mission, TrackingProblem problem, std::uint64_t seed,
                   unsigned threads);

  /// Runs a controller in four records of wind. @throws as verify_in_time.
  void add(const NamedController& controller);

  /// The controller that recommend() chooses by the simulations and the budgets required in the
  /// problem's wind, whatever its fitness. It, those tied with it and those within a tenth of its
  /// ranking figure run in all records of SimulatedRmsOptions. `detail`: of its results; the
  /// others' results are its candidates. More controllers can be added afterwards.
  /// @throws InvalidInput without controllers; as verify_in_time.
  TimeDomainStudy chosen(ChoiceDetail detail);

 private:
  std::size_t settle();

  const Mission& mission_;
  TrackingProblem problem_;
  std::uint64_t seed_;
  unsigned threads_;
  std::shared_ptr<SharedWinds> winds_;
  std::vector<NamedController> controllers_;
  std::vector<TimeDomainStudy> sections_;
};

/// Options for comparing several controllers on the nonlinear antenna: as verify_in_time_domain,
/// without the slew and without separate influences.
NonlinearVerificationOptions comparison_options(const Mission& mission, std::uint64_t seed);
/// Simulates one of them. None without Antenna::nonlinear. @throws as verify_in_time.
std::optional<NonlinearVerification> run_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::Controller& controller,
    const NonlinearVerificationOptions& options);
/// The same with the rms over several records of wind.
std::optional<TimeDomainStudy::Candidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const NamedController& controller,
    const NonlinearVerificationOptions& options);
/// Simulates any controller, of that name, by those options.
std::optional<SimulatedCandidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, std::string name,
    const control::Controller& controller, const NonlinearVerificationOptions& options);

/// Number of runs of limit_cycles_by_friction that end in a limit cycle or do not complete, with
/// friction_variations; 30 if one with the stated friction does, however many do; at most `enough`.
/// The frictions run one after the other until there are enough. The problem is one of the mission,
/// which must have Antenna::nonlinear. The result does not depend on the number of threads.
/// @throws as run_loop.
int limit_cycle_violations(const Mission& mission, const TrackingProblem& problem,
                           const plant::StateSpace& controller, int enough, unsigned threads);

/// The controller's nonlinear effect in the mission's wind; no effect without Antenna::nonlinear.
NonlinearEffect simulated_effect(const Mission& mission, const control::Controller& controller,
                                 std::uint64_t seed, unsigned threads);

}  // namespace boresight::design
