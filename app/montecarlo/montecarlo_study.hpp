#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/document/document.hpp>
#include <boresight/app/montecarlo/montecarlo_section.hpp>
#include <boresight/app/montecarlo/ranks.hpp>
#include <boresight/app/tune/chosen_controller.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

struct MonteCarloArguments {
  std::string case_path;
  Outputs outputs;
  std::string csv_path;         // of every plant; empty: none
  std::string checkpoint_path;  // empty: none
  std::uint64_t plants = 10000;
  ControllerOptions controller;
  bool retune = false;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// A finished or interrupted run: every plant and what they amount to.
struct MonteCarloOutcome {
  std::shared_ptr<const design::PlantDistribution> distribution;
  std::unique_ptr<design::MonteCarloRun> run;
  MonteCarloSection section;
};

/// Samples plants from the uncertainty that the case's records leave, or from its ranges. Evaluates
/// one controller on all of them, distributed over threads and ranks. Resumes from the checkpoint
/// if there is one, and writes it every few seconds. The result does not depend on the number of
/// threads, ranks or interruptions. Rank 0 returns the outcome; an error on one rank is thrown on
/// every rank.
/// @throws InvalidInput for invalid arguments or cases; InfeasibleRequirement if no stable
/// controller is found; Interrupted before the first block is complete; NumericalFailure for a
/// plant that cannot be evaluated.
MonteCarloOutcome run_montecarlo(const MonteCarloArguments& arguments, Ranks& ranks,
                                 const std::function<bool()>& interrupted);

/// A few sentences that say what the numbers mean.
std::vector<std::string> conclude(const MonteCarloSection& section);

/// "stable", "unstable" or "undecided".
std::string_view stability_text(design::StabilityBasis stability_basis);

/// The members of the JSON report; docs/montecarlo.schema.json is made of it.
void describe(io::Visitor& v, const MonteCarloSection& section);
/// The report; as text for a terminal; as JSON; every plant as CSV.
Document document_of(const MonteCarloSection& section);
std::string to_text(const MonteCarloSection& section);
std::string to_json(const MonteCarloSection& section);
std::string to_csv(const MonteCarloOutcome& outcome);

}  // namespace boresight::app
