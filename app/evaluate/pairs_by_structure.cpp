#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/pairs_by_structure.hpp>

namespace boresight::app {
namespace {

// A pair seen from the one of less rms.
struct Winner {
  const Candidate& winner;
  const Candidate& loser;
  double gain = 0.0;  // mdeg
  double sign = 1.0;
};

std::string with_loops(const Candidate& candidate) {
  const CandidateController* controller = candidate.chosen_controller();
  return fmt::format("{} ({})", candidate.name,
                     controller == nullptr ? "-" : controller->structure);
}

// Compares the gain with one structure on both with that of the chosen controllers.
std::string verdict(const Winner& pair, const PairByStructure& found) {
  int better = 0, worse = 0;
  double minimum = HUGE_VAL, maximum = 0.0;
  for (const auto& one : found.structures) {
    const double gain = pair.sign * one.mean_gain;
    if (gain > 2.0 * one.gain_error) ++better;
    if (gain < -2.0 * one.gain_error) ++worse;
    minimum = std::min(minimum, gain);
    maximum = std::max(maximum, gain);
  }
  const auto all = static_cast<int>(found.structures.size());
  if (better > 0 && worse > 0) {
    return "which hardware is better depends on the structure";
  }
  if (better == 0) {
    return worse > 0
               ? "the gain comes from the controller; with equal structures the order reverses"
               : "the gain comes from the controller; the hardware makes no difference";
  }
  if (minimum >= pair.gain) return "the gain comes from the hardware, whatever the controller";
  if (better < all) {
    return fmt::format("the hardware contributes at most {:.4f} mdeg, the controller the rest",
                       std::min(maximum, pair.gain));
  }
  const double upper = std::min(maximum, pair.gain);
  return upper - minimum < 5e-5
             ? fmt::format("the hardware contributes {:.4f} mdeg, the controller the rest", minimum)
             : fmt::format(
                   "the hardware contributes {:.4f} to {:.4f} mdeg, the controller the rest",
                   minimum, upper);
}

std::string under_one_structure(const Winner& pair, const PairByStructure& found) {
  std::vector<std::string> parts;
  for (const auto& one : found.structures) {
    if (!std::isfinite(one.mean_gain)) {
      return fmt::format(
          "{} has {:.4f} mdeg less than {} on average. With {} loops on both, a sample is "
          "unstable: the controller's contribution is unknown.",
          with_loops(pair.winner), pair.gain, with_loops(pair.loser), one.structure);
    }
    const double gain = pair.sign * one.mean_gain;
    const bool turned = pair.sign < 0.0;
    std::vector<std::string> unfit;
    if (!(turned ? one.second_usable : one.first_usable)) unfit.push_back(pair.winner.name);
    if (!(turned ? one.first_usable : one.second_usable)) unfit.push_back(pair.loser.name);
    parts.push_back(fmt::format(
        "with {} on both {:.4f} {} (better with probability {:.3f}{})", one.structure,
        std::abs(gain), gain < 0.0 ? "more" : "less",
        turned ? 1.0 - one.better.value : one.better.value,
        unfit.empty() ? "" : fmt::format("; not eligible with it: {}", fmt::join(unfit, ", "))));
  }
  return fmt::format("{} has {:.4f} mdeg less than {} on average, with different loops; {}: {}.",
                     with_loops(pair.winner), pair.gain, with_loops(pair.loser),
                     fmt::join(parts, ", "), verdict(pair, found));
}

// Whether the pair is one for a sentence: with the antenna as it is, or the two best.
bool tells(const EvaluateSection& section, const DecisionSection& decision,
           const PairByStructure& found) {
  const auto as_it_is = [&](std::size_t place) {
    return section.candidates[decision.candidates[place].candidate].path.empty();
  };
  return as_it_is(found.first) || as_it_is(found.second) ||
         std::minmax(found.first, found.second) == std::minmax(decision.best, decision.second);
}

std::optional<Winner> winner_of(const EvaluateSection& section, const DecisionSection& decision,
                                const PairByStructure& found) {
  const auto pair = std::ranges::find_if(decision.statistics.pairs, [&](const auto& one) {
    return one.first == found.first && one.second == found.second;
  });
  if (pair == decision.statistics.pairs.end() || !std::isfinite(pair->mean_gain)) {
    return std::nullopt;
  }
  const Candidate& first = section.candidates[decision.candidates[found.first].candidate];
  const Candidate& second = section.candidates[decision.candidates[found.second].candidate];
  return pair->mean_gain < 0.0 ? Winner{second, first, -pair->mean_gain, -1.0}
                               : Winner{first, second, pair->mean_gain, 1.0};
}

}  // namespace

std::string controller_or_hardware(const EvaluateSection& section,
                                   const DecisionSection& decision) {
  std::vector<std::string> sentences, untold;
  for (const auto& found : decision.by_structure) {
    const auto pair = winner_of(section, decision, found);
    if (!pair || !tells(section, decision, found)) continue;
    if (found.structures.empty()) {
      untold.push_back(fmt::format("{} and {}", with_loops(pair->winner), with_loops(pair->loser)));
    } else {
      sentences.push_back(under_one_structure(*pair, found));
    }
  }
  if (!untold.empty()) {
    sentences.push_back(fmt::format(
        "No structure was tuned for both, so controller and hardware effects are not separated: "
        "{}. Name one for both by `structures` in the proposal files or by --structure.",
        fmt::join(untold, "; ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string controller_or_hardware(const EvaluateSection& section, const DecisionSection& decision,
                                   std::size_t place) {
  std::vector<std::string> sentences;
  for (const auto& found : decision.by_structure) {
    if (found.first != place && found.second != place) continue;
    const auto pair = winner_of(section, decision, found);
    if (!pair || found.structures.empty() || !tells(section, decision, found)) continue;
    sentences.push_back(under_one_structure(*pair, found));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace boresight::app
