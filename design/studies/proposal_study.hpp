#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/decisions/decision_statistics.hpp>
#include <boresight/design/decisions/ranking_losses.hpp>
#include <boresight/design/decisions/test_value.hpp>
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

/// What a proposal makes of an antenna, with what is to be tuned on it.
struct ProposedAntenna {
  std::string name;
  Mission mission;
  std::vector<NamedStructure> structures;
  /// Beside the others', in one currency: 0 of the antenna as it is; none if it is not known.
  std::optional<double> cost;
  /// Whether it is another antenna than the one as it is, or that one with other controllers.
  bool changed = true;
};

/// One loop structure tuned on what a proposal makes of the antenna. Rms at the sky, rad.
struct CandidateLaw {
  std::string structure;  // as the user names it
  Design design;          // on the proposal's nominal plant
  /// Every hard goal on the nominal plant and every member of the ensemble.
  bool goals_met = false;
  /// With the gains held on every member; none without a stable law.
  std::optional<EnsembleResult> ensemble;
  /// Root of the mean square over the members, of linear loops; infinite if one is unstable.
  double member_rms = 0.0;
  /// On the nonlinear antenna of the proposal, at the design's wind speed; none where that was not
  /// asked for, for a law that is not stable and without Antenna::nonlinear.
  std::optional<NonlinearVerification> time_domain;
  /// Its rms over several records of wind; none without time_domain.
  std::optional<SimulatedRms> expected;
  /// On how many of the ensemble's plants each budget is met in the wind that it is needed up to,
  /// by linear loops with its effect; none for a budget without such a wind. Empty without a
  /// stable law.
  std::vector<std::optional<int>> budgets_met;
  /// Hunts by no more than the tightest budget (holds_still); true without a simulation.
  bool still = true;

  /// The expected rms over the linear one, of a single record over that of the linear plant in it;
  /// 1 without a simulation, infinite if a run did not complete.
  double nonlinear_factor() const;
  /// That, with the amplitude of its limit cycles.
  NonlinearEffect effect() const;
  /// What laws and proposals are compared by: member_rms with its effect.
  double compared_rms() const { return effect().rms(member_rms); }
  bool stable() const { return design.tuning.status != TuningStatus::unstable; }
  bool usable() const { return goals_met && design.verification.passed && still; }
};

/// A slew of `distance` from rest to rest with what the drive can do, with its reserve
/// (within_reach). Angles at the sky, rad.
struct SlewFigures {
  double distance = 0.0;
  double rate = 0.0, acceleration = 0.0;  // 0: the supply cannot move it against its friction
  double rate_asked = 0.0;
  std::optional<double> time;  // s
  /// What the drive has reserve for at that rate, whatever is asked.
  double reachable_acceleration = 0.0;
};

/// What the chosen law and the drive do, at the design's wind speed with the mean of the plant.
/// Rms, losses and speed limits with the law's effect, also at other wind speeds.
struct CandidateFigures {
  std::vector<double> losses;          // dB, one a band
  std::optional<double> climate_rms;   // rad
  std::vector<double> climate_losses;  // dB, one a band; empty without a climate
  std::vector<double> speed_limits;    // m/s, one a budget
  /// torque_limited_wind_speed (m/s).
  double supply_wind_speed = std::numeric_limits<double>::infinity();
  /// What friction and offset leave of the supply's torque, over the largest in gusts.
  double supply_margin = 0.0;
  double demand_margin = 0.0;              // valve stroke over the largest demand in gusts
  std::optional<double> slew_rate_margin;  // plant::slew_rate_margin
  std::optional<SlewFigures> slew;         // with Antenna::nonlinear
};

/// One of the antennas compared.
struct ProposedDesign {
  std::string name;
  std::size_t antenna = 0;  // its place among those asked for
  std::optional<double> cost;
  bool changed = true;         // ProposedAntenna::changed
  double motor_inertia = 0.0;  // kg m2, all motors
  double reflected_inertia = 0.0;
  double motor_to_load_ratio = 0.0;
  plant::PlantMode oil_mode;       // plant::mode_of_oil, no loop closed
  std::vector<CandidateLaw> laws;  // one a structure
  /// The controller recommended for it: that of study_controllers, where only a loss in wind is
  /// worse than what recommended_or accepts; where none meets its goals, that nearest to them; none
  /// if no structure is stable.
  std::optional<std::size_t> chosen;
  std::optional<CandidateFigures> figures;  // of the chosen law

  /// None if no structure is stable.
  const CandidateLaw* chosen_law() const { return chosen ? &laws[*chosen] : nullptr; }
  bool feasible() const { return chosen && laws[*chosen].usable(); }
  /// Nothing but its hunting is against it.
  bool hunts() const {
    const CandidateLaw* law = chosen_law();
    return law != nullptr && law->goals_met && law->design.verification.passed && !law->still;
  }
  /// The beam's largest after turning round at the tracking rate (rad), with the chosen law on the
  /// nonlinear antenna; none where that did not run, or not to its end.
  std::optional<double> reversal_error() const;
};

/// What the draws say of one candidate with its gains held.
struct CandidateDraws {
  std::size_t candidate = 0;
  Probability unstable;       // by the winding, confirmed by eigenvalues
  Probability outside_goals;  // unstable, or a peak or the valve effort beyond its goal
};

