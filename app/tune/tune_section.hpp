#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::app {

/// What a law of the table was tuned for.
enum class TunedFor {
  present,  // not tuned: the gains the antenna runs on now
  nominal,  // the case's plant alone
  robust,   // every hard goal on every member of the ensemble
};
std::string_view to_string(TunedFor purpose);

/// What the nonlinear antenna makes of a law. At the sky, rad.
struct LawInTime {
  bool still = true;         // design::holds_still within the tightest budget
  double hunting = 0.0;      // largest amplitude of the beam's limit cycles
  double beam_rms = 0.0;     // in one record of wind; NaN if that run did not complete
  bool hunting_seen = true;  // design::hunting_seen
};

/// One row of the table: a law, judged.
struct TunedLaw {
  std::string structure;  // as the user names it
  TunedFor tuned_for = TunedFor::nominal;
  double wind_speed = 0.0;  // m/s, of the design
  design::Design design;    // on the case's plant
  /// Every hard goal is met: by a robust law on every member, by others on the case's plant.
  bool goals_met = false;
  std::vector<std::string> gains;     // in the engineer's units, in the structure's order
  double beam_rms = 0.0;              // rad at the design's wind speed; NaN without a stable law
  std::optional<double> climate_rms;  // rad, root of the mean square over the site's wind climate
  std::vector<double> speed_limits;   // m/s, one a budget
  std::optional<design::EnsembleResult> ensemble;
  std::optional<LawInTime> in_time;  // where it ran on the nonlinear antenna
  /// Of a position gain at the upper bound of the search that can be halved or lowered further.
  std::optional<PositionGainTrade> trade;

  /// Whether no budget is to be trusted to it: on the nonlinear antenna it hunts beyond the
  /// tightest budget, or its run in wind did not complete.
  bool left_out() const {
    return in_time && (!in_time->still || !std::isfinite(in_time->beam_rms));
  }
  /// What budgets are held against: the larger of the linear and the simulated rms, where there is
  /// one.
  double budget_rms() const {
    return in_time && in_time->beam_rms > beam_rms ? in_time->beam_rms : beam_rms;
  }
  /// Whether it keeps within an rms (rad) in wind and, where it ran on the nonlinear antenna, by
  /// its hunting too: a law that is left_out may yet keep a budget that is not the tightest.
  bool keeps(double rms) const {
    const bool still = !in_time || in_time->still ||
                       (in_time->hunting_seen && in_time->hunting <= design::hunting_limit(rms));
    const bool pointed = !in_time || std::isfinite(in_time->beam_rms);
    return still && pointed && budget_rms() <= rms;
  }
  bool stable() const { return design.tuning.status != design::TuningStatus::unstable; }
  bool usable() const { return goals_met && design.verification.passed; }
};

/// What cannot be reached, and what comes closest.
struct Shortfall {
  std::string infeasible;
  std::string closest;
};

/// What `boresight tune` found.
struct TuneSection {
  design::TrackingProblem problem;  // the case's plant at its design wind speed
  std::vector<std::string> structures;
  std::vector<double> wind_speeds;  // m/s: the design's and those that budgets ask for
  plant::WindModel wind_model = plant::WindModel::coherence;
  std::optional<io::WindMast> wind_mast;  // none: the case states speeds at the dish's centre
  design::HardGoals goals;
  design::SoftGoal soft_goal;
  std::optional<double> beam_rms_goal;  // rad
  bool minimises_climate = false;       // the climate's mean square in the place of one speed's
  std::vector<design::PointingBand> bands;
  std::vector<design::PointingBudget> budgets;
  std::vector<design::ClimatePart> climate;  // of the site; empty if the case states none
  /// What goals on the valve's demand in gusts rest on where no number of it is stated.
  std::string demand_assumption;
  /// Mean wind speed (m/s) at which the supply's torque ends (io::supply_wind_speed):
  /// speed limits do not count it.
  double supply_wind_speed = std::numeric_limits<double>::infinity();
  std::string ensemble_source;  // what its members were drawn from
  std::size_t ensemble_size = 0;
  int starts = 0;
  std::vector<TunedLaw> laws;
  std::vector<std::string> not_run;  // tunings that an interrupt left out
  std::vector<Shortfall> shortfalls;
  /// No tuned law that meets all it must passes its verification.
  bool unverified = false;
};

}  // namespace boresight::app
