#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/studies/measured_tuning_study.hpp>
#include <boresight/identification/resonance/drive_response.hpp>
#include <boresight/identification/signals/local_polynomial_response.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;

// Where the command's spectrum, smoothed, is above a thirtieth of its highest.
control::FrequencyBand excited_band(const Eigen::VectorXd& command, double sample_time) {
  constexpr Index half = 4;
  const Eigen::VectorXd centred = (command.array() - command.mean()).matrix();
  const Eigen::VectorXd power = numerics::fourier_transform(centred).cwiseAbs2();
  Eigen::VectorXd smooth = Eigen::VectorXd::Zero(power.size());
  for (Index k = half; k + half < power.size(); ++k) {
    smooth[k] = power.segment(k - half, 2 * half + 1).mean();
  }
  const double minimum = smooth.maxCoeff() / 900.0;
  Index first = half, last = power.size() - half - 1;
  while (first < last && smooth[first] < minimum) ++first;
  while (last > first && smooth[last] < minimum) --last;
  const double bin = 1.0 / (sample_time * static_cast<double>(command.size()));
  return {bin * static_cast<double>(first), bin * static_cast<double>(last)};
}

control::MeasuredPlant measured_plant(const identification::MultipleResponseEstimate& estimate,
                                      bool encoder) {
  const auto count = static_cast<std::size_t>(estimate.frequency.size());
  control::MeasuredPlant plant;
  plant.frequency = two_pi * estimate.frequency.array();
  plant.tachometer = estimate.response.col(0);
  plant.motor_torque = estimate.response.col(1);
  if (encoder) plant.encoder = estimate.response.col(2);
  const Index channels = estimate.response.cols();
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Matrix3cd covariance = Eigen::Matrix3cd::Zero();
    covariance.topLeftCorner(channels, channels) = estimate.covariance[i];
    plant.covariance.push_back(covariance);
  }
  plant.degrees_of_freedom = static_cast<double>(estimate.degrees_of_freedom);
  plant.coherence = Eigen::ArrayXXd::Ones(estimate.frequency.size(), 3);
  plant.coherence.leftCols(channels) = estimate.coherence;
  return plant;
}

// Without an encoder: the motor's angle, and behind it the gear spring and structure of the
// antenna.
void assume_encoder(const plant::AntennaPlant& antenna, control::MeasuredPlant& plant) {
  constexpr double fraction_uncertain = 0.2;
  const auto structure = plant::structure_response(antenna.structure, plant.frequency);
  const double corner = antenna.drive.tachometer_corner;
  plant.encoder.resize(plant.frequency.size());
  for (Index i = 0; i < plant.frequency.size(); ++i) {
    const std::complex<double> s(0.0, plant.frequency[i]);
    const auto gear = structure.gear_stiffness[i] /
                      (structure.gear_stiffness[i] + structure.inertial_stiffness[i]);
    const auto per_tachometer = gear * (1.0 + s / corner) / s;
    plant.encoder[i] = plant.tachometer[i] * per_tachometer;
    auto& covariance = plant.covariance[static_cast<std::size_t>(i)];
    covariance.row(2) = per_tachometer * covariance.row(0);
    covariance.col(2) = std::conj(per_tachometer) * covariance.col(0);
    covariance(2, 2) = std::norm(per_tachometer) * covariance(0, 0) +
                       std::norm(fraction_uncertain * (gear - 1.0) / gear * plant.encoder[i]);
  }
}

// The controller on the mission's own plant.
void evaluate_on_mission(const TrackingProblem& problem, MeasuredController& row) {
  if (row.tuning.status == MeasuredTuningStatus::unstable) return;
  const control::Controller& controller = row.tuning.controller;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  row.stable_on_case =
      control::stability(problem.plant, controller, problem.delay, analysis_grid(problem)).stable();
  if (!row.stable_on_case) return;
  const auto evaluation = evaluator.evaluate(controller, false);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    row.peaks_on_case.at(b) = evaluation.highest_peak(control::loop_breaks.at(b));
  }
}

// Of the same record where it tells it, else as the antenna has it.
void find_oil(const plant::Drive& drive, const identification::Campaign& campaign,
              const identification::DriveRecord& record, MeasuredTuningStudy& study) {
  study.oil = {drive.oil_stiffness, drive.leakage_rate};
  try {
    const auto response = identification::drive_response(record, campaign);
    if (response.oil && response.oil->stiffness.value > 0.0 &&
        response.oil->total_loss_rate.value >= 0.0) {
      study.oil = {response.oil->stiffness.value, response.oil->total_loss_rate.value};
      study.oil_fitted = true;
    }
  } catch (const NumericalFailure& failure) {
    study.oil_failure = failure.what();
  }
}

