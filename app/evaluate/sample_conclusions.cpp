#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/sample_conclusions.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/report/influences.hpp>

namespace boresight::app {
namespace {

std::string fraction(const design::Probability& probability) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", probability.value, probability.lower,
                     probability.upper);
}

const std::string& name_of(const EvaluateSection& section, const DecisionSection& decision,
                           std::size_t place) {
  return section.candidates[decision.candidates[place].candidate].name;
}

// What of the choice by the least mean is not worth paying for.
std::string not_worth_paying(const EvaluateSection& section, const DecisionSection& decision) {
  const std::size_t choice = decision.worth;
  const Candidate& best = section.candidates[decision.candidates[decision.best].candidate];
  if (choice == decision.best || !best.feasible()) return "";
  const auto& ranking = decision.ranking;
  return fmt::format(
      "{} is only {:.1f} % better than {} {}: {}.", name_of(section, decision, decision.best),
      100.0 * (1.0 - ranking.losses[decision.best] / ranking.losses[choice]),
      name_of(section, decision, choice), measure_phrase(ranking.measure),
      section.candidates[decision.candidates[choice].candidate].path.empty()
          ? "no proposal is worth its cost"
          : fmt::format("of these {} is worth its cost", name_of(section, decision, choice)));
}

// The place of the least rms of all where it is of one that is not fit to be chosen.
std::optional<std::size_t> unfit_min(const EvaluateSection& section,
                                     const DecisionSection& decision) {
  const auto& losses = decision.ranking.losses;
  const auto place = static_cast<std::size_t>(std::ranges::min_element(losses) - losses.begin());
  if (section.candidates[decision.candidates[place].candidate].feasible()) return std::nullopt;
  return place;
}

// What choosing it loses, and whether any other may be taken in its place.
std::string regret(const EvaluateSection& section, const DecisionSection& decision) {
  const auto& options = decision.statistics.options;
  const auto& ranking = decision.ranking;
  if (const auto minimum = unfit_min(section, decision)) {
    return fmt::format(
        " {} has the lowest rms of all, {:.4f} mdeg {}, but {} and is excluded. The probabilities "
        "to be best and the regrets above include it.",
        name_of(section, decision, *minimum), ranking.losses[*minimum],
        measure_phrase(ranking.measure),
        why_not(section.candidates[decision.candidates[*minimum].candidate]));
  }
  if (!std::isfinite(options[decision.best].expected_regret)) {
    return " Every eligible proposal is unstable on some samples: mean rms and regret are "
           "infinite.";
  }
  const auto counted = unfit_but_counted(section, decision);
  return fmt::format(" Expected regret against perfect information: {:.4f} mdeg{}.",
                     options[decision.best].expected_regret,
                     counted.empty() ? ""
                                     : fmt::format(" (ineligible proposals included: {})",
                                                   fmt::join(counted, ", ")));
}

// How likely it is the best of all, and better than the second where that is fit to be chosen.
std::string probabilities(const EvaluateSection& section, const DecisionSection& decision,
                          const design::PairComparison& pair) {
  const bool turned = pair.first != decision.best;
  const design::Probability better =
      turned ? design::Probability{1.0 - pair.better.value, 1.0 - pair.better.upper,
                                   1.0 - pair.better.lower}
             : pair.better;
  const double gain = (turned ? -1.0 : 1.0) * pair.mean_gain;
  std::vector<std::string> parts;
  if (!unfit_min(section, decision)) {
    parts.push_back(fmt::format("the best of all with probability {}",
                                fraction(decision.statistics.options[decision.best].best)));
  }
  if (section.candidates[decision.candidates[decision.second].candidate].feasible()) {
    parts.push_back(fmt::format(
        "better than {} with probability {}{}", name_of(section, decision, decision.second),
        fraction(better),
        std::isfinite(gain)
            ? fmt::format(", by {:.4f} +- {:.4f} mdeg on average", gain, pair.gain_error)
            : std::string()));
  }
  return parts.empty() ? "" : fmt::format(". It is {}", fmt::join(parts, " and "));
}