/// Two candidates with laws of one structure on both: over the same draws, as PairComparison.
struct SameStructure {
  std::string structure;
  Probability better;  // that the first is less
  /// Of second less first (mdeg; positive: the first is better), and its standard error.
  double mean_gain = 0.0, gain_error = 0.0;
  bool first_usable = false, second_usable = false;  // CandidateLaw::usable
};

/// Two different antennas, as places in `candidates`, whose chosen laws differ in structure: what
/// they do with each of the two on both, without one that was not tuned for both.
struct PairByStructure {
  std::size_t first = 0, second = 0;
  std::vector<SameStructure> structures;
};

/// Why a candidate has no draws.
enum class NotDrawn { no_stable_law, run_not_completed };
/// Why a test of the plant is given no value.
enum class TestsNotValued { fewer_than_two_fit, unstable_on_some_draws };

/// Chances, regrets and what they rest on. Losses are beam rms in mdeg, of linear loops with the
/// law's effect.
struct ProposalDecision {
  std::size_t draws = 0;
  std::vector<CandidateDraws> candidates;  // those with a stable law, in the study's order
  DecisionStatistics statistics;           // options in the same order
  std::vector<PairByStructure> by_structure;
  /// Of draws in which it is on the front of cost and rms; NaN without a cost.
  std::vector<double> front_shares;
  std::vector<UncertainInput> uncertain;  // that vary
  RankingLosses ranking;                  // ranking_losses of the options
  /// Fit to be chosen, and tied with `best`: their losses differ by no more than negligible_change,
  /// or than the records of wind leave open (relative_change of their simulations); one a
  /// candidate.
  std::vector<bool> tied;
  /// The two of least loss by that, as places in `candidates`; any that is fit to be chosen comes
  /// before those that are not.
  std::size_t best = 0, second = 0;
  /// worth_its_cost, as a place in `candidates`.
  std::size_t worth = 0;
  /// Of rms of second less best, mdeg.
  std::optional<Tornado> tornado;
  std::optional<numerics::SobolResult> sobol;
  /// mdeg; of the choice between those fit to be chosen, `choice` and `mean_loss` by `candidates`.
  std::optional<TestValue> tests;

  struct LeftOut {
    std::size_t candidate = 0;  // of the study
    NotDrawn reason = NotDrawn::no_stable_law;
  };
  std::vector<LeftOut> left_out;
  std::string undecided;  // why tornado and sobol failed; empty: they did not
  std::optional<TestsNotValued> tests_not_valued;
};

/// One of the options of a decision, as worth_its_cost weighs them.
struct PricedOption {
  bool fit = false;  // meets every goal
  std::optional<double> cost;
  double loss = 0.0;  // ranking_losses
  bool tied = false;  // with the one of least loss that is fit
};

/// The place of the one to choose: of those that are fit the cheapest that is tied or whose loss
/// lies within negligible_change of the least of them, one without a cost counting as dearer than
/// any; of equal cost the one of less loss. `best` if none is fit.
std::size_t worth_its_cost(const std::vector<PricedOption>& options, std::size_t best);

/// Sets ranking, best, second, tied and worth by the statistics of a decision; `candidates` as the
/// study has them.
void rank_candidates(const std::vector<ProposedDesign>& candidates, ProposalDecision& decision);

/// Plants that may be the true one, whatever a proposal makes of the antenna.
struct PlantUncertainty {
  PlantDistribution distribution;
  /// Its members are draws of the distribution; else those of plant_members.
  bool from_records = false;
};

struct ProposalOptions {
  std::size_t draws = 2000;
  int starts = 0;  // of each search; 0: as the mission has it
  /// Laws run on the nonlinear antenna, if there is one, and are compared by that.
  bool time_domain = true;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Asked now and then, from any thread; true ends the work with what is whole.
  std::function<bool()> interrupted;
};

struct ProposalStudy {
  std::size_t ensemble_size = 0;
  int starts = 0;
  /// How laws ran on the nonlinear antenna; none if they did not.
  std::optional<NonlinearVerificationOptions> time_domain;
  std::vector<ProposedDesign> candidates;  // in the order asked for, without those of not_run
  std::vector<std::size_t> not_run;        // what an interrupt left out, of those asked for
  /// On the front of cost and compared_rms, as places in `candidates`, in rising cost; those
  /// without a cost are not on it.
  std::vector<std::size_t> front;
  std::optional<ProposalDecision> decision;  // none for fewer than two with a law, or interrupted
};

/// Tunes the antenna as it is and what every proposal makes of it with the same draws of what is
/// uncertain (study_controllers), and compares what is recommended for each. `antennas`: the one as
/// it is first, then in any order. The same for any number of threads.
/// @throws InvalidInput for fewer than 100 draws, without antennas, and as study_controllers.
ProposalStudy study_proposals(const std::vector<ProposedAntenna>& antennas,
                              const PlantUncertainty& uncertainty, const ProposalOptions& options);

/// The plant of a draw on what a proposal made of an antenna: factors apply to whatever the
/// proposal makes of the number; the friction slope scales with the friction curve's slope at the
/// tracking rate.
plant::AntennaPlant proposed_plant(const plant::Antenna& as_is, const plant::Antenna& proposed,
                                   const PlantDraw& draw);

}  // namespace boresight::design
