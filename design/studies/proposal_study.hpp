#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/decisions/decision_statistics.hpp>
#include <boresight/design/decisions/ranking_losses.hpp>
#include <boresight/design/decisions/sample_information.hpp>
#include <boresight/design/decisions/tornado.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/simulated_rms.hpp>
#include <boresight/numerics/statistics/sobol_indices.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::design {

/// The antenna as a proposal changes it, with the structures to tune on it.
struct ProposedAntenna {
  std::string name;
  Mission mission;
  CandidateStructures structures;
  /// Cost relative to the other proposals, in one currency: 0 for the antenna as it is; none if
  /// unknown.
  std::optional<double> cost;
  /// True for a changed antenna; false for the antenna as it is, also with other controllers.
  bool changed = true;
};

/// One loop structure tuned on the antenna of a proposal. Rms at the sky, rad.
struct CandidateController {
  std::string structure;  // as the user names it
  Design design;          // on the proposal's nominal plant
  /// Every constraint is met on the nominal plant and on every ensemble member.
  bool constraints_met = false;
  /// With fixed gains on every member; none without a stable controller.
  std::optional<EnsembleResult> ensemble;
  /// Root of the mean square over the members, of linear loops; infinite if one is unstable.
  double member_rms = 0.0;
  /// On the nonlinear antenna of the proposal, at the design's wind speed. None where it was not
  /// requested, for an unstable controller, and without Antenna::nonlinear.
  std::optional<NonlinearVerification> time_domain;
  /// Its rms over several records of wind; none without time_domain.
  std::optional<SimulatedRms> expected;
  /// Number of ensemble members on which each budget is met in the wind up to which it is needed,
  /// by linear loops with the nonlinear effect. None for a budget without such a wind. Empty
  /// without a stable controller.
  std::vector<std::optional<int>> budgets_met;
  /// Free of limit cycles beyond the allowed amplitude (is_limit_cycle_free); true without a
  /// simulation.
  bool limit_cycle_free = true;

  /// The expected rms over the linear one; for a single record, over that of the linear plant in
  /// the same record. 1 without a simulation, infinite if a run did not complete.
  double simulated_to_linear_rms() const;
  /// The nonlinear factor with the amplitude of the limit cycles.
  NonlinearEffect effect() const;
  /// The rms by which controllers and proposals are compared: member_rms with its effect.
  double compared_rms() const { return effect().rms(member_rms); }
  bool stable() const { return design.tuning.status != TuningStatus::unstable; }
  bool usable() const { return constraints_met && design.verification.passed && limit_cycle_free; }
};

/// A slew of `distance` from rest to rest within the drive's capability, less its reserve
/// (achievable_limits). Angles at the sky, rad.
struct SlewFigures {
  double distance = 0.0;
  double rate = 0.0, acceleration = 0.0;  // 0: the supply cannot overcome the friction
  double rate_asked = 0.0;
  std::optional<double> time;  // s
  /// Acceleration that the drive reaches with its reserve at that rate, whatever is requested.
  double reachable_acceleration = 0.0;
};

/// Figures of the chosen controller and the drive, at the design's wind speed with the nominal
/// plant. Rms, losses and speed limits include the controller's nonlinear effect, also at other
/// wind speeds.
struct CandidateFigures {
  std::vector<double> losses;          // dB, one per band
  std::optional<double> climate_rms;   // rad
  std::vector<double> climate_losses;  // dB, one per band; empty without a climate
  std::vector<double> speed_limits;    // m/s, one per budget
  /// torque_limited_wind_speed (m/s).
  double torque_limited_wind_speed = std::numeric_limits<double>::infinity();
  /// Supply torque less friction and offset torque, over the largest torque in gusts.
  double supply_margin = 0.0;
  double demand_margin = 0.0;              // valve stroke over the largest demand in gusts
  std::optional<double> slew_rate_margin;  // plant::slew_rate_margin
  std::optional<SlewFigures> slew;         // with Antenna::nonlinear
};

/// One of the antennas compared.
struct ProposedDesign {
  std::string name;
  std::size_t antenna = 0;  // its index among the antennas requested
  std::optional<double> cost;
  bool changed = true;         // ProposedAntenna::changed
  double motor_inertia = 0.0;  // kg m2, all motors
  double reflected_inertia = 0.0;
  double motor_to_load_ratio = 0.0;
  plant::PlantMode oil_mode;                     // plant::mode_of_oil, no loop closed
  std::vector<CandidateController> controllers;  // one per structure
  /// The controller recommended for it: recommended_or, accepting at worst Fitness::lost_in_wind.
  /// Where none meets its constraints: the one nearest to them. None if no structure is stable.
  std::optional<std::size_t> chosen;
  std::optional<CandidateFigures> figures;  // of the chosen controller

  /// None if no structure is stable.
  const CandidateController* chosen_controller() const {
    return chosen ? &controllers[*chosen] : nullptr;
  }
  bool feasible() const { return chosen && controllers[*chosen].usable(); }
  /// True if its limit cycle is the only criterion that it fails.
  bool has_limit_cycle() const {
    const CandidateController* controller = chosen_controller();
    return controller != nullptr && controller->constraints_met &&
           controller->design.verification.passed && !controller->limit_cycle_free;
  }
  /// Peak boresight error (rad) after a velocity reversal at the tracking rate, with the chosen
  /// controller on the nonlinear antenna. None where that did not run, or did not complete.
  std::optional<double> reversal_error() const;
};

