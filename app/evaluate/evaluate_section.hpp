#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/decisions/decision_statistics.hpp>
#include <boresight/design/decisions/test_value.hpp>
#include <boresight/design/decisions/tornado.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/io/proposals/proposed_case.hpp>
#include <boresight/numerics/statistics/sobol_indices.hpp>

namespace boresight::app {

/// One loop structure tuned on what a proposal makes of the antenna. Rms at the sky, rad.
struct CandidateLaw {
  std::string structure;  // as the user names it
  design::Design design;  // on the proposal's nominal plant
  /// Every hard goal on the nominal plant and every member of the ensemble.
  bool goals_met = false;
  std::vector<std::string> gains;  // in the engineer's units
  /// With the gains held on every member; none without a stable law.
  std::optional<design::EnsembleResult> ensemble;
  /// Root of the mean square over the members, of linear loops; infinite if one is unstable.
  double member_rms = 0.0;
  /// On the nonlinear antenna of the proposal, at the design's wind speed; none where that was not
  /// asked for, for a law that is not stable and for a case without [simulation].
  std::optional<design::NonlinearVerification> time_domain;

  /// On how many of the ensemble's plants each budget is met in the wind that it is needed up to,
  /// by linear loops times nonlinear_factor; none for a budget without such a wind. Empty without a
  /// stable law.
  std::vector<std::optional<int>> budgets_met;

  /// The simulated beam's rms over that of the linear plant in the same record; 1 without a
  /// simulation, infinite if that did not complete.
  double nonlinear_factor() const;
  /// What laws and proposals are compared by: member_rms times nonlinear_factor.
  double compared_rms() const { return member_rms * nonlinear_factor(); }
  bool stable() const { return design.tuning.status != design::TuningStatus::unstable; }
  /// Hunts by no more than the tightest budget (design::holds_still); true without a simulation.
  bool still = true;
  bool usable() const { return goals_met && design.verification.passed && still; }
};

/// A slew of `distance` from rest to rest with what the drive can do, with its reserve
/// (design::within_reach). Angles at the sky, rad.
struct SlewFigures {
  double distance = 0.0;
  double rate = 0.0, acceleration = 0.0;  // 0: the supply cannot move it against its friction
  double rate_asked = 0.0;
  std::optional<double> time;  // s
  /// What the drive has reserve for at that rate, whatever is asked.
  double reachable_acceleration = 0.0;
};

/// What the chosen law and the drive do, at the design's wind speed with the mean of the plant.
/// Rms, losses and speed limits with the law's nonlinear_factor, also at other wind speeds.
struct CandidateFigures {
  std::vector<double> losses;          // dB, one a band
  std::optional<double> climate_rms;   // rad
  std::vector<double> climate_losses;  // dB, one a band; empty without a climate
  std::vector<double> speed_limits;    // m/s, one a budget
  /// Mean wind speed (m/s) at which the supply's torque ends: io::supply_wind_speed.
  double supply_wind_speed = std::numeric_limits<double>::infinity();
  /// What friction and offset leave of the supply's torque, over the largest in gusts.
  double supply_margin = 0.0;
  double demand_margin = 0.0;              // valve stroke over the largest demand in gusts
  std::optional<double> slew_rate_margin;  // io::slew_rate_margin
  std::optional<SlewFigures> slew;         // of cases with a [simulation]
};

/// The antenna as it is, or as a proposal makes it.
struct Candidate {
  std::string name;
  std::string path;  // of the proposal; empty for the antenna as it is
  std::string description;
  std::optional<double> cost;  // 0 of the antenna as it is; none if the proposal states none
  double cost_uncertainty = 0.0;
  bool cost_assumed = false;
  std::vector<std::string> risks;
  std::vector<io::ChangeRow> changes;
  std::vector<io::DerivedChange> consequences;
  double motor_inertia = 0.0;  // kg m2, all motors
  double reflected_inertia = 0.0;
  double motor_to_load_ratio = 0.0;
  plant::PlantMode oil_mode;       // plant::mode_of_oil, no loop closed
  std::vector<CandidateLaw> laws;  // one a structure
  /// The controller recommended for it (TunedCandidate::chosen).
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
  design::Probability unstable;       // by the winding, confirmed by eigenvalues
  design::Probability outside_goals;  // unstable, or a peak or the valve effort beyond its goal
};

/// Two candidates with laws of one structure on both: over the same draws, as PairComparison.
struct SameStructure {
  std::string structure;
  design::Probability better;  // that the first is less
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

/// Chances, regrets and what they rest on. Losses are beam rms in mdeg, of linear loops times the
/// law's nonlinear_factor.
struct DecisionSection {
  std::size_t draws = 0;
  std::string source;                      // of the draws
  std::vector<CandidateDraws> candidates;  // those with a stable law, in the table's order
  design::DecisionStatistics statistics;   // options in the same order
  std::vector<PairByStructure> by_structure;
  /// Of draws in which it is on the front of cost and rms; NaN without a cost.
  std::vector<double> front_shares;
  std::vector<std::string> inputs;  // that vary
  /// The two of least expected rms, as places in `candidates`; any that is fit to be chosen comes
  /// before those that are not.
  std::size_t best = 0, second = 0;
  /// Of rms of second less best, mdeg.
  std::optional<design::Tornado> tornado;
  std::optional<numerics::SobolResult> sobol;
  /// mdeg; of the choice between those fit to be chosen, `choice` and `mean_loss` by `candidates`.
  std::optional<design::TestValue> tests;
  std::vector<std::string> notes;  // what is missing, and why
};

/// What `boresight evaluate` found.
struct EvaluateSection {
  double wind_speed = 0.0;  // m/s
  plant::WindModel wind_model = plant::WindModel::coherence;
  std::optional<io::WindMast> wind_mast;  // none: the case states speeds at the dish's centre
  bool climate = false;                   // the case has one
  bool minimises_climate = false;
  std::string currency;  // empty: no proposal states a cost
  std::string ensemble_source;
  std::size_t ensemble_size = 0;
  int starts = 0;
  std::vector<design::PointingBand> bands;
  std::vector<design::PointingBudget> budgets;
  /// How laws ran on the nonlinear antenna; none if they did not.
  std::optional<design::NonlinearVerificationOptions> time_domain;
  std::vector<Candidate> candidates;  // the antenna as it is first
  /// On the front of cost and compared_rms, as places in `candidates`, in rising cost; empty if no
  /// proposal states a cost.
  std::vector<std::size_t> front;
  std::optional<DecisionSection> decision;
  std::vector<std::string> not_run;  // what an interrupt left out
};

/// The place in `decision.candidates` of the one to choose: of those that meet every goal the
/// cheapest whose mean rms over the draws lies within negligible_change of the least of them, one
/// without a cost counting as dearer than any; decision.best if none meets its goals.
std::size_t worth_its_cost(const EvaluateSection& section, const DecisionSection& decision);

/// A few paragraphs that say what the section means, with its conditions.
std::vector<std::string> conclude(const EvaluateSection& section);

}  // namespace boresight::app
