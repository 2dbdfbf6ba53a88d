#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/report/evaluate_report.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "infinite";
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  // Rounded to nothing, a number has no sign.
  return text.find_first_of("123456789") == std::string::npos && text.starts_with('-')
             ? text.substr(1)
             : text;
}

std::string fraction(const design::Probability& probability) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", probability.value, probability.lower,
                     probability.upper);
}

// Whether numbers are zero to the digits printed.
bool all_nothing(std::initializer_list<std::string> printed) {
  return std::ranges::all_of(printed, [](const std::string& text) {
    return text.find_first_of("123456789i") == std::string::npos;
  });
}

// The names of rows that would hold nothing but zeros.
Document left_out(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return wrapped(fmt::format("Zero to the digits printed: {}.", fmt::join(names, ", ")), "  ");
}

Document chances_table(const EvaluateSection& section, const DecisionSection& decision) {
  Rows rows{{"proposal", "mean mdeg", "+-", "5 %", "50 %", "95 %", "is the best", "regret mdeg",
             "+-", "on Pareto front", "constraints violated", "unstable"}};
  for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
    const auto& one = decision.candidates[i];
    const auto& statistics = decision.statistics.options[i];
    std::vector<std::string> cells{section.candidates[one.candidate].name,
                                   fixed(statistics.mean, 4), fixed(statistics.standard_error, 4)};
    for (const auto& quantile : statistics.quantiles) cells.push_back(fixed(quantile.value, 4));
    cells.push_back(fraction(statistics.best));
    cells.push_back(fixed(statistics.expected_regret, 4));
    cells.push_back(fixed(statistics.regret_error, 4));
    cells.push_back(
        std::isnan(decision.front_fractions[i]) ? "-" : fixed(decision.front_fractions[i], 3));
    cells.push_back(fraction(one.outside_goals));
    cells.push_back(fraction(one.unstable));
    rows.push_back(std::move(cells));
  }
  const auto counted = unfit_but_counted(section, decision);
  if (counted.empty()) return table(rows, "l");
  return table(rows, "l") +
         wrapped(fmt::format("'is the best' and 'regret' include ineligible proposals: {}.",
                             fmt::join(counted, ", ")),
                 "  ");
}

// Each pair with the one that is more often better first.
Document pairs_table(const EvaluateSection& section, const DecisionSection& decision) {
  const auto name = [&](std::size_t place) {
    return section.candidates[decision.candidates[place].candidate].name;
  };
  Rows rows{{"proposal", "is better than", "with probability", "by mdeg", "+-", "dominance"}};
  for (const auto& pair : decision.statistics.pairs) {
    const bool turned = pair.better.value < 0.5;
    const auto& better = pair.better;
    const auto dominance = turned ? pair.second_over_first : pair.first_over_second;
    rows.push_back({name(turned ? pair.second : pair.first),
                    name(turned ? pair.first : pair.second),
                    turned ? fraction({1.0 - better.value, 1.0 - better.upper, 1.0 - better.lower})
                           : fraction(better),
                    fixed((turned ? -1.0 : 1.0) * pair.mean_gain, 4), fixed(pair.gain_error, 4),
                    std::string(design::to_string(dominance))});
  }
  return table(rows, "llrrrl");
}

// Pairs with one structure on both, the one that is more often better first.
Document structures_table(const EvaluateSection& section, const DecisionSection& decision) {
  const auto name = [&](std::size_t place) {
    return section.candidates[decision.candidates[place].candidate].name;
  };
  Rows rows{{"proposal", "is better than", "both with", "with probability", "by mdeg", "+-"}};
  for (const auto& pair : decision.by_structure) {
    for (const auto& one : pair.structures) {
      const auto& better = one.better;
      const bool turned = better.value < 0.5;
      rows.push_back({name(turned ? pair.second : pair.first),
                      name(turned ? pair.first : pair.second), one.structure,
                      turned
                          ? fraction({1.0 - better.value, 1.0 - better.upper, 1.0 - better.lower})
                          : fraction(better),
                      fixed((turned ? -1.0 : 1.0) * one.mean_gain, 4), fixed(one.gain_error, 4)});
    }
  }
  if (rows.size() == 1) return {};
  return "\n" +
         wrapped(
             "Pairs above with different loops, re-tuned with one structure on both, over the same "
             "samples: the difference due to the hardware.",
             "  ") +
         table(rows, "lllrrr");
}

