#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <boresight/design/decisions/assessment.hpp>

namespace boresight::design {

struct RecommendOptions {
  /// Relative difference of ranking figures that counts as a tie, as does one within the interval
  /// of figure_change (are_tied).
  double tie = 0.02;
  /// The worst fitness that a winner may have.
  Fitness accepted = Fitness::misses_member;
};

/// The criterion that decided between the winner and a rival.
enum class RecommendationReason {
  fitness,      // the rival's is worse, or not accepted
  budgets,      // the rival meets fewer required budgets
  figure,       // the rival's ranking figure is larger
  fewer_parts,  // the figures are tied, and the rival has more parts
  robustness,   // the figures are tied, and only the winner was tuned robustly
  name,         // equal in all of these
};

/// A candidate that is not the winner.
struct RejectedController {
  std::size_t index = 0;  // of the candidates
  Fitness fitness = Fitness::fit;
  RecommendationReason reason = RecommendationReason::fitness;
  double figure_ratio = 0.0;  // ranking figure over the winner's; NaN without a winner
  bool tied = false;          // same fitness and budgets met as the winner, figures tied
};

struct Recommendation {
  std::optional<std::size_t> winner;          // index of the candidates
  std::vector<RecommendationReason> reasons;  // that rejected a rival, each once, in order
  std::vector<RejectedController> rejected;   // in the order of the candidates
};

/// Recommends one of the controllers of one antenna in one wind whose fitness is accepted. Best
/// fitness wins, then most required budgets met, then least ranking figure. Of those tied with the
/// least figure, the fewest parts win; then a robust design over a nominal one, the least figure,
/// the structure's name. If one candidate was simulated in wind, one that was not is
/// Fitness::not_shown at best. The choice does not depend on the order of the candidates.
/// @throws InvalidInput for a tie that is negative or not finite.
Recommendation recommend(std::span<const Assessment> candidates,
                         const RecommendOptions& options = {});

}  // namespace boresight::design
