#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/evaluate/held_candidate.hpp>
#include <boresight/app/evaluate/pairs_by_structure.hpp>

namespace boresight::app {
namespace {

// A law that can be held on draws; none where no such one of that structure was tuned.
std::optional<std::size_t> law_of(const Candidate& candidate, const std::string& structure) {
  const auto found = std::ranges::find(candidate.laws, structure, &CandidateLaw::structure);
  if (found == candidate.laws.end() || !found->stable() ||
      !std::isfinite(found->nonlinear_factor())) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - candidate.laws.begin());
}

// Columns of rms by candidate and law; those that the choice has not judged yet are held here.
class Columns {
 public:
  Columns(const DecisionSection& decision, Eigen::MatrixXd rms,
          const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases)
      : candidates_(candidates), cases_(cases), rms_(std::move(rms)) {
    for (const auto& one : decision.candidates) {
      keys_.emplace_back(one.candidate, candidates[one.candidate].chosen.value_or(0));
    }
  }

  Eigen::Index column(std::size_t candidate, std::size_t law) {
    const std::pair key(candidate, law);
    const auto found = std::ranges::find(keys_, key);
    const auto place = static_cast<Eigen::Index>(found - keys_.begin());
    if (found == keys_.end()) {
      keys_.push_back(key);
      held_.emplace_back(cases_.front(), cases_[candidate], candidates_[candidate].laws[law]);
    }
    return place;
  }

  bool judge(const design::PlantDistribution& distribution, const EvaluateOptions& options) {
    if (held_.empty()) return true;
    const auto outcomes = judge_draws(held_, distribution, options);
    if (!outcomes) return false;
    Eigen::MatrixXd all(rms_.rows(), rms_.cols() + outcomes->rms.cols());
    all << rms_, outcomes->rms;
    rms_ = std::move(all);
    return true;
  }

  design::PairComparison compare(Eigen::Index first, Eigen::Index second) const {
    const Eigen::MatrixXd two = rms_(Eigen::all, std::array{first, second});
    return design::compare_options(two).pairs.front();
  }

 private:
  const std::vector<Candidate>& candidates_;
  const std::vector<io::Case>& cases_;
  Eigen::MatrixXd rms_;  // mdeg
  std::vector<std::pair<std::size_t, std::size_t>> keys_;
  std::vector<HeldCandidate> held_;
};

struct Comparison {
  std::size_t pair = 0;
  std::size_t first_law = 0, second_law = 0;
  Eigen::Index first = 0, second = 0;  // columns
};

// A pair seen from the one of less rms.
struct Winner {
  const Candidate& winner;
  const Candidate& loser;
  double gain = 0.0;  // mdeg
  double sign = 1.0;
};

std::string with_loops(const Candidate& candidate) {
  const CandidateLaw* law = candidate.chosen_law();
  return fmt::format("{} ({})", candidate.name, law == nullptr ? "-" : law->structure);
}

// What the gains with one structure on both say of the gain with the laws chosen.
std::string verdict(const Winner& pair, const PairByStructure& found) {
  int better = 0, worse = 0;
  double least = HUGE_VAL, most = 0.0;
  for (const auto& one : found.structures) {
    const double gain = pair.sign * one.mean_gain;
    if (gain > 2.0 * one.gain_error) ++better;
    if (gain < -2.0 * one.gain_error) ++worse;
    least = std::min(least, gain);
    most = std::max(most, gain);
  }
  const auto all = static_cast<int>(found.structures.size());
  if (better > 0 && worse > 0) {
    return "which hardware is the better one turns round with the structure";
  }
  if (better == 0) {
    return worse > 0 ? "the gain is the law's, and by its hardware alone the order turns round"
                     : "the gain is the law's, and the hardware makes no difference";
  }
  if (least >= pair.gain) return "the gain is the hardware's, whatever the law";
  if (better < all) {
    return fmt::format("the hardware makes at most {:.4f} mdeg of it, the law the rest",
                       std::min(most, pair.gain));
  }
  const double upper = std::min(most, pair.gain);
  return upper - least < 5e-5
             ? fmt::format("the hardware makes {:.4f} mdeg of it, the law the rest", least)
             : fmt::format("the hardware makes {:.4f} to {:.4f} mdeg of it, the law the rest",
                           least, upper);
}

std::string under_one_structure(const Winner& pair, const PairByStructure& found) {
  std::vector<std::string> parts;
  for (const auto& one : found.structures) {
    if (!std::isfinite(one.mean_gain)) {
      return fmt::format(
          "{} has {:.4f} mdeg less than {} on average, but with {} loops on both a draw is "
          "unstable: what of it is the law's is not known.",
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
        unfit.empty() ? ""
                      : fmt::format("; not to be chosen with it: {}", fmt::join(unfit, ", "))));
  }
  return fmt::format("{} has {:.4f} mdeg less than {} on average, but by different loops; {}: {}.",
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

std::optional<std::vector<PairByStructure>> compare_by_structure(
    const DecisionSection& decision, const Eigen::MatrixXd& rms,
    const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases,
    const design::PlantDistribution& distribution, const EvaluateOptions& options) {
  std::vector<PairByStructure> pairs;
  std::vector<Comparison> comparisons;
  Columns columns(decision, rms, candidates, cases);
  for (const auto& pair : decision.statistics.pairs) {
    const std::size_t i = decision.candidates[pair.first].candidate;
    const std::size_t k = decision.candidates[pair.second].candidate;
    const Candidate& first = candidates[i];
    const Candidate& second = candidates[k];
    const CandidateLaw* first_law = first.chosen_law();
    const CandidateLaw* second_law = second.chosen_law();
    if (first_law == nullptr || second_law == nullptr) continue;
    const bool one_antenna = first.changes.empty() && second.changes.empty();
    if (first_law->structure == second_law->structure || one_antenna) continue;
    for (const auto& structure : {first_law->structure, second_law->structure}) {
      const auto one = law_of(first, structure), other = law_of(second, structure);
      if (!one || !other) continue;
      comparisons.push_back(
          {pairs.size(), *one, *other, columns.column(i, *one), columns.column(k, *other)});
    }
    pairs.push_back({pair.first, pair.second, {}});
  }
  if (!columns.judge(distribution, options)) return std::nullopt;
  for (const auto& one : comparisons) {
    PairByStructure& pair = pairs[one.pair];
    const auto& first = candidates[decision.candidates[pair.first].candidate].laws[one.first_law];
    const auto& second =
        candidates[decision.candidates[pair.second].candidate].laws[one.second_law];
    const auto compared = columns.compare(one.first, one.second);
    pair.structures.push_back({first.structure, compared.better, compared.mean_gain,
                               compared.gain_error, first.usable(), second.usable()});
  }
  return pairs;
}

std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision) {
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
        "No structure was tuned for both, so that law and hardware are not told apart: {}. "
        "`structures` in the proposals' files, or --structure, can name one for both.",
        fmt::join(untold, "; ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision,
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
