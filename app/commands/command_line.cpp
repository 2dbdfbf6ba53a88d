#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/command_line.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/commands/tune_command.hpp>
#include <boresight/app/identify/campaign_identification.hpp>
#include <boresight/app/identify/identified_case.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/simulate/antenna_tests.hpp>

namespace boresight::app {
namespace {

enum ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  infeasible = 3,
  numerical = 4,
  interrupted = 130
};

// A signal handler can reach nothing else.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupt_requested = 0;

void request_interrupt(int /*signal*/) {
  interrupt_requested = 1;
}

constexpr const char* unwritable_output = "standard output: cannot be written to";

struct Arguments {
  std::string case_path;
  std::string json_path;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

using Section = std::function<void(const Case&, const StudyOptions&, Report&)>;

struct Command {
  const char* name = "";
  const char* description = "";
  Section run;
  const char* work = "tuning and verifying";  // as its progress line begins
};

void fill_identification(const Case& antenna, const StudyOptions& options, Report& report) {
  report.identification = identify(antenna, options);
  if (!antenna.campaign.records.empty()) report.campaign = identify_campaign(antenna, options);
}

void fill_redesign(const Case& antenna, const StudyOptions& options, Report& report) {
  fill_identification(antenna, options, report);
  report.audit = audit(antenna);
  // With records the redesign is of the drive that they show, and is judged on what they leave
  // open.
  Case designed = antenna;
  if (report.campaign && report.campaign->grey_box) {
    designed = with_identified(antenna, report.campaign->grey_box->estimate);
    report.assumed = assumed_inputs(designed);
  }
  report.plant = describe_plant(designed);
  if (report.campaign && report.campaign->grey_box) {
    report.plant->records = report.campaign->grey_box->records.size();
  }
  redesign(designed, options, report);
  if (report.tuning && report.tuning->design.tuning.status == design::TuningStatus::optimal) {
    const auto& law = report.tuning->design.tuning.law;
    report.time_domain = verify_in_time_domain(designed, make_problem(designed), law,
                                               law.structure.name(), options.seed, options.threads);
  }
  if (report.campaign && report.campaign->grey_box && report.tuning) {
    report.tuning->ensemble =
        judge_identified(antenna, designed, *report.campaign->grey_box, *report.tuning, options);
  }
  report.conclusions = conclude(report);
}

const std::vector<Command>& commands() {
  static const std::vector<Command> list{
      {"redesign", "identify, audit, model, tune, match and conclude: the whole report",
       fill_redesign},
      {"audit", "recompute every derived number the case states; list what does not follow",
       [](const Case& antenna, const StudyOptions&, Report& report) {
         report.audit = audit(antenna);
         if (antenna.campaign.records.empty()) return;
         report.conclusions.push_back(fmt::format(
             "The case has {} records, which an audit does not open: `boresight identify {}` lists "
             "the numbers that they contradict.",
             antenna.campaign.records.size(), report.case_path));
       }},
      {"identify",
       "inertia and motor-to-load ratio by each method, with intervals; of a case with records all "
       "that they say of the drive",
       fill_identification, "identifying"},
      {"model", "the linear plant: parameters, poles, what each mode is",
       [](const Case& antenna, const StudyOptions&, Report& report) {
         report.plant = describe_plant(antenna);
       }},
      {"match", "re-tune at each number of flywheel disks and at ratio 1",
       [](const Case& antenna, const StudyOptions& options, Report& report) {
         report.matching = match_inertia(antenna, options);
         report.conclusions = conclude(report);
       }}};
  return list;
}

int run(const Command& command, const Arguments& arguments) {
  const Case antenna = read_case(arguments.case_path);
  // Before the work, not after it.
  const bool json_file = !arguments.json_path.empty() && arguments.json_path != "-";
  if (json_file) require_writable(arguments.json_path);
  StudyOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads != 0 ? arguments.threads
                                           : std::max(1U, std::thread::hardware_concurrency());
  Report report;
  report.command = command.name;
  report.title = antenna.title;
  report.axis = antenna.axis;
  report.case_path = arguments.case_path;
  report.seed = arguments.seed;
  report.assumed = assumed_inputs(antenna);
  {
    ProgressLine progress(command.work);
    options.progress = [&](std::size_t finished, std::size_t all) {
      progress.show(finished, all);
      if (interrupt_requested != 0) throw Interrupted("interrupted by the user");
    };
    std::signal(SIGINT, request_interrupt);
    try {
      command.run(antenna, options, report);
    } catch (const Interrupted&) {
      report.interrupted = true;
    }
  }
  if (arguments.json_path == "-") {
    fmt::print("{}", to_json(report));
  } else {
    if (json_file) write_atomically(arguments.json_path, to_json(report));
    fmt::print("{}", to_text(report));
  }
  if (std::fflush(stdout) != 0) throw InvalidInput(unwritable_output);
  if (report.interrupted) return interrupted;
  if (report.tuning && report.tuning->design.tuning.status != design::TuningStatus::optimal) {
    fmt::print(stderr, "boresight: no control law meets the hard goals of {}\n",
               arguments.case_path);
    return infeasible;
  }
  if (report.tuning && !report.tuning->design.verification.passed) {
    fmt::print(stderr, "boresight: the best law found fails its verification: {}\n",
               report.tuning->design.verification.failure);
    return numerical;
  }
  return done;
}

int run(const SimulateArguments& arguments) {
  std::signal(SIGINT, request_interrupt);
  const auto outcome = simulate_tests(arguments, [] { return interrupt_requested != 0; });
  if (arguments.json_path == "-") {
    fmt::print("{}", to_json(outcome.report));
  } else {
    if (!arguments.json_path.empty()) {
      write_atomically(arguments.json_path, to_json(outcome.report));
    }
    fmt::print("{}", to_text(outcome.report));
  }
  if (std::fflush(stdout) != 0) throw InvalidInput(unwritable_output);
  if (outcome.failure) std::rethrow_exception(outcome.failure);
  return outcome.report.interrupted ? interrupted : done;
}

int run(TuneArguments arguments) {
  if (arguments.threads == 0) arguments.threads = std::max(1U, std::thread::hardware_concurrency());
  std::signal(SIGINT, request_interrupt);
  const Report report = tune_case(arguments, [] { return interrupt_requested != 0; });
  if (arguments.json_path == "-") {
    fmt::print("{}", to_json(report));
  } else {
    if (!arguments.json_path.empty()) write_atomically(arguments.json_path, to_json(report));
    fmt::print("{}", to_text(report));
  }
  if (std::fflush(stdout) != 0) throw InvalidInput(unwritable_output);
  if (report.interrupted) return interrupted;
  if (report.measured) {
    if (report.measured->any_confident()) return done;
    fmt::print(stderr, "boresight: no law meets its goals within the measurement's confidence\n");
    return infeasible;
  }
  if (!report.tuned) return internal_error;
  for (const auto& shortfall : report.tuned->shortfalls) {
    fmt::print(stderr, "boresight: {}: {} {}\n", arguments.case_path, shortfall.infeasible,
               shortfall.closest);
  }
  if (!report.tuned->shortfalls.empty()) return infeasible;
  if (report.tuned->unverified) {
    fmt::print(stderr, "boresight: no law that meets its goals passes its verification\n");
    return numerical;
  }
  return done;
}

void add_seed(CLI::App* sub, std::uint64_t& seed) {
  sub->add_option("--seed", seed, "first seed of the searches and draws")
      ->check(CLI::Range(0.0, 1e15))
      ->capture_default_str();
}

CLI::App* add_simulate(CLI::App& program, SimulateArguments& arguments) {
  CLI::App* sub = program.add_subcommand(
      "simulate", "run tests on the nonlinear antenna and write what its recorder would");
  sub->add_option("CASE", arguments.case_path, "case file (TOML), see docs/case-file.md")
      ->required();
  sub->add_option("TEST", arguments.tests,
                  fmt::format("what to run: {}", fmt::join(simulated_test_names(), ", ")))
      ->required();
  sub->add_option("--json", arguments.json_path,
                  "also write the report as JSON to this file; '-' writes JSON only, to standard "
                  "output");
  sub->add_option("--folder", arguments.folder, "where records TEST.csv are written")
      ->capture_default_str();
  sub->add_option("--sample-rate", arguments.sample_rate,
                  "samples a second of the records (default: as the case has it); slosh is sampled "
                  "at 1000 or more")
      ->check(CLI::Range(1.0, 1e5));
  add_seed(sub, arguments.seed);
  return sub;
}

CLI::App* add_tune(CLI::App& program, TuneArguments& arguments) {
  CLI::App* sub = program.add_subcommand(
      "tune", "tune loop structures for the least beam rms in wind, robustly and verified");
  sub->add_option("CASE", arguments.case_path, "case file (TOML), see docs/case-file.md")
      ->required();
  sub->add_option("--structure", arguments.structures,
                  "what to tune, one or several: PI-0, PI, DPF, LL, FULL, with +N (notch) and +C "
                  "(compliance compensation) behind it, or a [[loop]] of the case")
      ->expected(1, 100);
  sub->add_option("--goal", arguments.goals,
                  "KEY=VALUE of [goals] in the place of the case's, one or several")
      ->expected(1, 100);
  sub->add_option("--speed", arguments.speeds,
                  "mean wind speeds to tune for, such as \"10 m/s\" (default: the design speed)")
      ->expected(1, 100);
  sub->add_option("--measured", arguments.measured_record,
                  "tune on the response that this record of the case shows, without a model: see "
                  "docs/measured-tuning.md");
  sub->add_option("--starts", arguments.starts, "random starts of each search")
      ->check(CLI::Range(1, 100000));
  sub->add_option("--json", arguments.json_path,
                  "also write the report as JSON to this file; '-' writes JSON only, to standard "
                  "output");
  add_seed(sub, arguments.seed);
  sub->add_option("--threads", arguments.threads,
                  "threads to work on; results do not depend on it (default: all)");
  return sub;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App program{"Redesigns the servo of a large antenna from measured data.", "boresight"};
  program.set_version_flag("--version", std::string("boresight ") + BORESIGHT_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 internal error, 2 bad input, 3 goals infeasible, 4 numerical failure, "
      "130 interrupted.\n"
      "Example: boresight redesign cases/dss14-70m/case.toml --json report.json");
  Arguments arguments;
  for (const auto& command : commands()) {
    CLI::App* sub = program.add_subcommand(command.name, command.description);
    sub->add_option("CASE", arguments.case_path, "case file (TOML), see docs/case-file.md")
        ->required();
    sub->add_option("--json", arguments.json_path,
                    "also write the report as JSON to this file; '-' writes JSON only, to standard "
                    "output");
    add_seed(sub, arguments.seed);
    sub->add_option("--threads", arguments.threads,
                    "threads to work on; results do not depend on it (default: all)");
  }
  SimulateArguments simulation;
  const CLI::App* simulate = add_simulate(program, simulation);
  TuneArguments tuning;
  const CLI::App* tune = add_tune(program, tuning);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : bad_input;
  }
  try {
    if (simulate->parsed()) return run(simulation);
    if (tune->parsed()) return run(tuning);
    for (const auto& command : commands()) {
      if (program.got_subcommand(command.name)) return run(command, arguments);
    }
  } catch (const InvalidInput& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return bad_input;
  } catch (const InfeasibleRequirement& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return infeasible;
  } catch (const NumericalFailure& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return numerical;
  } catch (const std::system_error&) {
    // The formatting library's word for a full or closed standard output.
    fmt::print(stderr, "boresight: {}\n", unwritable_output);
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "boresight: internal error: {}\n", error.what());
  }
  return internal_error;
}

}  // namespace boresight::app