Document inputs_table(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.tornado || !decision.sobol) return {};
  const auto& best = section.candidates[decision.candidates[decision.best].candidate].name;
  const auto& second = section.candidates[decision.candidates[decision.second].candidate].name;
  const auto& indices = decision.sobol->outputs.front();
  Rows rows{{"input", "at 5 %", "at 95 %", "swing", "first order", "", "total", ""}};
  std::vector<std::string> nothing;
  const auto interval = [](const numerics::EstimatedIndex& index) {
    return fmt::format("[{:.3f}, {:.3f}]", index.lower, index.upper);
  };
  for (const auto& bar : decision.tornado->bars) {
    const auto& one = indices.inputs[bar.input];
    const std::string swing = fixed(bar.swing, 4), first = fixed(one.first_order.value, 3),
                      total = fixed(one.total.value, 3);
    if (all_nothing({swing, first, total})) {
      nothing.push_back(decision.inputs[bar.input]);
      continue;
    }
    rows.push_back({decision.inputs[bar.input], fixed(bar.at_low, 4), fixed(bar.at_high, 4), swing,
                    first, interval(one.first_order), total, interval(one.total)});
  }
  Document text =
      "\n" + wrapped(fmt::format(
                         "Inputs that decide between the two best: rms of '{}' minus that of '{}', "
                         "mdeg, {:.4f} at the medians, standard deviation {:.4f}; fixed gains. One "
                         "input at its 5 % and 95 % quantile, the others at their median; Sobol' "
                         "fractions of the variance (independent inputs, {} evaluations).",
                         second, best, decision.tornado->at_median, std::sqrt(indices.variance),
                         decision.sobol->evaluations),
                     "  ");
  return text + (rows.size() > 1 ? table(rows, "l") : Document()) + left_out(nothing);
}

Document tests_table(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.tests) return {};
  const auto& tests = *decision.tests;
  Rows rows{{"knowing", "lowers the rms by", "+-", "held out", "+-"}};
  std::vector<std::string> nothing;
  for (std::size_t k = 0; k < tests.inputs.size(); ++k) {
    const auto& one = tests.inputs[k];
    const std::string gain = fixed(one.fitted.gain, 5), error = fixed(one.fitted.standard_error, 5),
                      held_out = fixed(one.held_out_gain, 5),
                      held_out_error = fixed(one.held_out_error, 5);
    if (all_nothing({gain, error, held_out, held_out_error})) {
      nothing.push_back(decision.inputs[k]);
      continue;
    }
    rows.push_back({decision.inputs[k], gain, error, held_out, held_out_error});
  }
  rows.push_back({"everything", fixed(tests.perfect.gain, 5),
                  fixed(tests.perfect.standard_error, 5), "-", "-"});
  const auto& choice = section.candidates[decision.candidates[tests.choice].candidate].name;
  return "\n" +
         wrapped(fmt::format("Expected value of perfect information, costs ignored: reduction "
                             "(mdeg) of the expected rms below that of '{}', today's choice, if "
                             "one input is known exactly. Fitted is biased high, held out low.",
                             choice),
                 "  ") +
         table(rows, "l") + left_out(nothing);
}

}  // namespace

std::string heading_of(const DecisionSection& decision) {
  return fmt::format("Probabilities over {} samples, fixed gains", decision.random_samples);
}

Document document_of(const EvaluateSection& section, const DecisionSection& decision) {
  Document text = heading(heading_of(decision));
  text += wrapped(
      fmt::format("Boresight rms in mdeg of linear loops{}, {}, the same for all proposals. "
                  "Intervals: 95 %, sampling error only.",
                  section.time_domain ? " times each controller's simulated/linear rms ratio" : "",
                  decision.source),
      "  ");
  text += essential(chances_table(section, decision)) + "\n";
  text += wrapped(
      "Pairs: probability that the first has the lower rms on the same plant, ties counted half, "
      "and the mean difference. Dominance: in every sample, stochastic of first order, or of "
      "second order (risk-averse).",
      "  ");
  text += pairs_table(section, decision);
  text += structures_table(section, decision);
  text += inputs_table(section, decision) + tests_table(section, decision);
  for (const auto& note : decision.notes) text += wrapped("Note: " + note, "  ");
  return text;
}

}  // namespace boresight::app