std::string probabilities(const EvaluateSection& section, const DecisionSection& decision) {
  const auto& ranking = decision.ranking;
  const double minimum = ranking.losses[decision.best];
  const Candidate& best = section.candidates[decision.candidates[decision.best].candidate];
  if (!best.feasible()) {
    return fmt::format(
        "No proposal is eligible over {} samples: {} has the lowest rms with fixed gains, {:.4f} "
        "mdeg {}, but {}.",
        decision.random_samples, best.name, minimum, measure_phrase(ranking.measure),
        why_not(best));
  }
  const auto pair = std::ranges::find_if(decision.statistics.pairs, [&](const auto& one) {
    return (one.first == decision.best && one.second == decision.second) ||
           (one.first == decision.second && one.second == decision.best);
  });
  if (pair == decision.statistics.pairs.end()) return "";
  const bool some_unfit = std::ranges::any_of(decision.candidates, [&](const auto& one) {
    return !section.candidates[one.candidate].feasible();
  });
  std::string text =
      fmt::format("Lowest rms with fixed gains{}: {}, {:.4f} mdeg {}{}.{}",
                  some_unfit ? " among eligible proposals" : "", best.name, minimum,
                  measure_phrase(ranking.measure), probabilities(section, decision, *pair),
                  regret(section, decision));
  text += fmt::format(" Intervals: sampling error over {} plants {}.", decision.random_samples,
                      decision.source);
  if (section.time_domain) {
    text +=
        " Each simulated/linear rms ratio and each limit cycle is that of the case's plant and is "
        "not sampled. The probabilities do not separate proposals that differ by a few per cent.";
  }
  const auto& outside = decision.candidates[decision.best].outside_goals;
  text += fmt::format(
      " Its constraints hold on the {} plants of the tuning ensemble; a fraction {} of the samples "
      "violates one.",
      section.ensemble_size, fraction(outside));
  return text;
}

std::string what_decides(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.sobol || decision.sobol->outputs.front().constant) return "";
  const auto& second = section.candidates[decision.candidates[decision.second].candidate];
  if (!second.feasible()) return "";
  const auto& indices = decision.sobol->outputs.front();
  std::vector<std::size_t> order(indices.inputs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t i) { return indices.inputs[i].total.value; });
  std::vector<std::string> named;
  for (const std::size_t i : order) {
    if (named.size() == 3 || indices.inputs[i].total.value < 0.02) break;
    named.push_back(fmt::format("{} ({:.0f} % of the variance, interactions included)",
                                decision.inputs[i], 100.0 * indices.inputs[i].total.value));
  }
  std::string text = fmt::format("The difference between {} and {} depends most on {}.",
                                 name_of(section, decision, decision.second),
                                 name_of(section, decision, decision.best), fmt::join(named, ", "));
  if (decision.tornado) {
    const auto turns = std::ranges::find_if(decision.tornado->bars, [&](const auto& bar) {
      return std::min(bar.at_low, bar.at_high) < 0.0;
    });
    text += turns == decision.tornado->bars.end()
                ? " No single input reverses the order within its 5 % to 95 % range."
                : fmt::format(
                      " Alone, {} reverses the order: {:.4f} mdeg at its 5 % quantile, {:.4f} at "
                      "its 95 % quantile.",
                      decision.inputs[turns->input], turns->at_low, turns->at_high);
  }
  return text;
}

std::string what_to_test(const EvaluateSection& section, const DecisionSection& decision) {
  if (!decision.tests) return "";
  const auto& tests = *decision.tests;
  const auto best =
      std::ranges::max_element(tests.inputs, {}, [](const auto& one) { return one.held_out_gain; });
  const double mean = tests.mean_loss[tests.choice];
  const auto& choice = name_of(section, decision, tests.choice);
  if (best == tests.inputs.end() || best->held_out_gain <= 2.0 * best->held_out_error ||
      best->held_out_gain < 1e-4 * mean) {
    return fmt::format(
        "No test of a single input significantly improves the choice of {}. Perfect information "
        "lowers the expected rms by {:.4f} mdeg ({:.2f} %), with fixed gains.",
        choice, std::max(0.0, tests.perfect.gain),
        100.0 * std::max(0.0, tests.perfect.gain) / mean);
  }
  const auto input = static_cast<std::size_t>(best - tests.inputs.begin());
  return fmt::format(
      "Test first: {}. Known before the choice, it lowers the expected rms by {:.4f} to {:.4f} "
      "mdeg (held out and fitted); perfect information lowers it by {:.4f} mdeg{}.",
      decision.inputs[input], best->held_out_gain, best->fitted.gain, tests.perfect.gain,
      tests.perfect.gain < negligible_change * mean
          ? fmt::format(", {:.2f} % of the rms: no test is worth its time for this choice",
                        100.0 * tests.perfect.gain / mean)
          : "");
}

}  // namespace

std::vector<std::string> conclude_samples(const EvaluateSection& section,
                                          const DecisionSection& decision) {
  std::vector<std::string> sentences{
      probabilities(section, decision), not_worth_paying(section, decision),
      what_decides(section, decision), what_to_test(section, decision)};
  std::erase(sentences, "");
  return sentences;
}

}  // namespace boresight::app
