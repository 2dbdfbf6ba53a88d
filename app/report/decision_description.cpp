#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/evaluate_report.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm known{.finite = true};
// Losses are kept in millidegrees.
constexpr io::KeyUnit millidegree_as_kept{.suffix = "mdeg"};

// One of the options with all that is said of it.
struct NamedOption {
  std::string name;
  design::OptionStatistics statistics;
  double front_fraction = 0.0;
  CandidateSamples random_samples;
};

struct NamedPair {
  std::string first, second;
  design::PairComparison pair;
};

struct NamedStructures {
  std::string first, second;
  std::vector<SameStructure> structures;
};

// What is uncertain, and what it does to the choice.
struct DecidingInput {
  std::string name;
  std::optional<design::TornadoBar> tornado;
  std::optional<numerics::InputIndices> sobol;
  std::optional<design::InputValue> test;
};

void describe_probability(io::Visitor& v, std::string_view key,
                          const design::Probability& probability, std::string_view meaning) {
  v.group(key, meaning, [&] {
    v.defined_as("probability", "A probability with its 95 % interval, for the number of samples.");
    v.number("value", probability.value, unit::ratio, "The probability.", known);
    v.number("lower_95", probability.lower, unit::ratio, "Lower end.", known);
    v.number("upper_95", probability.upper, unit::ratio, "Upper end.", known);
  });
}

void describe_index(io::Visitor& v, std::string_view key, const numerics::EstimatedIndex& index,
                    std::string_view meaning) {
  v.group(key, meaning, [&] {
    v.defined_as("sobol_index", "A Sobol' index with its 95 % interval, not cut off at 0 and 1.");
    v.number("value", index.value, unit::ratio, "The index.");
    v.number("standard_error", index.standard_error, unit::ratio,
             "Standard error over the randomisations.");
    v.number("lower_95", index.lower, unit::ratio, "Lower end.");
    v.number("upper_95", index.upper, unit::ratio, "Upper end.");
  });
}

void describe_gain(io::Visitor& v, double gain, double error) {
  v.number("mean_gain", gain, millidegree_as_kept, "Of second less first.");
  v.number("gain_error", error, millidegree_as_kept, "Standard error of it.");
}

void describe_option(io::Visitor& v, const NamedOption& option) {
  const auto& statistics = option.statistics;
  v.text("name", option.name, "Its name.");
  v.number("mean", statistics.mean, millidegree_as_kept, "Mean rms; null if unstable on a sample.");
  v.number("standard_error", statistics.standard_error, millidegree_as_kept, "Of the mean.");
  v.list("quantiles", statistics.quantiles, "Over the samples.",
         [&](const design::Quantile& quantile) {
           v.number("fraction", quantile.fraction, unit::ratio, "Fraction below.", known);
           v.number("value", quantile.value, millidegree_as_kept, "The quantile.");
           v.number("lower_95", quantile.lower, millidegree_as_kept, "Lower end of its interval.");
           v.number("upper_95", quantile.upper, millidegree_as_kept, "Upper end.");
         });
  describe_probability(v, "is_best", statistics.best, "That it has the least rms of all.");
  v.number("expected_regret", statistics.expected_regret, millidegree_as_kept,
           "Mean loss against the best of each sample.");
  v.number("regret_error", statistics.regret_error, millidegree_as_kept, "Standard error of it.");
  v.number("on_pareto_front_fraction", option.front_fraction, unit::ratio,
           "Fraction of samples in which it is on the Pareto front of cost and rms; null without a "
           "cost.");
  describe_probability(v, "outside_goals", option.random_samples.outside_goals,
                       "Unstable, or a peak or the control effort beyond its goal.");
  describe_probability(v, "unstable", option.random_samples.unstable, "Of the loop.");
}

void describe_same_structure(io::Visitor& v, const SameStructure& one) {
  v.text("structure", one.structure, "As the user names it.");
  describe_probability(v, "first_is_better", one.better, "Less rms, ties counted half.");
  describe_gain(v, one.mean_gain, one.gain_error);
  v.flag("first_usable", one.first_usable,
         "Whether the first's controller of that structure meets every goal, passes its "
         "verification and "
         "does not limit-cycle.");
  v.flag("second_usable", one.second_usable, "Same of the second.");
}

void describe_input(io::Visitor& v, const DecidingInput& input) {
  v.text("name", input.name, "Its name.");
  v.optional_group("tornado", input.tornado, "It alone moved.", [&](const design::TornadoBar& bar) {
    v.number("at_5_percent", bar.at_low, millidegree_as_kept, "At its 5 % fraction.", known);
    v.number("at_95_percent", bar.at_high, millidegree_as_kept, "At its 95 % fraction.", known);
    v.number("swing", bar.swing, millidegree_as_kept, "Largest less smallest.", known);
  });
  v.optional_group(
      "sobol", input.sobol, "Fractions of the variance.",
      [&](const numerics::InputIndices& indices) {
        describe_index(v, "first_order", indices.first_order, "What goes if it becomes known.");
        describe_index(v, "total", indices.total, "What stays if all others become known.");
      });
  v.optional_group(
      "sample_information", input.test,
      "By how much knowing it lowers the expected rms, among those fit to be chosen.",
      [&](const design::InputValue& test) {
        v.number("fitted_gain", test.fitted.gain, millidegree_as_kept, "Biased high.");
        v.number("fitted_error", test.fitted.standard_error, millidegree_as_kept,
                 "Standard error.");
        v.number("held_out_gain", test.held_out_gain, millidegree_as_kept, "Biased low.");
        v.number("held_out_error", test.held_out_error, millidegree_as_kept, "Standard error.");
      });
}

