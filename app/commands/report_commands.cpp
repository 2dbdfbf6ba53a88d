#include <functional>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/report_commands.hpp>
#include <boresight/app/figures/record_figures.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/identify/first_tests.hpp>
#include <boresight/app/models/linear_models.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/studies/monte_carlo_study.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/files/write_atomically.hpp>

namespace boresight::app {
namespace {

struct Arguments {
  std::string case_path;
  Outputs outputs;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

using Section = std::function<void(const io::Case&, const StudyOptions&, Report&)>;

struct Command {
  const char* name = "";
  const char* description = "";
  Section run;
  bool has_models = false;
  const char* work = "tuning and verifying";  // as its progress line begins
};

void fill_identification(const io::Case& antenna, const StudyOptions& options, Report& report) {
  report.identification = identify(antenna, options);
  if (antenna.campaign->records.empty()) return;
  // Drawn before the methods run, which free what the files held.
  io::LoadedCampaign loaded = load_campaign(antenna, options.threads);
  const auto traces = campaign_traces(loaded);
  report.campaign = identify_campaign(antenna, std::move(loaded), options);
  report.superseded = superseded_inputs(antenna, *report.campaign);
  report.figures = record_figures(report.campaign->notes, traces);
}

// The recommended controller with fixed gains on the ensemble that it was tuned on. With records
// also on more samples of the same distribution, and its stability over the case's wider ranges.
void evaluate_on_ensemble(const io::DesignedAntenna& plant, const StudyOptions& options,
                          TuningSection& section) {
  constexpr std::size_t random_samples = 200;
  evaluate_on(plant.from_records ? io::drawn_members(plant.mission, plant.distribution,
                                                     options.seed, random_samples)
                                 : plant.ensemble.members,
              options.threads, section);
  if (!section.ensemble) return;
  // The samples of montecarlo.
  add_probabilities(
      plant.mission, plant.distribution,
      {.plants = 2000, .seed = options.seed, .retune = false, .threads = options.threads}, section);
  if (plant.from_records) {
    section.instability = design::instability(
        plant.mission, design::PlantDistribution::of_ranges(plant.mission),
        section.design.tuning.controller,
        {.plants = 1000, .seed = options.seed, .retune = false, .threads = options.threads});
  }
  section.ensemble_source =
      plant.from_records ? "sampled from the identified distribution" : "of the case's ensemble";
}

void fill_redesign(const io::Case& antenna, const StudyOptions& options, Report& report) {
  fill_identification(antenna, options, report);
  report.audit = audit_report(antenna);
  // With records the redesign is of the drive that they show, and is evaluated on what they leave
  // open.
  const io::DesignedAntenna plant = designed_antenna(antenna, report.campaign, options.seed);
  const io::Case& designed = plant.antenna;
  // A check of a guess that the records have replaced is no finding about the antenna.
  std::erase_if(report.audit->implausible, [&](const Implausibility& one) {
    return is_superseded(report.superseded, one.id);
  });
  report.plant = describe_plant(designed);
  if (report.campaign && report.campaign->grey_box) {
    report.plant->records = report.campaign->grey_box->records.size();
  }
  report.resonance = resonance_verdict(plant);
  report.assumed = assumed_inputs(designed);
  redesign(plant, options, report);
  if (report.time_domain) report.assumed = assumed_inputs(designed, {.time_runs = true});
  if (report.tuning) evaluate_on_ensemble(plant, options, *report.tuning);
  report.conclusions = conclude(report);
}

const std::vector<Command>& commands() {
  static const std::vector<Command> list{
      {"redesign", "identify, audit, model, tune, match and conclude: the whole report",
       fill_redesign, true},
      {"audit", "recompute every derived value of the case; list inconsistencies",
       [](const io::Case& antenna, const StudyOptions&, Report& report) {
         report.audit = audit_report(antenna);
         if (antenna.campaign->records.empty()) return;
         report.conclusions.push_back(
             fmt::format("The audit does not read the case's {} records: `boresight identify {}` "
                         "lists the values that they contradict.",
                         antenna.campaign->records.size(), report.case_path));
       }},
      {"identify",
       "inertia and motor-to-load ratio by each method, with intervals; with records, the whole "
       "drive model",
       [](const io::Case& antenna, const StudyOptions& options, Report& report) {
         fill_identification(antenna, options, report);
         report.assumed = identification_inputs(antenna);
         if (report.campaign) return;
         report.conclusions = first_tests(antenna);
         report.resonance = resonance_verdict(antenna);
         if (report.resonance && report.resonance->contradicts()) {
           report.conclusions.insert(report.conclusions.begin(),
                                     resonance_sentence(*report.resonance));
         }
         if (std::string unread = unread_resonance(report.resonance); !unread.empty()) {
           report.conclusions.push_back(std::move(unread));
         }
       },
       false, "identifying"},
      {"model", "the linear plant: parameters, poles, mode descriptions",
       [](const io::Case& antenna, const StudyOptions&, Report& report) {
         report.plant = describe_plant(antenna);
       },
       true}};
  return list;
}

int run(const Command& command, const Arguments& arguments) {
  const io::Case antenna = io::read_case(arguments.case_path);
  arguments.outputs.require_writable();
  StudyOptions options;
  options.seed = arguments.seed;
  options.threads = all_or(arguments.threads);
  Report report = begin_report(command.name, antenna, arguments.case_path, arguments.seed);
  report.assumed = assumed_inputs(antenna);
  {
    ProgressLine progress(command.work);
    options.progress = [&](std::size_t finished, std::size_t all) {
      progress.show(finished, all);
      if (interrupt_requested()) throw Interrupted("interrupted by the user");
    };
    watch_for_interrupt();
    try {
      command.run(antenna, options, report);
    } catch (const Interrupted&) {
      report.interrupted = true;
    }
  }
  for (auto& figure : report_figures(report)) report.figures.push_back(std::move(figure));
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); },
                             .mat = mat_of(report)});
  if (report.interrupted) return interrupted;
  if (report.command == "identify" && report.campaign && !io::recommended(*report.campaign)) {
    fmt::print(stderr, "boresight: {}: the records give no value to design on: {}\n",
               arguments.case_path, to_string(io::rejection(*report.campaign)));
    return numerical;
  }
  if (report.tuning && report.tuning->design.tuning.status != design::TuningStatus::optimal) {
    fmt::print(stderr, "boresight: no controller meets the constraints of {}\n",
               arguments.case_path);
    return infeasible;
  }
  if (report.tuning && !report.tuning->design.verification.passed) {
    fmt::print(stderr, "boresight: the best controller found fails its verification: {}\n",
               report.tuning->design.verification.failure);
    return numerical;
  }
  const auto unmet =
      report.tuning ? unmet_needs(*report.tuning, report.time_domain) : std::vector<std::string>{};
  for (const auto& sentence : unmet) {
    fmt::print(stderr, "boresight: {}: {}\n", arguments.case_path, sentence);
  }
  return unmet.empty() ? done : infeasible;
}

}  // namespace

std::vector<Subcommand> add_report_commands(CLI::App& program) {
  std::vector<Subcommand> added;
  for (const auto& command : commands()) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* options = program.add_subcommand(command.name, command.description);
    add_case(*options, arguments->case_path);
    add_outputs(*options, arguments->outputs);
    if (command.has_models) add_mat(*options, arguments->outputs);
    add_seed(*options, arguments->seed);
    add_threads(*options, arguments->threads);
    added.push_back(
        {options, [&command, arguments] { return run(command, *arguments); }, &arguments->outputs});
  }
  return added;
}

}  // namespace boresight::app
