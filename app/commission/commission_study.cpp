#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/commission/commission_wording.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/io/campaign/compared_records.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/exchange/gains_by_key.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::string structure_of_gains(const CommissionOptions& options) {
  return options.structure.empty() ? "DPF" : options.structure;
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
  // One that limit-cycles is planned for with a warning.
  const TunedController* controller = commissionable(study);
  if (controller == nullptr) {
    report.structure = fmt::format("{}", fmt::join(study.tuned.structures, ", "));
    const auto shortfalls = section_of(designed.antenna, std::move(study.tuned)).shortfalls;
    throw InfeasibleRequirement(fmt::format(
        "commission: no controller of {} meets its constraints on every ensemble member{}",
        report.structure,
        shortfalls.empty() ? std::string()
                           : ": " + shortfalls[0].infeasible + " " + shortfalls[0].closest));
  }
  report.structure = controller->structure;
  report.bounds = about_bounds(study.tuned, io::GainUnits(designed.antenna), {controller});
  return controller->design.tuning.controller;
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
  report.tuned = options.gains.empty();
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
    const control::Controller target =
        report.tuned ? recommended(designed, options, report)
                     : io::controller_by_key(antenna, report.structure, options.gains);
    const design::CommissionStudy study =
        study_commission(designed.mission, ensemble, target, report.options, options.seed);
    report.plan = study.plan;
    report.limit_cycle = study.limit_cycle;
    for (auto& channel : report.comparisons) {
      channel.predicted = predicted_ratio(report.plan, channel.quantity);
    }
    report.sheets = make_sheets(antenna, report, study.steps);
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
