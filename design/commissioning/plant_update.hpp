#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <boresight/design/commissioning/commissioning_trials.hpp>
#include <boresight/design/commissioning/stage_record.hpp>

namespace boresight::design {

/// What the records of one stage showed.
struct MeasuredStage {
  std::size_t stage = 0;  // index of the plan's stages
  StageMeasurement measurement;
};

/// A number over the plants: weighted mean and the quantiles of 2.5 % and 97.5 %. NaN if none is
/// left.
struct PlantEstimate {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = std::numeric_limits<double>::quiet_NaN();
};

/// Effective plants below which intervals are rough.
inline constexpr double fewest_effective_plants = 20.0;

/// An uncertain input before and after the records, in the unit of UncertainInput.
struct InputUpdate {
  UncertainInput input = UncertainInput::oil_stiffness;
  PlantEstimate before, after;
};

/// How well a fault explains the records.
struct FaultFit {
  std::string fault;
  double mismatch = 0.0;  // as PlantUpdate::mismatch
};

/// The uncertainty set in the light of the records.
struct PlantUpdate {
  std::size_t plants = 0;      // drawn
  double effective = 0.0;      // 1/sum of squared weights: as many equally likely plants are left
  std::size_t quantities = 0;  // measured
  /// Sum over the quantities of (measured less predicted, over its standard deviation)^2, of the
  /// plant that fits best.
  double mismatch = 0.0;
  /// The mismatch is within the 99 % quantile of chi-squared: the antenna can be one of the set.
  bool explained = false;
  std::vector<InputUpdate> inputs;  // those that vary, the one that moves or narrows most first
  /// Boresight rms (rad of motor) of the plan's last stage in the design wind, of the plants that
  /// are stable there.
  PlantEstimate final_rms_before, final_rms_after;
  /// Faults that fit better than every plant of the set, the best first, if `explained` is false.
  std::vector<FaultFit> faults;
};

/// Standard deviation to which a prediction is compared with a measurement: its uncertainty and
/// what the linear model leaves out (the resolutions of stage_quantities.hpp, a tenth of an rms,
/// whose sensor noise is stated, and of the error of a move; half of what friction within its
/// allowance makes of it, by the stage's effects), added in quadrature.
double comparison_deviation(const MeasuredQuantity& measured, const CommissioningStage& stage);

/// The measurements of each stage in one, in order: of a quantity that several records have the
/// mean, as what the model leaves out is common to them.
std::vector<MeasuredStage> combined(const std::vector<MeasuredStage>& records);

/// Draws `count` plants of the distribution, weighted by the likelihood of the records, each
/// quantity normal and independent of the others; twice as many again, up to 16 times, while fewer
/// than 40 effective ones are left. The same for any number of threads. Takes 20 ms per plant and
/// recorded stage. @throws InvalidInput for fewer than 20 plants, no quantities, or a stage that
/// the plan does not have; as plant::changed; Interrupted.
PlantUpdate updated_plants(const Mission& mission, const PlantDistribution& distribution,
                           const CommissioningPlan& plan, const CommandedMove& move,
                           const std::vector<MeasuredStage>& records,
                           const std::vector<AntennaFault>& faults, std::size_t count,
                           const TrialOptions& options);

}  // namespace boresight::design
