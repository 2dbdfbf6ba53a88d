#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/tune/measured_study.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/identification/resonance/drive_response.hpp>
#include <boresight/identification/signals/local_polynomial_response.hpp>
#include <boresight/io/campaign/campaign.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::app {
namespace {

using Eigen::Index;

const identification::DriveRecord& record_named(const identification::Campaign& campaign,
                                                const io::CampaignNotes& notes,
                                                const std::string& name) {
  std::vector<std::string> names;
  for (const auto& note : notes.records) {
    if (note.name == name && !note.refusal.empty()) {
      throw InvalidInput(fmt::format("--measured {}: the record was left out: {}",
                                     io::in_quotes(name), note.refusal));
    }
    names.push_back(note.name);
  }
  const auto found = std::ranges::find(campaign.records, name, &identification::DriveRecord::name);
  if (found == campaign.records.end()) {
    throw InvalidInput(fmt::format("--measured {}: expected a record of the case, one of {}",
                                   io::in_quotes(name), fmt::join(names, ", ")));
  }
  if (!found->valve_command || found->inlet_pressure.empty() || found->outlet_pressure.empty()) {
    throw InvalidInput(fmt::format(
        "--measured {}: expected a record with valve command and pressures, found none of {}: "
        "record them, or state their columns in [record_columns]",
        io::in_quotes(name), found->valve_command ? "the pressures" : "the valve command"));
  }
  if (found->rate_loop_closed) {
    throw InvalidInput(
        fmt::format("--measured {}: expected a test with the rate loop open: closed, the valve "
                    "command answers the noise that the response is to be freed of",
                    io::in_quotes(name)));
  }
  return *found;
}

// Where the command's spectrum, smoothed, is above a thirtieth of its highest.
control::FrequencyBand excited_band(const Eigen::VectorXd& command, double sample_time) {
  constexpr Index half = 4;
  const Eigen::VectorXd centred = (command.array() - command.mean()).matrix();
  const Eigen::VectorXd power = numerics::fourier_transform(centred).cwiseAbs2();
  Eigen::VectorXd smooth = Eigen::VectorXd::Zero(power.size());
  for (Index k = half; k + half < power.size(); ++k) {
    smooth[k] = power.segment(k - half, 2 * half + 1).mean();
  }
  const double least = smooth.maxCoeff() / 900.0;
  Index first = half, last = power.size() - half - 1;
  while (first < last && smooth[first] < least) ++first;
  while (last > first && smooth[last] < least) --last;
  const double bin = 1.0 / (sample_time * static_cast<double>(command.size()));
  return {bin * static_cast<double>(first), bin * static_cast<double>(last)};
}

struct EncoderColumn {
  std::string name;
  Eigen::VectorXd values;  // rad of motor, as many as the record's samples
};

bool begins_with_encoder(const std::string& name) {
  constexpr std::string_view word = "encoder";
  return name.size() >= word.size() &&
         std::equal(word.begin(), word.end(), name.begin(), [](char expected, char found) {
           return expected == found ||
                  (found >= 'A' && found <= 'Z' && found - 'A' + 'a' == expected);
         });
}

// The antenna's angle beside the drive's signals. Only of a file whose rows are the record's
// samples: nothing was cut or put on another time base.
std::optional<EncoderColumn> encoder_of(const io::Case& antenna, const io::RecordNotes& notes,
                                        Index samples, std::vector<std::string>& remarks) {
  const io::RecordTable table = io::read_record(notes.path);
  const auto column = std::ranges::find_if(
      table.columns, [](const io::RecordColumn& one) { return begins_with_encoder(one.name); });
  if (column == table.columns.end()) return std::nullopt;
  const auto unit = io::recorded_unit(column->unit);
  const bool usable = unit && unit->dimension == io::dimension_of(io::Kind::angle);
  if (!usable || static_cast<Index>(column->values.size()) != samples ||
      !std::ranges::all_of(column->values, [](double value) { return std::isfinite(value); })) {
    remarks.push_back(fmt::format(
        "column {} is not used: it needs an angle's unit and a number in each of the record's {} "
        "samples",
        io::in_quotes(column->name), samples));
    return std::nullopt;
  }
  const auto& reversed = antenna.campaign.columns.reversed;
  const bool turned = std::ranges::any_of(
      reversed, [&](const std::string& name) { return io::is_named(*column, name); });
  const double scale = unit->factor * gear_ratio(antenna) * (turned ? -1.0 : 1.0);
  return EncoderColumn{column->name,
                       scale * Eigen::Map<const Eigen::VectorXd>(column->values.data(), samples)};
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

// Without an encoder: the motor's angle, and behind it the gear spring and structure of the case.
void assume_encoder(const plant::AntennaPlant& antenna, control::MeasuredPlant& plant) {
  constexpr double share_uncertain = 0.2;
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
                       std::norm(share_uncertain * (gear - 1.0) / gear * plant.encoder[i]);
  }
}

// The law on the case's own plant.
void judge_on_case(const design::TrackingProblem& problem, MeasuredLaw& row) {
  if (row.tuning.status == design::MeasuredTuningStatus::unstable) return;
  const control::ControlLaw& law = row.tuning.law;
  control::LoopEvaluator evaluator = design::make_evaluator(problem);
  row.stable_on_case =
      control::stability(problem.plant, law, problem.delay, design::analysis_grid(problem))
          .stable();
  if (!row.stable_on_case) return;
  const auto evaluation = evaluator.evaluate(law, false);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    row.peaks_on_case.at(b) = evaluation.highest_peak(control::loop_breaks.at(b));
  }
}