// Valve command to tachometer, torque and encoder over the part that moves one way.
identification::MultipleResponseEstimate measured_response(
    const identification::DriveRecord& record, const Eigen::VectorXd& valve_command,
    const identification::DriveKnowledge& knowledge, const std::optional<Eigen::VectorXd>& encoder,
    MeasuredTuningStudy& study) {
  const identification::MovingPart part = identification::moving_part(record);
  const double step = record.sample_time;
  study.start = static_cast<double>(part.first) * step;
  study.length = static_cast<double>(part.samples) * step;
  if (part.samples < 1000) {
    throw NumericalFailure(
        fmt::format("record '{}': the drive moves one way for {:.3g} s at most ({} samples); a "
                    "response needs 1000 samples",
                    record.name, study.length, part.samples));
  }
  const auto used = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    return values.segment(part.first, part.samples);
  };
  Eigen::MatrixXd outputs(part.samples, encoder ? 3 : 2);
  outputs.col(0) = used(record.motor_rate.values);
  outputs.col(1) = used(identification::recorded_torque(record, knowledge));
  if (encoder) outputs.col(2) = used(*encoder);
  study.mean_rate = record.motor_rate.values.segment(part.first, part.samples).mean();
  const Eigen::VectorXd command = used(valve_command);
  const control::FrequencyBand band = excited_band(command, step);
  study.lowest_excited = band.lowest;
  study.highest_excited = band.highest;
  return identification::local_polynomial_response(command, outputs, step,
                                                   {band.lowest, band.highest});
}

const Eigen::VectorXd& checked_command(const identification::DriveRecord& record,
                                       const std::optional<Eigen::VectorXd>& encoder) {
  if (!record.valve_command || record.rate_loop_closed) {
    throw InvalidInput(
        fmt::format("record '{}': expected a valve command with the rate loop open, found {}",
                    record.name, record.valve_command ? "the loop closed" : "no valve command"));
  }
  if (encoder && encoder->size() != record.samples()) {
    throw InvalidInput(
        fmt::format("record '{}': expected an encoder's angle for each of {} samples, found {}",
                    record.name, record.samples(), encoder->size()));
  }
  return record.valve_command->values;
}

}  // namespace

bool MeasuredTuningStudy::any_confident() const {
  return std::ranges::any_of(controllers, [](const MeasuredController& controller) {
    return controller.tuning.status == MeasuredTuningStatus::confident;
  });
}

MeasuredTuningStudy study_measured_tuning(const Mission& mission,
                                          const identification::Campaign& campaign,
                                          const identification::DriveRecord& record,
                                          const std::optional<Eigen::VectorXd>& encoder,
                                          const std::vector<NamedStructure>& structures,
                                          const MeasuredTuningOptions& options) {
  const Eigen::VectorXd& command = checked_command(record, encoder);
  MeasuredTuningStudy study;
  study.encoder_recorded = encoder.has_value();
  const auto estimate = measured_response(record, command, campaign.knowledge, encoder, study);

  const TrackingProblem problem = tracking_problem(mission);
  find_oil(problem.plant.drive, campaign, record, study);
  study.gear_ratio = problem.gear_ratio;
  study.wind_speed = problem.wind.mean_speed;
  control::MeasuredPlant plant = measured_plant(estimate, study.encoder_recorded);
  if (!encoder) assume_encoder(problem.plant, plant);
  study.channels.emplace(plant, study.oil, problem.plant.drive.tachometer_corner);
  const Constraints goals = constraints(mission);
  study.goals = {goals.sensitivity_peak, goals.control_effort};
  study.other_goals =
      goals.ask_for_margins() || goals.ask_for_gusts() || goals.static_encoder_error.has_value();

  const MeasuredProblem measured{*study.channels, problem.gear_ratio, problem.delay,
                                 problem.noise,   problem.wind,       problem.rms_band};
  for (const auto& [name, structure] : structures) {
    if (options.stop && options.stop()) break;
    MeasuredController row;
    row.structure = name;
    row.tuning = tune(measured, structure, study.goals, options);
    evaluate_on_mission(problem, row);
    study.controllers.push_back(std::move(row));
  }
  return study;
}

}  // namespace boresight::design
