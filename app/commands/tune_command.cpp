#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/tune_command.hpp>
#include <boresight/app/identify/campaign_identification.hpp>
#include <boresight/app/identify/identified_case.hpp>
#include <boresight/app/io/wording.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/tune/plant_members.hpp>
#include <boresight/app/tune/tune_limit.hpp>
#include <boresight/app/tune/tune_study.hpp>

namespace boresight::app {
namespace {

// As many as the reference ensemble has.
constexpr std::size_t identified_members = 30;

std::vector<double> read_speeds(const std::vector<std::string>& texts) {
  std::vector<double> speeds;
  for (const auto& text : texts) {
    try {
      speeds.push_back(parse_quantity(text, Kind::speed).value);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("--speed {}: {}", quoted(text), error.what()));
    }
  }
  return speeds;
}

// The best law that meets all it must, robust ones before nominal ones.
const TunedLaw* best_law(const TuneSection& section) {
  const TunedLaw* best = nullptr;
  for (const auto& row : section.laws) {
    if (row.tuned_for == TunedFor::present || !row.usable()) continue;
    const bool first_choice = best == nullptr || row.tuned_for > best->tuned_for;
    if (first_choice || (row.tuned_for == best->tuned_for && row.wind_speed == best->wind_speed &&
                         row.beam_rms < best->beam_rms)) {
      best = &row;
    }
  }
  return best;
}

}  // namespace

Report tune_case(const TuneArguments& arguments, const std::function<bool()>& interrupted) {
  Case antenna = read_case(arguments.case_path);
  change_goals(antenna.goals, arguments.goals);
  TuneOptions options;
  options.structures = arguments.structures;
  options.wind_speeds = read_speeds(arguments.speeds);
  options.starts = arguments.starts;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  for (const auto& name : options.structures) {
    try {
      loop_structure(antenna.loops, name);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("--structure: {}", error.what()));
    }
  }
  if (!arguments.json_path.empty() && arguments.json_path != "-") {
    require_writable(arguments.json_path);
  }

  Report report;
  report.command = "tune";
  report.title = antenna.title;
  report.axis = antenna.axis;
  report.case_path = arguments.case_path;
  report.seed = arguments.seed;
  if (!arguments.measured_record.empty()) {
    MeasuredStudyOptions study;
    study.record = arguments.measured_record;
    study.structures = arguments.structures;
    study.starts = arguments.starts;
    study.seed = arguments.seed;
    study.interrupted = interrupted;
    report.measured = tune_measured(antenna, study);
    report.conclusions = conclude(*report.measured);
    report.assumed = assumed_inputs(antenna);
    report.interrupted = interrupted && interrupted();
    return report;
  }
  ProgressLine progress("tuning and verifying");
  PlantEnsemble ensemble;
  if (antenna.campaign.records.empty()) {
    ensemble = {"drawn from the ranges of the case", plant_members(antenna, arguments.seed)};
  } else {
    StudyOptions study;
    study.seed = arguments.seed;
    study.threads = arguments.threads;
    study.progress = [&](std::size_t, std::size_t) {
      if (interrupted && interrupted()) throw Interrupted("interrupted by the user");
    };
    try {
      const CampaignSection campaign = identify_campaign(antenna, study);
      if (campaign.grey_box) {
        const Case stated = antenna;
        antenna = with_identified(stated, campaign.grey_box->estimate);
        ensemble = {"drawn from what the records leave open",
                    identified_ensemble(stated, campaign.grey_box->draws, identified_members)};
      }
    } catch (const Interrupted&) {
      report.interrupted = true;
      report.assumed = assumed_inputs(antenna);
      return report;
    }
    if (ensemble.members.empty()) {
      ensemble = {"drawn from the ranges of the case", plant_members(antenna, arguments.seed)};
    }
  }
  report.assumed = assumed_inputs(antenna);
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  report.tuned = tune_structures(antenna, ensemble, options);
  report.conclusions = conclude(*report.tuned);
  report.interrupted = interrupted && interrupted();
  const TunedLaw* best = best_law(*report.tuned);
  if (best != nullptr && !report.interrupted) {
    report.limit =
        pointing_limit_of(antenna, *report.tuned, ensemble, best->wind_speed, arguments.threads);
    auto problem = make_problem(antenna);
    problem.wind.mean_speed = best->wind_speed;
    report.time_domain =
        verify_in_time_domain(antenna, problem, best->design.tuning.law,
                              fmt::format("{}, {}", best->structure, to_string(best->tuned_for)),
                              arguments.seed, arguments.threads);
    if (report.time_domain) report.conclusions.push_back(conclude(*report.time_domain));
  }
  return report;
}

}  // namespace boresight::app
