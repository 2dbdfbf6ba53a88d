#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/identify/campaign_identification.hpp>
#include <boresight/app/identify/identified_case.hpp>
#include <boresight/app/tune/plant_members.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t identified_members = 30;

int run(CommissionArguments arguments) {
  arguments.options.threads = all_or(arguments.options.threads);
  require_json_path(arguments.json_path);
  watch_for_interrupt();
  try {
    const CommissionReport report = commission_case(arguments, interrupt_requested);
    deliver(
        arguments.json_path, [&] { return to_text(report); }, [&] { return to_json(report); });
  } catch (const Interrupted&) {
    // Half a plan is none.
    fmt::print(stderr, "boresight: interrupted before the plan was whole\n");
    return interrupted;
  }
  return done;
}

}  // namespace

CommissionReport commission_case(const CommissionArguments& arguments,
                                 const std::function<bool()>& interrupted) {
  Case antenna = read_case(arguments.case_path);
  CommissionOptions options = arguments.options;
  options.interrupted = interrupted;
  PlantEnsemble ensemble;
  if (!antenna.campaign.records.empty()) {
    StudyOptions study;
    study.seed = options.seed;
    study.threads = options.threads;
    study.progress = [&](std::size_t, std::size_t) {
      if (interrupted && interrupted()) throw Interrupted("interrupted by the user");
    };
    const CampaignSection campaign = identify_campaign(antenna, study);
    if (campaign.grey_box) {
      const Case stated = antenna;
      antenna = with_identified(stated, campaign.grey_box->estimate);
      ensemble = {"drawn from what the records leave open",
                  identified_ensemble(stated, campaign.grey_box->draws, identified_members)};
    }
  }
  if (ensemble.members.empty()) {
    ensemble = {"drawn from the ranges of the case", plant_members(antenna, options.seed)};
  }
  return plan_commission(antenna, ensemble, options);
}

Subcommand add_commission(CLI::App& program) {
  const auto arguments = std::make_shared<CommissionArguments>();
  CLI::App* sub = program.add_subcommand("commission",
                                         "plan the way from the gains found to the tuned ones in "
                                         "stages, with checks and abort limits; "
                                         "compare records before and after");
  auto& options = arguments->options;
  add_case(*sub, arguments->case_path);
  sub->add_option("--structure", options.structure,
                  "the loop structure to commission, tuned robustly, as `boresight tune` takes it")
      ->capture_default_str();
  sub->add_option("--gains", options.gains,
                  "its gains in the place of tuned ones, KEY=VALUE each, all of them")
      ->expected(1, 100);
  sub->add_option("--largest-step", options.largest_step,
                  "largest factor on a gain from one stage to the next")
      ->check(CLI::Range(1.01, 10.0))
      ->capture_default_str();
  sub->add_option("--before", options.before, "a record of the case made before the work");
  sub->add_option("--after", options.after, "one made after it, to be compared with that");
  sub->add_option("--starts", options.starts, "random starts of the tuning")
      ->check(CLI::Range(1, 100000));
  add_json(*sub, arguments->json_path);
  add_seed(*sub, options.seed);
  add_threads(*sub, options.threads);
  return {sub, [arguments] { return run(*arguments); }};
}

}  // namespace boresight::app
