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

/// What a law of the table was tuned for.
enum class TunedFor {
  present,  // not tuned: the gains the antenna runs on now
  nominal,  // the mission's plant alone
  robust,   // every hard goal on every member of the ensemble
};
std::string_view to_string(TunedFor purpose);

/// What the nonlinear antenna makes of a law. At the sky, rad.
struct LawInTime {
  bool still = true;         // holds_still within the tightest budget
  double hunting = 0.0;      // largest amplitude of the beam's limit cycles
  double beam_rms = 0.0;     // in one record of wind; NaN if that run did not complete
  bool hunting_seen = true;  // hunting_seen
  /// Over several records of wind.
  std::optional<SimulatedRms> expected = std::nullopt;

  /// What the controller is judged by: the expected rms, without one that of the single record;
  /// NaN if a run did not complete.
  double rms() const { return expected ? expected->rms.value : beam_rms; }
};

/// One row of the table: a law, judged.
struct TunedLaw {
  std::string structure;  // as the user names it
  TunedFor tuned_for = TunedFor::nominal;
  double wind_speed = 0.0;  // m/s, of the design
  Design design;            // on the mission's plant
  /// Every hard goal is met: by a robust law on every member, by others on the mission's plant.
  bool goals_met = false;
  double beam_rms = 0.0;              // rad at the design's wind speed; NaN without a stable law
  std::optional<double> climate_rms;  // rad, root of the mean square over the site's wind climate
  /// m/s, one a budget: with the effect() of its simulation, where it ran, also at other speeds.
  std::vector<double> speed_limits;
  std::optional<EnsembleResult> ensemble;
  std::optional<LawInTime> in_time;  // where it ran on the nonlinear antenna
  /// Of a position gain at the upper bound of the search that can be halved or lowered further.
  std::optional<PositionGainTrade> trade;

  /// Whether no budget is to be trusted to it: on the nonlinear antenna it limit-cycles beyond the
  /// tightest budget, or a run in wind did not complete.
  bool left_out() const { return in_time && (!in_time->still || !std::isfinite(in_time->rms())); }
  /// What its simulation says beyond beam_rms.
  NonlinearEffect effect() const;
  /// The larger of the linear and the simulated rms in wind, where there is one.
  double wind_rms() const {
    return in_time && in_time->rms() > beam_rms ? in_time->rms() : beam_rms;
  }
  /// What budgets are held against: wind_rms with the limit cycle (NonlinearEffect).
  double budget_rms() const;
  /// Whether it keeps within an rms (rad), as count_budget has it: a law that is left_out may yet
  /// keep a budget that is not the tightest.
  bool keeps(double rms) const;
  bool stable() const { return design.tuning.status != TuningStatus::unstable; }
  bool usable() const { return goals_met && design.verification.passed; }
};

/// A tuning that an interrupt left out.
struct TuningNotRun {
  std::string structure;
  TunedFor tuned_for = TunedFor::nominal;
  double wind_speed = 0.0;  // m/s
};

/// Every structure tuned, at every wind speed, for the nominal plant and robustly.
struct TuningStudy {
  TrackingProblem problem;  // the mission's plant at its design wind speed
  std::vector<std::string> structures;
  std::vector<double> wind_speeds;  // m/s: the design's and those that budgets ask for
  plant::WindModel wind_model = plant::WindModel::coherence;
  HardGoals goals;
  SoftGoal soft_goal;
  std::optional<double> beam_rms_goal;  // rad
  bool minimises_climate = false;       // the climate's mean square instead of one speed's
  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  std::vector<ClimatePart> climate;  // of the site; empty if it is not known
  /// torque_limited_wind_speed: speed limits do not count it.
  double supply_wind_speed = std::numeric_limits<double>::infinity();
  EnsembleSource ensemble_source = EnsembleSource::ranges;
  std::size_t ensemble_size = 0;
  int starts = 0;
  std::vector<TunedLaw> laws;
  std::vector<TuningNotRun> not_run;
  /// No tuned law that meets all it must passes its verification.
  bool unverified = false;
};

/// What to tune; empty and 0: as the mission has it.
struct TuneOptions {
  std::vector<NamedStructure> structures;
  std::vector<double> wind_speeds;  // m/s
  int starts = 0;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// Called with tasks done and all tasks; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
  /// Asked now and then, from any thread; true ends the work with the best laws found so far.
  std::function<bool()> interrupted;
};

/// Tunes each structure at each wind speed, for the mission's plant alone and for every member of
/// the ensemble, and evaluates them and the present gains. The same for any number of threads.
/// @throws InvalidInput for a speed outside 0.1 to 60 m/s, and goals that validate or constraints
/// do not allow.
TuningStudy tune_structures(const Mission& mission, const PlantEnsemble& ensemble,
                            const TuneOptions& options);

/// What recommend() chooses on the linear plant alone, where only 0.1 % of the rms is a tie: at one
/// wind speed, or at the first that has a robust design which meets every constraint, else a
/// nominal one. Null if there is none.
const TunedLaw* best_law(const TuningStudy& study, std::optional<double> wind_speed = {});

/// What decides whether a budget can be met, no choice of a controller: of the designs of
/// best_law's purpose and wind speed that are not left_out, that of the least budget_rms; where all
/// are, the same of those whose run in wind completed; best_law where none did.
const TunedLaw* nearest_to_budget(const TuningStudy& study, std::optional<double> wind_speed = {});

/// The one controller that every conclusion of a study names: recommend() at one wind speed, or at
/// that of best_law. Null where none is fit: then none is to be commissioned.
const TunedLaw* recommended_law(const TuningStudy& study, std::optional<double> wind_speed = {});

/// A tuned controller as recommend() compares it. A nominal design counts as one that was not
/// evaluated on the ensemble: the robust design of its structure was. Budgets are those required at
/// its wind speed, and the goal of the rms at the first wind speed. Without simulation: as if none
/// had run.
Assessment assessment_of(const TuningStudy& study, const TunedLaw& row,
                         bool with_simulation = true);

/// The tuned controllers of its wind speed whose figure is a tie with that of the one recommended
/// there (RejectedController::tied).
std::vector<const TunedLaw*> tied_with(const TuningStudy& study, const TunedLaw& recommended);

/// figure_change of two tuned controllers by their simulations.
std::optional<numerics::Interval> figure_change(const TunedLaw& from, const TunedLaw& to);

/// recommend() over the tuned controllers of one wind speed. Null without a winner.
const TunedLaw* recommended_at(const TuningStudy& study, double wind_speed, bool with_simulation,
                               const RecommendOptions& options);

}  // namespace boresight::design
