#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/commission/commission_wording.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/servo_record_wording.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/io/campaign/compared_records.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/exchange/gains_by_key.hpp>
#include <boresight/io/records/servo_record_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::string structure_of_gains(const CommissionOptions& options) {
  return options.structure.empty() ? "DPF" : options.structure;
}

// What keeps a study from a recommendation, in words.
std::string why_none(const io::Case& antenna, design::ControllerStudy study) {
  if (const TunedController* best = recommended_or(study, design::Fitness::lost_in_wind);
      best != nullptr && best->constraints_met) {
    return fmt::format(
        ": the best of them, {}, fails on the nonlinear antenna. Name it with --gains or "
        "--controller to plan for it all the same",
        best->structure);
  }
  const auto shortfalls = section_of(antenna, std::move(study.tuned)).shortfalls;
  return shortfalls.empty() ? std::string()
                            : ": " + shortfalls[0].infeasible + " " + shortfalls[0].closest;
}

// The recommended controller; its structure and bounds go into the report.
control::Controller recommended(const io::DesignedAntenna& designed,
                                const CommissionOptions& options, CommissionReport& report) {
  design::TuneOptions tuning;
  if (!options.structure.empty()) {
    tuning.structures = structure_option(designed.antenna, {options.structure});
  }
  tuning.starts = options.starts;
  tuning.seed = options.seed;
  tuning.threads = options.threads;
  tuning.interrupted = options.interrupted;
  if (options.progress) {
    tuning.progress = [&](std::size_t done, std::size_t all) {
      options.progress("tuning", done, all);
    };
  }
  design::ControllerStudy study = study_controllers(designed.mission, designed.ensemble, tuning);
  if (options.interrupted && options.interrupted()) throw Interrupted("interrupted by the user");
  const TunedController* controller = commissionable(study);
  if (controller == nullptr) {
    report.structure = fmt::format("{}", fmt::join(study.tuned.structures, ", "));
    throw InfeasibleRequirement(fmt::format(
        "commission: no controller of {} is recommended that meets its constraints on every "
        "ensemble member{}",
        report.structure, why_none(designed.antenna, std::move(study))));
  }
  report.structure = controller->structure;
  report.bounds = about_bounds(study.tuned, io::GainUnits(designed.antenna), {controller});
  return controller->design.tuning.controller;
}

bool names_file(const CommissionOptions& options) {
  return !options.controller_path.empty() ||
         (options.gains.size() == 1 && options.gains.front().find('=') == std::string::npos);
}

control::Controller target_of(const io::DesignedAntenna& designed, const CommissionOptions& options,
                              CommissionReport& report) {
  if (report.tuned) return recommended(designed, options, report);
  if (options.controller) {
    if (options.structure.empty()) report.structure = options.controller->structure.name();
    return *options.controller;
  }
  if (!names_file(options)) {
    return io::controller_by_key(designed.antenna, report.structure, options.gains);
  }
  ControllerOptions named;
  named.structure = options.structure;
  named.controller_path = options.controller_path;
  if (!options.gains.empty()) named.gains = options.gains.front();
  ChosenController chosen = named_controller(designed.antenna, named).value();
  report.structure = chosen.structure;
  return std::move(chosen.controller);
}

// Before the work: a misspelt name must not cost a tuning.
std::vector<design::StageRecord> read_records(const io::Case& antenna,
                                              const CommissionOptions& options,
                                              std::vector<RecordedStage>& stages) {
  std::vector<design::StageRecord> records;
  for (const auto& [number, file] : options.records) {
    if (number < 1) throw InvalidInput("--record: expected the number of a stage, from 1, found 0");
    io::ServoRecordNotes notes;
    records.push_back({number - 1, io::read_servo_record(antenna, file, notes)});
    stages.push_back({{}, file, reading_of(notes)});
  }
  return records;
}

