#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/design/commissioning/stage_quantities.hpp>
#include <boresight/identification/records/servo_record.hpp>

namespace boresight::design {

/// A quantity of a stage as a record shows it, in the unit of StageQuantity.
struct MeasuredQuantity {
  StageQuantity quantity = StageQuantity::rise_time;
  double value = 0.0;
  double uncertainty = 0.0;  // standard
  std::size_t steps = 0;     // averaged; 0 of an rms
};

/// What a record of a stage shows.
struct StageMeasurement {
  std::vector<MeasuredQuantity> quantities;
  double step_size = 0.0;  // mean of the command's steps, rad/s of motor or rad at the sky; 0: none
  /// Why a quantity that the stage predicts is not among them, a sentence each.
  std::vector<std::string> remarks;
};

/// Measures a record of one stage. Samples that are not valid are not used.
///
/// A command that steps (rate_command and motor_rate with the position loop open, position_command
/// and encoder with it closed) gives rise time, overshoot and settling time. A change over ten
/// samples at most is a step. It may start from a steady motion, which is the command's before the
/// step. A step lasts to the next, at least two rise times, with a quarter of that before it. The
/// responses, over their steps, are averaged, and smoothed over a fifteenth of the rise time, as
/// the largest value of a noisy one is too large; for settling over half of it. Settling that takes
/// longer than nine tenths of the step is not measured. The uncertainty is that of the mean of the
/// single steps, or, of one step, that of the noise before it.
/// A command at rest or in steady motion, or none, gives the rms in still air: of valve command, of
/// tachometer or encoder error, about a straight line, over the longest stretch of valid samples.
/// Its uncertainty is that of correlated samples: of the sum of squared autocorrelations (J. S.
/// Bendat, A. G. Piersol, Random Data, 4th ed., 8.4).
/// A command that moves without a step gives the largest encoder error of a stage with feedforward,
/// smoothed over a twentieth of the crossover's period, less the mean of the first twentieth of the
/// record, before the move.
/// Steps of a rate and moves also give the change of the valve command over that of the motor rate,
/// where both are recorded: of the longest steady motion away from the start against the record's
/// first twentieth. With the motor torque and CommissioningStage::flow they give that of the
/// valve's flow too, and every command the oil stiffness where it is identifiable (oil_spring).
/// `gear_ratio`: motor turns per antenna turn.
/// @throws InvalidInput for a record without any signal that the stage needs, of fewer than 100
/// samples, or without a sample time.
StageMeasurement measure_stage(const identification::ServoRecord& record,
                               const CommissioningStage& stage, double gear_ratio);

/// A measured quantity and what it says of the stage.
struct EvaluatedQuantity {
  MeasuredQuantity measured;
  PassInterval expected;
  std::optional<double> abort;
  StageVerdict verdict = StageVerdict::passes;
};
std::vector<EvaluatedQuantity> evaluated(const StageMeasurement& measurement,
                                         const CommissioningStage& stage, double rms_allowance);
/// The worst of them; passes without any.
StageVerdict worst_verdict(const std::vector<EvaluatedQuantity>& quantities);

}  // namespace boresight::design