std::vector<DecidingInput> deciding_inputs(const DecisionSection& decision) {
  std::vector<DecidingInput> inputs;
  for (std::size_t k = 0; k < decision.inputs.size(); ++k) {
    DecidingInput input;
    input.name = decision.inputs[k];
    if (decision.tornado) {
      for (const auto& bar : decision.tornado->bars) {
        if (bar.input == k) input.tornado = bar;
      }
    }
    if (decision.sobol) input.sobol = decision.sobol->outputs.front().inputs[k];
    if (decision.tests) input.test = decision.tests->inputs[k];
    inputs.push_back(std::move(input));
  }
  return inputs;
}

}  // namespace

void describe_decision(io::Visitor& v, const EvaluateSection& section,
                       const DecisionSection& decision) {
  // Empty by example, which has no candidates.
  const auto name = [&](std::size_t place) {
    return place < decision.candidates.size()
               ? section.candidates[decision.candidates[place].candidate].name
               : std::string();
  };
  std::vector<NamedOption> options;
  for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
    options.push_back({name(i), decision.statistics.options[i], decision.front_fractions[i],
                       decision.candidates[i]});
  }
  std::vector<NamedPair> pairs;
  for (const auto& pair : decision.statistics.pairs) {
    pairs.push_back({name(pair.first), name(pair.second), pair});
  }
  std::vector<NamedStructures> by_structure;
  for (const auto& pair : decision.by_structure) {
    by_structure.push_back({name(pair.first), name(pair.second), pair.structures});
  }
  v.defined_as(
      "decision",
      "Probabilities, regrets and what they depend on, by samples with fixed gains. Losses are "
      "boresight rms in mdeg.");
  v.count("samples", decision.random_samples, "How many.");
  v.text("source", decision.source, "Of the samples.");
  v.list("options", options, "Those with a stable controller.",
         [&](const NamedOption& option) { describe_option(v, option); });
  v.list("pairs", pairs, "Every pair, on the same samples.", [&](const NamedPair& one) {
    v.text("first", one.first, "Name.");
    v.text("second", one.second, "Name.");
    describe_probability(v, "first_is_better", one.pair.better, "Less rms, ties counted half.");
    describe_gain(v, one.pair.mean_gain, one.pair.gain_error);
    v.text("first_over_second", to_string(one.pair.first_over_second), "Dominance.");
    v.text("second_over_first", to_string(one.pair.second_over_first), "Dominance.");
  });
  v.list("pairs_by_structure", by_structure,
         "Every pair of different antennas whose chosen controllers differ in structure, with one "
         "structure on both, over the same samples.",
         [&](const NamedStructures& one) {
           v.text("first", one.first, "Name.");
           v.text("second", one.second, "Name.");
           v.list("structures", one.structures,
                  "Of the two chosen ones those that were tuned for both; empty without such.",
                  [&](const SameStructure& same) { describe_same_structure(v, same); });
         });
  v.word("ranked_by", to_string(decision.ranking.measure),
         {to_string(design::LossMeasure::mean), to_string(design::LossMeasure::quantile_95),
          to_string(design::LossMeasure::median)},
         "What the choice is made by: the mean rms; where each that is fit is unstable on some "
         "sample, the rms that 95 % of the samples do not exceed, or the median.");
  v.text("min_mean_rms", name(decision.best),
         "The candidate of the least rms by that, of those fit to be chosen if there are any.");
  std::vector<std::string> tied;
  for (std::size_t i = 0; i < decision.tied.size(); ++i) {
    if (decision.tied[i]) tied.push_back(name(i));
  }
  v.texts("tied", tied,
          "Those fit to be chosen whose rms by that differs from the least by no more than 2 %, or "
          "than the records of wind leave open.");
  v.text("second_least_mean_rms", name(decision.second),
         "The next: of those fit to be chosen before the others.");
  v.number("difference_at_median",
           decision.tornado ? std::optional(decision.tornado->at_median) : std::nullopt,
           millidegree_as_kept, "Second less first with every input at its median.");
  v.list("inputs", deciding_inputs(decision),
         "What is uncertain, and what it does to that difference.",
         [&](const DecidingInput& input) { describe_input(v, input); });
  v.optional_group("perfect_information",
                   decision.tests ? std::optional(decision.tests->perfect) : std::nullopt,
                   "By how much knowing all inputs lowers the expected rms, among those fit to be "
                   "chosen.",
                   [&](const design::InformationGain& perfect) {
                     v.number("gain", perfect.gain, millidegree_as_kept, "The gain.");
                     v.number("standard_error", perfect.standard_error, millidegree_as_kept,
                              "Its standard error.");
                   });
  v.texts("notes", decision.notes, "What is missing, and why.");
}

}  // namespace boresight::app