void add_stages(const io::DesignedAntenna& designed, const CommissionOptions& options,
                const design::CommissionStudy& study, std::vector<design::StageRecord> records,
                CommissionReport& report) {
  design::StageStudyOptions stages;
  stages.seed = options.seed;
  stages.threads = options.threads;
  stages.rms_allowance = report.options.rms_allowance;
  stages.stop = options.interrupted;
  if (options.progress) {
    stages.progress = [progress = options.progress](std::size_t done, std::size_t all) {
      progress("trying stages", done, all);
    };
  }
  stages.motors = static_cast<double>(designed.antenna.motor->count);
  stages.fresh_plants = options.plants;
  stages.records = std::move(records);
  design::StageStudy found = study_stages(designed.mission, designed.distribution, study, stages);
  report.trials = std::move(found.trials);
  report.faults = std::move(found.faults);
  report.update = std::move(found.update);
  for (std::size_t i = 0; i < found.records.size(); ++i) {
    RecordedStage& record = report.records[i];
    static_cast<design::RecordedStage&>(record) = std::move(found.records[i]);
    std::ranges::copy(record.measurement.remarks, std::back_inserter(record.remarks));
  }
}

}  // namespace

CommissionReport plan_commission(const io::DesignedAntenna& designed,
                                 const CommissionOptions& options) {
  const io::Case& antenna = designed.antenna;
  const design::PlantEnsemble& ensemble = designed.ensemble;
  if (options.before.empty() != options.after.empty()) {
    throw InvalidInput(
        "commission: expected both --before and --after, or neither: one record alone shows no "
        "change");
  }
  CommissionReport report;
  report.case_path = antenna.path;
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.seed = options.seed;
  report.tuned = options.gains.empty() && options.controller_path.empty() && !options.controller;
  report.structure = report.tuned ? options.structure : structure_of_gains(options);
  report.ensemble_source = to_string(ensemble.source);
  report.ensemble_size = ensemble.members.size();
  report.wind_speed = designed.mission.wind.mean_speed;
  report.wind_model = antenna.wind->model;
  report.gear_ratio = gear_ratio(designed.mission.antenna);
  report.before = options.before;
  report.after = options.after;
  report.assumed = assumed_inputs(antenna, {.valve_stroke = true});
  report.options.largest_step = options.largest_step;
  report.options.threads = options.threads;
  report.options.stop = options.interrupted;
  if (options.progress) {
    report.options.progress = [progress = options.progress](std::size_t done, std::size_t all) {
      progress("planning", done, all);
    };
  }
  report.move = design::commissioning_move(designed.mission);
  report.units = plant_units(antenna, designed.mission);
  auto records = read_records(antenna, options, report.records);
  if (!options.structure.empty()) io::check_structure(antenna, options.structure);
  if (!options.before.empty()) {
    for (auto& compared :
         io::compare_records_of(antenna, options.before, options.after, options.threads)) {
      report.comparisons.push_back({std::move(compared), std::nullopt});
    }
  }
  // What the records say of work that is done does not depend on a plan.
  const auto without_plan = [&](const std::exception& error) {
    if (report.comparisons.empty()) throw;
    report.failure = std::current_exception();
    report.no_plan = error.what();
  };
  try {
    const control::Controller target = target_of(designed, options, report);
    const design::CommissionStudy study =
        study_commission(designed.mission, ensemble, target, report.options, options.seed);
    report.plan = study.plan;
    report.limit_cycle = study.limit_cycle;
    for (auto& channel : report.comparisons) {
      channel.predicted = predicted_ratio(report.plan, channel.quantity);
    }
    report.sheets = make_sheets(antenna, report, study);
    add_stages(designed, options, study, std::move(records), report);
  } catch (const InfeasibleRequirement& error) {
    without_plan(error);
  } catch (const NumericalFailure& error) {
    without_plan(error);
  }
  report.conclusions = conclude(report, antenna);
  report.figures = commission_figures(report);
  return report;
}

}  // namespace boresight::app
