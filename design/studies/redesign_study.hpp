#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/monte_carlo_study.hpp>

namespace boresight::design {

/// Wind speed up to which a budget is met with fixed gains, by RecommendedDesign::effect.
struct BudgetResult {
  PointingBudget budget;
  double wind_speed_limit = 0.0;  // m/s
  /// Ensemble members on which it is met in the wind up to which it is needed. None for a budget
  /// that states no such wind, and without an ensemble.
  std::optional<int> plants_met = std::nullopt;
  /// That a plant of a distribution meets it in that wind, or in the design wind for a budget that
  /// states none (add_probabilities).
  std::optional<EstimatedNumber> probability = std::nullopt;
};

/// The recommended controller in detail.
struct RecommendedDesign {
  control::LoopStructure structure;
  std::string name;  // of the structure, as the user has it
  TunedFor tuned_for = TunedFor::nominal;
  Fitness fitness = Fitness::unstable;  // of its assessment_of; decides the recommendation
  TrackingProblem problem;              // the problem that was tuned
  Constraints goals;
  Design design;
  /// Effect applied to the linear rms when budgets are evaluated (NonlinearEffect::for_budgets),
  /// also at other wind speeds, with other wind models and on ensemble members. Without a
  /// simulation: no effect.
  NonlinearEffect effect;
  /// Of a state space: the best loops, with whose structure alternatives and flywheels are tuned.
  struct Loops {
    std::string structure;
    Design design;  // at design_speed
    /// Over several records of wind, or in one (rad); none where they were not simulated.
    std::optional<double> simulated_rms = std::nullopt;
  };
  std::optional<Loops> loops;
  std::vector<std::string> ties;  // description_of other controllers that tied_with finds
  /// The antenna's present gains, evaluated on the same plant; where the mission states none, the
  /// controller of retuned_present.
  struct PresentController {
    std::string structure;
    Design design;
    bool retuned = false;  // not the antenna's own gains
    /// Over several records of wind (rad), of the first present controller that was simulated.
    std::optional<double> simulated_rms = std::nullopt;
  };
  std::vector<PresentController> present;
  /// The mission states no present gains, and this controller is that of retuned_present: `present`
  /// is empty.
  bool is_retuned_present = false;
  double design_speed = 0.0;  // m/s
  plant::WindModel wind_model = plant::WindModel::coherence;
  plant::WindSite wind_site;
  struct SeedResult {
    std::uint64_t seed = 0;
    double boresight_rms = 0.0;  // rad
    bool verified = false;
  };
  std::vector<SeedResult> seeds;  // empty for a state space
  int seeds_within_1_percent = 0;
  struct WindAlternative {
    plant::WindModel model = plant::WindModel::coherence;
    double boresight_rms = 0.0;             // rad, same gains
    std::vector<double> speed_limits = {};  // m/s, one per budget
  };
  std::vector<WindAlternative> wind_alternatives;
  /// Rms of the flexure beyond the encoder with the encoder at rest (rad). Not a bound: a loop can
  /// move the encoder against the flexure.
  double flexure_rms = 0.0;
  /// torque_limited_wind_speed.
  double torque_limited_wind_speed = std::numeric_limits<double>::infinity();
  /// rad: static_boresight_error, in no rms; the pointing model must remove it.
  double static_error = 0.0;
  double static_encoder_error = 0.0;  // rad: design::static_encoder_error
  struct BandLoss {
    PointingBand band;
    double mean_loss_db = 0.0;     // two equal axes, static error excluded
    double static_error_db = 0.0;  // additional loss by the static error on this axis
  };
  std::vector<BandLoss> losses;
  std::vector<BudgetResult> budgets;
  std::vector<ClimatePart> climate;  // of the site; empty if it is not known
  /// The controller evaluated with fixed gains on the ensemble. None without a stable one.
  std::optional<EnsembleResult> ensemble;
  /// That a plant of a distribution is stable and within every constraint (add_probabilities).
  std::optional<EstimatedNumber> constraints_met;
  /// The same as curves.
  std::optional<EnsembleCurves> curves;
  /// Of a position gain at the upper bound of the search that can be halved or lowered further.
  std::optional<PositionGainTrade> trade;
};

/// An alternative antenna consistent with the evidence, with the recommended structure tuned for
/// it; instead of a state space, with that of recommended_loops.
struct AlternativeDesign {
  Design design;
  /// Wind speed (m/s) up to which each budget is met, with the effect of the simulation of that
  /// structure as built. None without a stable controller.
  std::optional<std::vector<double>> speed_limits;
};

/// One motor inertia of the flywheel comparison.
struct FlywheelRow {
  double disks = 0.0;  // on each motor
  std::string label;   // "24 disks", "ratio 1"
  bool as_built = false;
  double motor_inertia = 0.0;        // kg m2, sum over all motors
  double motor_to_load_ratio = 0.0;  // R
  double reflected_inertia = 0.0;    // kg m2, total, at the motor shaft
};

/// One structure tuned at every row, with one friction slope.
struct FlywheelSeries {
  std::string friction;  // "linear plant", "slope at tracking rate"; empty where one slope is both
  double viscous_friction = 0.0;  // N m s/rad
  control::LoopStructure structure;
  std::vector<Design> designs;  // one per row
};

struct FlywheelComparison {
  std::vector<FlywheelRow> rows;
  std::vector<FlywheelSeries> series;
};

/// What a redesign evaluates in addition to the recommended controller.
struct RedesignTask {
  struct Alternative {
    std::string name;
    plant::Antenna antenna;
  };
  std::vector<Alternative> alternatives;
  struct Disks {
    double count = 0.0;
    std::string label;
  };
  std::vector<Disks> disks;  // of the flywheel comparison, ascending
  std::uint64_t seed = 1;
  unsigned threads = 2;
  /// Called with the numbers of tasks done and in total; may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

struct RedesignStudy {
  RecommendedDesign recommended;
  std::vector<AlternativeDesign> alternatives;  // in the order of the task
  FlywheelComparison flywheels;
  /// None without Antenna::nonlinear, and for a controller that misses its constraints.
  std::optional<TimeDomainStudy> time_domain;
};

/// Evaluates the controller that study_controllers recommends, or the least unfit where none is
/// fit. It repeats the search from eight seeds, starting with the task's. It tunes the controller's
/// structure (AlternativeDesign) for the alternatives, and at each number of disks with the linear
/// plant's friction and with the friction curve's slope at the tracking rate.
/// @throws as study_controllers.
RedesignStudy redesign(const Mission& mission, const PlantEnsemble& ensemble,
                       const RedesignTask& task);

/// Evaluates the design with its gains fixed on members and counts on how many each budget is met
/// in its wind. Does nothing for an unstable design or without members.
void evaluate_on(const std::vector<EnsembleMember>& members, unsigned threads,
                 RecommendedDesign& design);

/// Sets the probabilities of constraints and budgets by sampled_probabilities. Does nothing for an
/// unstable design. The members of an ensemble include corners and are no random sample: their
/// fraction is no probability.
void add_probabilities(const Mission& mission, const PlantDistribution& distribution,
                       const MonteCarloOptions& options, RecommendedDesign& design);

}  // namespace boresight::design
