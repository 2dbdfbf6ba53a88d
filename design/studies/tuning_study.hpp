#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/decisions/recommend.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/studies/position_gain_trade.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {

/// The purpose of a controller in the table.
enum class TunedFor {
  present,  // not tuned: the antenna's present gains
  nominal,  // the mission's plant alone
  robust,   // every constraint on every ensemble member
};
std::string_view to_string(TunedFor purpose);

/// Results of a controller on the nonlinear antenna. At the sky, rad.
struct ControllerInTime {
  bool limit_cycle_free = true;           // is_limit_cycle_free up to the allowed amplitude
  double limit_cycles = 0.0;              // largest boresight amplitude of its limit cycles
  double boresight_rms = 0.0;             // in one record of wind; NaN if that run did not complete
  bool limit_cycle_runs_complete = true;  // limit_cycle_runs_complete
  /// Over several records of wind.
  std::optional<SimulatedRms> expected = std::nullopt;

  /// The rms by which the controller is compared: the expected rms, or that of the single record
  /// without one. NaN if a run did not complete.
  double rms() const { return expected ? expected->rms.value : boresight_rms; }
};

/// One row of the table: a controller and its evaluation.
struct TunedController {
  std::string structure;  // as the user names it
  TunedFor tuned_for = TunedFor::nominal;
  double wind_speed = 0.0;  // m/s, of the design
  Design design;            // on the mission's plant
  /// Every constraint is met: on every member by a robust controller, on the mission's plant by
  /// others.
  bool constraints_met = false;
  double boresight_rms = 0.0;  // rad at the design's wind speed; NaN without a stable controller
  std::optional<double> climate_rms;  // rad, root of the mean square over the site's wind climate
  /// m/s, one per budget: with the effect() of its simulation if it ran, also at other speeds.
  std::vector<double> speed_limits;
  std::optional<EnsembleResult> ensemble;
  std::optional<ControllerInTime> in_time;  // where it ran on the nonlinear antenna
  /// Of a position gain at the upper bound of the search that can be halved or lowered further.
  std::optional<PositionGainTrade> trade;

  /// True if the controller is excluded from every budget: it limit-cycles beyond the allowed
  /// amplitude on the nonlinear antenna, or a run in wind did not complete.
  bool left_out() const {
    return in_time && (!in_time->limit_cycle_free || !std::isfinite(in_time->rms()));
  }
  /// Its simulated effect beyond boresight_rms.
  NonlinearEffect effect() const;
  /// The larger of the linear and the simulated rms in wind; the linear one without a simulation.
  double wind_rms() const {
    return in_time && in_time->rms() > boresight_rms ? in_time->rms() : boresight_rms;
  }
  /// The rms compared with budgets: wind_rms with the limit cycle (NonlinearEffect).
  double budget_rms() const;
  /// True if its error is within an rms (rad), by count_budget. A controller that is left_out may
  /// still meet a budget that is not the tightest.
  bool keeps(double rms) const;
  bool is_state_space() const {
    return design.tuning.controller.structure.state_space() != nullptr;
  }
  bool stable() const { return design.tuning.status != TuningStatus::unstable; }
  bool usable() const { return constraints_met && design.verification.passed; }
};

/// A tuning that an interrupt skipped.
struct TuningNotRun {
  std::string structure;
  TunedFor tuned_for = TunedFor::nominal;
  double wind_speed = 0.0;  // m/s
};

/// Every structure tuned, at every wind speed, for the nominal plant and robustly.
struct TuningStudy {
  TrackingProblem problem;  // the mission's plant at its design wind speed
  std::vector<std::string> structures;
  std::vector<double> wind_speeds;  // m/s: the design's and those that budgets require
  plant::WindModel wind_model = plant::WindModel::coherence;
  Constraints goals;
  Objective objective;
  std::optional<double> boresight_rms_goal;  // rad
  bool minimises_climate = false;  // the climate's mean square instead of that at one speed
  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  std::vector<ClimatePart> climate;  // of the site; empty if it is not known
  /// torque_limited_wind_speed; not included in speed_limits.
  double torque_limited_wind_speed = std::numeric_limits<double>::infinity();
  EnsembleSource ensemble_source = EnsembleSource::ranges;
  std::size_t ensemble_size = 0;
  int starts = 0;
  std::vector<TunedController> controllers;
  std::vector<TuningNotRun> not_run;
  /// No tuned controller that meets all its constraints passes its verification.
  bool unverified = false;
};

/// What to tune; empty or 0: as the mission has it.
struct TuneOptions {
  CandidateStructures structures;
  std::vector<double> wind_speeds;  // m/s
  int starts = 0;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with the numbers of tasks done and in total; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Polled from any thread; true ends the work with the best controllers found so far.
  std::function<bool()> interrupted;
};

/// Tunes each loop structure at each wind speed, for the mission's plant alone and for every member
/// of the ensemble, and evaluates these controllers and the present gains. A state-space controller
/// is left to study_controllers. The result does not depend on the number of threads.
/// @throws InvalidInput for a speed outside 0.1 to 60 m/s, and for goals that validate or
/// constraints reject.
TuningStudy tune_structures(const Mission& mission, const PlantEnsemble& ensemble,
                            const TuneOptions& options);

/// The choice of recommend() on the linear plant alone, where rms values within 0.1 % are tied. At
/// the given wind speed, else at the first that has a robust design which meets every constraint,
/// else a nominal one. Null if there is none.
const TunedController* best_controller(const TuningStudy& study,
                                       std::optional<double> wind_speed = {});

/// The design that decides whether a budget can be met; it is not a recommendation. Of the designs
/// of best_controller's purpose and wind speed that are not left_out, the one of least budget_rms.
/// If all are left_out, the same of those whose run in wind completed; best_controller if none did.
const TunedController* nearest_to_budget(const TuningStudy& study,
                                         std::optional<double> wind_speed = {});

/// The controller that every conclusion of a study names: recommend() at the given wind speed, or
/// at that of best_controller. Null where none is fit; then none is to be commissioned.
const TunedController* recommended_tuned_controller(const TuningStudy& study,
                                                    std::optional<double> wind_speed = {});

/// A tuned controller in the form that recommend() compares. A nominal design counts as not
/// evaluated on the ensemble, since the robust design of its structure was. Budgets are those
/// required at its wind speed; the rms goal applies at the first wind speed. Without simulation: as
/// if none had run.
Assessment assessment_of(const TuningStudy& study, const TunedController& row,
                         bool with_simulation = true);

/// The tuned controllers at the same wind speed whose figure ties with that of the recommended one
/// (RejectedController::tied).
std::vector<const TunedController*> tied_with(const TuningStudy& study,
                                              const TunedController& recommended);

/// figure_change of two tuned controllers by their simulations.
std::optional<numerics::Interval> figure_change(const TunedController& from,
                                                const TunedController& to);

/// recommend() over the tuned controllers of one wind speed. Null without a winner.
const TunedController* recommended_at(const TuningStudy& study, double wind_speed,
                                      bool with_simulation, const RecommendOptions& options);
/// The same over those that are loops with gains, whatever their fitness. Null without any.
const TunedController* recommended_loops(const TuningStudy& study, double wind_speed);

}  // namespace boresight::design
