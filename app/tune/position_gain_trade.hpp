#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <boresight/design/studies/position_gain_trade.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {

/// Explains that the bound of the position gain is ill-determined for the controller named
/// `controller`. `boresight_rms`: boresight error rms of that controller (rad). `plants`: number of
/// plants on which the trade was evaluated, 0 for none.
std::string trade_in_words(const design::PositionGainTrade& trade, const io::GainUnits& units,
                           std::string_view controller, double boresight_rms, std::size_t plants);

/// The sentence for controllers that ends_at_position_gain if no trade was searched for.
std::string_view trade_not_looked_for();

}  // namespace boresight::app
