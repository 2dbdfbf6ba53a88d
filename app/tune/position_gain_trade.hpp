#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <boresight/design/studies/position_gain_trade.hpp>
#include <boresight/io/case/present_gains.hpp>

namespace boresight::app {

/// In two sentences that the bound of the position gain is no sharp number for `law`, which points
/// within `beam_rms` (rad). `plants`: on which the trade was judged, 0 for none.
std::string trade_in_words(const design::PositionGainTrade& trade, const io::GainUnits& units,
                           std::string_view law, double beam_rms, std::size_t plants);

/// In a sentence what is said of laws that ends_at_position_gain where no trade was looked for.
std::string_view trade_not_looked_for();

}  // namespace boresight::app
