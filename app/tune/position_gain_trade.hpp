#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// Where a slow rate loop hardly acts, position and rate gain count by their product: how far the
/// position gain of a law can be lowered (a hundredfold at most), the product and all other gains
/// held, before the rms on the case's plant is 1 % larger or the loop unstable.
struct PositionGainTrade {
  std::string position_gain, rate_gain;  // in the engineer's units
  double beam_rms = 0.0;                 // rad
  int within_goals = 0;                  // plants of the ensemble on which it keeps every goal
};

/// Whether a search ended at the upper bound of the position gain, with a rate gain to trade it
/// against: gains of the symbols kp and kr.
bool ends_at_position_gain(const design::TuningResult& tuning);

/// The trade of a law that points within `beam_rms` (rad) on the problem's plant in its wind,
/// judged on members that may be empty. None unless ends_at_position_gain and the position gain can
/// be halved or lowered further. Ten judgements of a law and one of all members.
std::optional<PositionGainTrade> position_gain_trade(
    const io::Case& antenna, design::TrackingProblem problem, const design::TuningResult& tuning,
    double beam_rms, const design::HardGoals& goals,
    const std::vector<design::EnsembleMember>& members);

/// In two sentences that the bound of the position gain is no sharp number for `law`, which points
/// within `beam_rms` (rad). `plants`: on which the trade was judged, 0 for none.
std::string trade_in_words(const PositionGainTrade& trade, std::string_view law, double beam_rms,
                           std::size_t plants);

/// In a sentence what is said of laws that ends_at_position_gain where no trade was looked for.
std::string_view trade_not_looked_for();

}  // namespace boresight::app
