#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {

/// One controller of several that were compared on the nonlinear antenna.
struct SimulatedCandidate {
  std::string law;  // NamedController::name
  NonlinearVerification result;
  std::optional<SimulatedRms> rms = std::nullopt;  // over several records of wind

  /// The rms that it is judged by (rad): over several records, without them of the single one; NaN
  /// where a run did not complete.
  double simulated_rms() const { return rms ? rms->rms.value : result.wind.beam_rms; }
  /// What it says beyond the linear prediction.
  NonlinearEffect effect() const;
};

/// relative_change of their rms with the limit cycles; none without records of the same winds.
std::optional<numerics::Interval> figure_change(const SimulatedCandidate& from,
                                                const SimulatedCandidate& to);

/// A tuned controller in the time domain, on the nonlinear antenna of its mission.
struct TimeDomainStudy {
  std::string law;           // NamedController::name
  double wind_speed = 0.0;   // m/s, mean
  double sample_time = 0.0;  // s, of the controller
  /// Steps of the encoder at the sky (rad): those whose rounding error is the encoder noise.
  double encoder_resolution = 0.0;
  NonlinearVerificationOptions options;
  NonlinearVerification result;
  /// What several records of wind say of the rms, of which `result` has one.
  std::optional<SimulatedRms> rms;
  /// The mission's first present controller in the record of wind of `result`; its trace is empty
  /// where that run did not complete. None without one, and of controllers that were only compared.
  struct Present {
    std::string structure;
    ErrorTrace in_wind;
  };
  std::optional<Present> present;
  /// The slew rate asked for is out of reach only for want of stroke: with twice of it it is not.
  bool slew_hangs_on_stroke = false;
  /// The controllers that this one was chosen from, itself included, influences not told apart;
  /// empty where there was no choice.
  using Candidate = SimulatedCandidate;
  std::vector<Candidate> candidates;

  /// Itself, as one of them.
  Candidate own() const { return {law, result, rms}; }
};

/// Whether CVODES repeats the run in wind (integrator_agreement), which takes about as long as all
/// other runs together.
enum class SecondIntegrator { none, cvodes };

/// How closely the controller chosen of several is looked at: as the others were, or as
/// verify_in_time_domain does with a second integrator, for a report.
enum class ChoiceDetail { compared, verified };

/// Simulates a controller on a problem made of the mission: 300 s of wind with every influence
/// switched off in turn, limit cycles, slow reversals and a slew of one degree at the mission's
/// rate and 0.2 deg/s2, settled within the tightest pointing budget (1 mdeg without one); and the
/// rms with its interval by simulated_rms. Some 4 s of computing on the 70-m antenna, over
/// `threads`, and 2 s for a second integrator. None without Antenna::nonlinear. The same for any
/// number of threads. @throws as verify_in_time.
std::optional<TimeDomainStudy> verify_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::ControlLaw& law,
    std::string_view description, std::uint64_t seed, unsigned threads, SecondIntegrator second);

/// `within_budget`: holds_still within the tightest budget; `shown`: hunting_seen.
LimitCycleVerdict limit_cycle_verdict(bool within_budget, bool shown);

/// A controller that meets every constraint, as recommend() compares it by its simulation, of the
/// expected rms where there is one. `budget`: the tightest (rad rms). Of pointing budgets it counts
/// none.
Assessment assessment_of(const NamedController& controller, const NonlinearVerification& result,
                         const std::optional<SimulatedRms>& expected, double budget);

/// Of controllers that meet every constraint the one that recommend() chooses by their simulations
/// and the budgets required in the problem's wind, whatever its fitness; in that detail, with the
/// others' results among its candidates. None without Antenna::nonlinear.
/// @throws InvalidInput without controllers; as verify_in_time.
std::optional<TimeDomainStudy> choose_in_time_domain(const Mission& mission,
                                                     const TrackingProblem& problem,
                                                     const std::vector<NamedController>& laws,
                                                     std::uint64_t seed, unsigned threads,
                                                     ChoiceDetail detail);

/// How many controllers are compared on the nonlinear antenna: as verify_in_time_domain has it, but
/// for the slew and for telling the influences apart.
NonlinearVerificationOptions comparison_options(const Mission& mission, std::uint64_t seed);
/// One of them. None without Antenna::nonlinear. @throws as verify_in_time.
std::optional<NonlinearVerification> run_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const control::ControlLaw& law,
    const NonlinearVerificationOptions& options);
/// The same with the rms over several records of wind.
std::optional<TimeDomainStudy::Candidate> compare_in_time_domain(
    const Mission& mission, const TrackingProblem& problem, const NamedController& controller,
    const NonlinearVerificationOptions& options);
/// Its effect in the mission's wind; no effect without Antenna::nonlinear.
NonlinearEffect simulated_effect(const Mission& mission, const control::ControlLaw& law,
                                 std::uint64_t seed, unsigned threads);

}  // namespace boresight::design
