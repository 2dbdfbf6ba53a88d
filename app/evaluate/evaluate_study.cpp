#include <fmt/format.h>

#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/uncertainty/distribution_source.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// What the files say of it; none: of the antenna as it is.
Candidate described(const io::ProposedCase& proposed, const io::Proposal* proposal) {
  Candidate candidate;
  if (proposal == nullptr) {
    candidate.description = "the antenna of the case, re-tuned";
    return candidate;
  }
  candidate.path = proposal->path;
  candidate.description = proposal->description;
  if (proposal->cost) {
    const io::Quantity& amount = proposal->cost->amount;
    if (amount.uncertainty_given) candidate.cost_uncertainty = amount.standard_uncertainty;
    candidate.cost_assumed = amount.basis == io::Basis::assumed;
  }
  candidate.risks = proposal->risks;
  candidate.changes = proposed.changes;
  candidate.derived_quantities = proposed.derived_quantities;
  return candidate;
}

std::string_view reason(design::NotDrawn why) {
  switch (why) {
    case design::NotDrawn::no_stable_controller:
      return "has no stable controller";
    case design::NotDrawn::run_not_completed:
      return "did not complete its run on the nonlinear antenna";
  }
  return "";
}

std::string_view reason(design::TestsNotValued why) {
  switch (why) {
    case design::TestsNotValued::fewer_than_two_fit:
      return "fewer than two candidates are eligible";
    case design::TestsNotValued::unstable_on_some_samples:
      return "a candidate is unstable on some samples, so its loss is infinite";
  }
  return "";
}

DecisionSection worded(design::ProposalDecision decision, const std::vector<Candidate>& candidates,
                       const design::PlantDistribution& distribution) {
  DecisionSection section{std::move(decision), source_text(distribution), {}, {}};
  for (const auto input : section.uncertain) section.inputs.emplace_back(to_string(input));
  for (const auto& one : section.left_out) {
    section.notes.push_back(
        fmt::format("{} {} and is excluded.", candidates[one.candidate].name, reason(one.reason)));
  }
  if (section.uncertain.empty()) {
    section.notes.emplace_back("The plant has no uncertain input: there are no sensitivities.");
  }
  if (!section.undecided.empty()) {
    section.notes.push_back(
        fmt::format("Sensitivities of the difference between the two best are not available: {}",
                    section.undecided));
  }
  if (section.tests_not_valued) {
    section.notes.push_back(
        fmt::format("Value of tests not computed: {}.", reason(*section.tests_not_valued)));
  }
  return section;
}

}  // namespace

EvaluateSection evaluate_proposals(const io::Case& antenna,
                                   const std::vector<io::Proposal>& proposals,
                                   const design::PlantUncertainty& uncertainty,
                                   const EvaluateOptions& options) {
  const io::ComparedAntennas compared = compared_antennas(antenna, proposals, options.structures);
  const design::Mission& mission = compared.antennas.front().mission;
  EvaluateSection section;
  section.bands = mission.bands;
  section.budgets = mission.budgets;
  section.wind_speed = mission.wind.mean_speed;
  section.wind_model = mission.wind.model;
  section.wind_mast = antenna.wind->mast;
  section.climate = !mission.climate.empty();
  section.minimises_climate = mission.minimises_climate;
  section.currency = compared.currency;
  if (section.minimises_climate && !section.climate) {
    throw InvalidInput(
        "evaluate: expected [[wind.climate]] in the case for the goal rms_over = "
        "climate, found none");
  }
  design::ProposalStudy study = study_proposals(compared.antennas, uncertainty, options);
  section.starts = study.starts;
  section.ensemble_size = study.ensemble_size;
  section.ensemble_source = uncertainty.from_records ? "sampled from the identified distribution"
                                                     : "sampled from the ranges of the case";
  section.time_domain = study.time_domain;
  for (auto& design : study.candidates) {
    const std::size_t place = design.antenna;
    const io::ProposedCase& proposed = compared.cases[place];
    Candidate candidate = described(proposed, place == 0 ? nullptr : &proposals[place - 1]);
    static_cast<design::ProposedDesign&>(candidate) = std::move(design);
    const io::GainUnits units(proposed.antenna);
    for (const auto& controller : candidate.controllers) {
      candidate.gains.push_back(controller.ensemble
                                    ? units.texts(controller.design.tuning.controller)
                                    : std::vector<std::string>{});
    }
    section.candidates.push_back(std::move(candidate));
  }
  for (const std::size_t place : study.not_run) {
    section.not_run.push_back(compared.antennas[place].name);
  }
  if (!section.currency.empty()) section.front = std::move(study.front);
  if (study.decision) {
    section.decision =
        worded(std::move(*study.decision), section.candidates, uncertainty.distribution);
  } else if (!proposals.empty()) {
    section.not_run.emplace_back("probabilities, regrets and tests");
  }
  return section;
}

void add_assumed(const std::vector<io::Proposal>& proposals, std::vector<io::Quantity>& assumed) {
  const auto add = [&](const io::Proposal& proposal, const io::Quantity& quantity,
                       const std::string& key) {
    const bool uncertainty = quantity.uncertainty_source.starts_with("assumed");
    if (quantity.basis != io::Basis::assumed && !uncertainty) return;
    assumed.push_back(quantity);
    assumed.back().key = fmt::format("{}: {}", proposal.name, key);
  };
  for (const auto& proposal : proposals) {
    if (proposal.cost) add(proposal, proposal.cost->amount, "cost.amount");
    for (const auto& change : proposal.changes) add(proposal, change.number, change.key);
  }
}

}  // namespace boresight::app