// Of the same record where it tells it, else as the case states it.
void find_oil(const io::Case& antenna, const identification::Campaign& campaign,
              const identification::DriveRecord& record, MeasuredTuneSection& section) {
  section.oil = {oil_stiffness(antenna), antenna.drive.leakage_rate.value};
  section.oil_source = "stated by the case";
  try {
    const auto response = identification::drive_response(record, campaign);
    if (response.oil && response.oil->stiffness.value > 0.0 &&
        response.oil->total_loss_rate.value >= 0.0) {
      section.oil = {response.oil->stiffness.value, response.oil->total_loss_rate.value};
      section.oil_source = "fitted to the same record";
    }
  } catch (const NumericalFailure& failure) {
    section.notes.push_back(
        fmt::format("the record does not give the oil spring: {}", failure.what()));
  }
}

void add_notes(const io::Case& antenna, MeasuredTuneSection& section) {
  auto& notes = section.notes;
  notes.emplace_back(
      "the rms is the encoder's for wind as a torque at the motor shaft: what the structure bends "
      "beyond the encoder, and on the wind's way to the shaft, no drive test shows");
  notes.push_back(fmt::format(
      "below the hydraulic resonance the wind moves the encoder by the oil spring alone, {:.4g} N "
      "m/rad with a loss rate of {:.4g} 1/s, {}: two numbers of a model, not the measured response",
      section.oil.stiffness, section.oil.loss_rate, section.oil_source));
  notes.push_back(fmt::format(
      "everything holds for small motion about {:.3g} rad/s of motor, at which the record was "
      "taken: friction and orifices differ at tracking speed",
      section.mean_rate));
  if (section.encoder_column.empty()) {
    notes.emplace_back(
        "no encoder was recorded: how far its angle differs from the motor's is taken from the "
        "case's structure, uncertain by a fifth of the difference: the position loop rests on that "
        "model");
  }
  const auto goals = make_goals(antenna);
  if (goals.ask_for_margins() || goals.ask_for_gusts() || goals.bandwidth) {
    notes.emplace_back(
        "of the case's goals the sensitivity peaks and the valve effort were asked for, not "
        "margins, bandwidth or what gusts take");
  }
}

}  // namespace

bool MeasuredTuneSection::any_confident() const {
  return std::ranges::any_of(laws, [](const MeasuredLaw& law) {
    return law.tuning.status == design::MeasuredTuningStatus::confident;
  });
}

MeasuredTuneSection tune_measured(const io::Case& antenna, const MeasuredStudyOptions& options) {
  std::vector<std::string> names = options.structures;
  if (names.empty()) names = {"PI", "DPF"};
  std::vector<control::LoopStructure> structures;
  for (const auto& name : names) structures.push_back(io::loop_structure(antenna, name));

  io::CampaignNotes notes;
  const identification::Campaign campaign = make_campaign(antenna, notes);
  const identification::DriveRecord& record = record_named(campaign, notes, options.record);
  MeasuredTuneSection section;
  section.record = options.record;
  const auto note = std::ranges::find(notes.records, options.record, &io::RecordNotes::name);
  const auto encoder = encoder_of(antenna, *note, record.samples(), section.notes);
  if (encoder) section.encoder_column = encoder->name;

  const identification::MovingPart part = identification::moving_part(record);
  const double step = record.sample_time;
  section.start = static_cast<double>(part.first) * step;
  section.length = static_cast<double>(part.samples) * step;
  if (part.samples < 1000) {
    throw NumericalFailure(
        fmt::format("--measured {}: the drive moves one way for {:.3g} s at most ({} samples); a "
                    "response needs 1000 samples",
                    io::in_quotes(options.record), section.length, part.samples));
  }
  section.mean_rate = record.motor_rate.values.segment(part.first, part.samples).mean();
  const auto& valve = record.valve_command;
  if (!valve) throw InvalidInput(fmt::format("--measured {}: no valve command", options.record));
  const Eigen::VectorXd command = valve->values.segment(part.first, part.samples);
  const control::FrequencyBand band = excited_band(command, step);
  section.lowest_excited = band.lowest;
  section.highest_excited = band.highest;
  Eigen::MatrixXd outputs(part.samples, encoder ? 3 : 2);
  outputs.col(0) = record.motor_rate.values.segment(part.first, part.samples);
  outputs.col(1) =
      identification::recorded_torque(record, campaign.knowledge).segment(part.first, part.samples);
  if (encoder) outputs.col(2) = encoder->values.segment(part.first, part.samples);
  const auto estimate = identification::local_polynomial_response(command, outputs, step,
                                                                  {band.lowest, band.highest});

  const design::TrackingProblem problem = make_problem(antenna);
  find_oil(antenna, campaign, record, section);
  section.gear_ratio = problem.gear_ratio;
  section.wind_speed = problem.wind.mean_speed;
  control::MeasuredPlant measured_response = measured_plant(estimate, encoder.has_value());
  if (!encoder) assume_encoder(problem.plant, measured_response);
  const control::MeasuredChannels channels(measured_response, section.oil,
                                           problem.plant.drive.tachometer_corner);
  section.channels = channels;
  const auto goals = make_goals(antenna);
  section.goals = {goals.sensitivity_peak, goals.valve_effort};
  add_notes(antenna, section);

  const design::MeasuredProblem measured{channels,      problem.gear_ratio, problem.delay,
                                         problem.noise, problem.wind,       problem.rms_band};
  design::MeasuredTuningOptions tuning;
  tuning.seed = options.seed;
  tuning.stop = options.interrupted;
  if (options.starts > 0) tuning.starts = options.starts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (options.interrupted && options.interrupted()) break;
    MeasuredLaw row;
    row.structure = names[i];
    row.tuning = design::tune(measured, structures[i], section.goals, tuning);
    judge_on_case(problem, row);
    section.laws.push_back(std::move(row));
  }
  return section;
}

}  // namespace boresight::app