/// Results of the samples for one candidate, gains fixed.
struct CandidateSamples {
  std::size_t candidate = 0;
  Probability unstable;       // by Nyquist encirclements, confirmed by eigenvalues
  Probability outside_goals;  // unstable, or Ms or the control effort beyond its limit
};

/// Two candidates with controllers of one structure on both, compared over the same samples as
/// PairComparison.
struct SameStructure {
  std::string structure;
  Probability better;  // that the first has the smaller rms
  /// Mean of second less first (mdeg; positive: the first is better), and its standard error.
  double mean_gain = 0.0, gain_error = 0.0;
  bool first_usable = false, second_usable = false;  // CandidateController::usable
};

/// Two different antennas, as indices into `candidates`, whose chosen controllers differ in
/// structure. Each of the two structures is compared on both antennas, if it was tuned for both.
struct PairByStructure {
  std::size_t first = 0, second = 0;
  std::vector<SameStructure> structures;
};

/// Reason why a candidate has no samples.
enum class NotDrawn { no_stable_controller, run_not_completed };
/// Reason why no value of a plant test is computed.
enum class TestsNotValued { fewer_than_two_fit, unstable_on_some_samples };

/// Probabilities, regrets and their basis. Losses are boresight rms in mdeg, of linear loops with
/// the controller's nonlinear effect.
struct ProposalDecision {
  std::size_t random_samples = 0;
  std::vector<CandidateSamples> candidates;  // those with a stable controller, in the study's order
  DecisionStatistics statistics;             // options in the same order
  std::vector<PairByStructure> by_structure;
  /// Fraction of samples in which the candidate is on the Pareto front of cost and rms; NaN without
  /// a cost.
  std::vector<double> front_fractions;
  std::vector<UncertainInput> uncertain;  // that vary
  RankingLosses ranking;                  // ranking_losses of the options
  /// Eligible, and tied with `best`: their losses differ by at most negligible_change, or by at
  /// most the uncertainty from the records of wind (relative_change of their simulations). One per
  /// candidate.
  std::vector<bool> tied;
  /// The two of least loss, as indices into `candidates`; eligible candidates come before others.
  std::size_t best = 0, second = 0;
  /// worth_its_cost, as an index into `candidates`.
  std::size_t worth = 0;
  /// Of the difference in rms, second less best, in mdeg.
  std::optional<Tornado> tornado;
  std::optional<numerics::SobolResult> sobol;
  /// mdeg; for the choice among eligible candidates; `choice` and `mean_loss` are by `candidates`.
  std::optional<SampleInformation> tests;

  struct LeftOut {
    std::size_t candidate = 0;  // of the study
    NotDrawn reason = NotDrawn::no_stable_controller;
  };
  std::vector<LeftOut> left_out;
  std::string undecided;  // why tornado and sobol failed; empty: they succeeded
  std::optional<TestsNotValued> tests_not_valued;
};

/// One option of a decision, the input of worth_its_cost.
struct PricedOption {
  bool fit = false;  // meets every constraint
  std::optional<double> cost;
  double loss = 0.0;  // ranking_losses
  bool tied = false;  // with the eligible option of least loss
};

/// The index of the option to choose: the cheapest eligible option that is tied, or whose loss is
/// within negligible_change of the least eligible loss. Options without a cost rank as the most
/// expensive. At equal cost the smaller loss wins. Returns `best` if none is eligible.
std::size_t worth_its_cost(const std::vector<PricedOption>& options, std::size_t best);

/// Sets ranking, best, second, tied and worth from the statistics of a decision. `candidates`:
/// those of the study.
void rank_candidates(const std::vector<ProposedDesign>& candidates, ProposalDecision& decision);

/// The uncertainty set of the plant, common to all proposals.
struct PlantUncertainty {
  PlantDistribution distribution;
  /// True if the ensemble members are samples of the distribution; false if those of plant_members.
  bool from_records = false;
};

struct ProposalOptions {
  std::size_t random_samples = 2000;
  int starts = 0;  // per search; 0: as the mission has it
  /// Controllers run on the nonlinear antenna, if there is one, and are compared by that.
  bool time_domain = true;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with the numbers of tasks done and in total; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Polled from any thread; true ends the work and keeps the completed parts.
  std::function<bool()> interrupted;
};

struct ProposalStudy {
  std::size_t ensemble_size = 0;
  int starts = 0;
  /// Options of the runs on the nonlinear antenna; none if there were none.
  std::optional<NonlinearVerificationOptions> time_domain;
  std::vector<ProposedDesign> candidates;  // in the order requested, without those of not_run
  std::vector<std::size_t> not_run;        // skipped by an interrupt; indices into `antennas`
  /// Pareto front of cost and compared_rms, as indices into `candidates`, in order of rising cost.
  /// Candidates without a cost are excluded.
  std::vector<std::size_t> front;
  std::optional<ProposalDecision> decision;  // none if interrupted or fewer than two are stable
};

/// Tunes the antenna as it is and as every proposal changes it, with common samples of the
/// uncertain inputs (study_controllers), and compares the recommended designs. `antennas`: the one
/// as it is first, then in any order. The result does not depend on the number of threads.
/// @throws InvalidInput for fewer than 100 samples, without antennas, and as study_controllers.
ProposalStudy study_proposals(const std::vector<ProposedAntenna>& antennas,
                              const PlantUncertainty& uncertainty, const ProposalOptions& options);

/// The plant of a sample on the antenna of a proposal. Factors multiply the proposal's values. The
/// friction slope scales with the friction curve's slope at the tracking rate.
plant::AntennaPlant proposed_plant(const plant::Antenna& as_is, const plant::Antenna& proposed,
                                   const PlantSample& draw);

}  // namespace boresight::design
