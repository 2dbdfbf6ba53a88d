#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// A tuned loop in the time domain, on the nonlinear antenna of its case.
struct TimeDomainSection {
  std::string law;           // which, in words
  double wind_speed = 0.0;   // m/s, mean
  double sample_time = 0.0;  // s, of the controller
  /// Steps of the encoder at the sky (rad): those whose rounding error is the case's encoder noise.
  double encoder_resolution = 0.0;
  design::NonlinearVerificationOptions options;
  design::NonlinearVerification result;
  /// What the valve's stroke rests on where the case does not know it (demand_assumption).
  std::string stroke_assumption;
  /// loose_stribeck_text of the case.
  std::string friction_doubt;
  /// The slew rate asked for is out of reach only for want of stroke: with twice of it it is not.
  bool slew_hangs_on_stroke = false;
  /// The laws that this one was chosen from, itself included, influences not told apart; empty
  /// where there was no choice.
  struct Candidate {
    std::string law;
    design::NonlinearVerification result;
  };
  std::vector<Candidate> candidates;
};

/// Whether CVODES repeats the run in wind (design::integrator_agreement), which takes about as long
/// as all other runs together.
enum class SecondIntegrator { none, cvodes };

/// How closely the controller chosen of several is looked at: as the others were, or as
/// verify_in_time_domain does with a second integrator, for a report.
enum class ChoiceDetail { compared, verified };

/// Simulates the law of a problem made from the case (make_problem): 300 s of wind with every
/// influence switched off in turn, hunting, slow reversals and a slew of one degree at the case's
/// rate and 0.2 deg/s2, settled within the tightest pointing budget (1 mdeg without one). Some 2 s
/// of computing on the 70-m antenna, over `threads`, and as much for a second integrator. None for
/// a case without a [simulation] table. The same for any number of threads. @throws as
/// design::verify_in_time.
std::optional<TimeDomainSection> verify_in_time_domain(
    const io::Case& antenna, const design::TrackingProblem& problem, const control::ControlLaw& law,
    std::string_view description, std::uint64_t seed, unsigned threads, SecondIntegrator second);

/// A tuned law and what it is called.
struct DescribedLaw {
  std::string description;
  control::ControlLaw law;
};

/// `within_budget`: design::holds_still within the tightest budget; `shown`: design::hunting_seen.
design::LimitCycleVerdict limit_cycle_verdict(bool within_budget, bool shown);

/// A controller that meets every constraint, as design::recommend compares it by its simulation.
/// `budget`: the tightest (rad rms). Of pointing budgets it counts none.
design::Assessment assessment_of(const DescribedLaw& controller,
                                 const design::NonlinearVerification& result, double budget);

/// Of controllers that meet every constraint the one that design::recommend chooses by their
/// simulations and the budgets required in the problem's wind, whatever its fitness; in that
/// detail, with the others' results among its candidates. None for a case without a [simulation]
/// table. @throws InvalidInput without laws; as design::verify_in_time.
std::optional<TimeDomainSection> choose_in_time_domain(const io::Case& antenna,
                                                       const design::TrackingProblem& problem,
                                                       const std::vector<DescribedLaw>& laws,
                                                       std::uint64_t seed, unsigned threads,
                                                       ChoiceDetail detail);

/// How many laws are compared on the nonlinear antenna: as verify_in_time_domain has it, but for
/// the slew and for telling the influences apart.
design::NonlinearVerificationOptions comparison_options(const io::Case& antenna,
                                                        std::uint64_t seed);
/// One of them. None for a case without a [simulation] table. @throws as design::verify_in_time.
std::optional<design::NonlinearVerification> run_in_time_domain(
    const io::Case& antenna, const design::TrackingProblem& problem, const control::ControlLaw& law,
    const design::NonlinearVerificationOptions& options);

/// In a sentence that the drive cannot slew as the case asks; empty if it can.
std::string slew_out_of_reach(const TimeDomainSection& section);

/// In a sentence that a valve stroke which the case assumes decides what the nonlinear antenna says
/// beside the linear one: the rms in wind, or the slew rate. Empty where it is stated or decides
/// neither.
std::string assumed_stroke(const TimeDomainSection& section);

/// In a sentence that the law does not hold the antenna still (design::holds_still) within the
/// tightest budget; empty if it does.
std::string not_still(const TimeDomainSection& section);

/// What is to be done with the law, in a sentence or two for the decision box.
std::string decide(const TimeDomainSection& section);

/// The section of the terminal's report.
std::string to_text(const TimeDomainSection& section);
/// What it means beside the linear figures, in a paragraph.
std::string conclude(const TimeDomainSection& section);

}  // namespace boresight::app
