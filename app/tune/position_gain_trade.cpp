#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {

std::string trade_in_words(const design::PositionGainTrade& trade, const io::GainUnits& units,
                           std::string_view controller, double boresight_rms, std::size_t plants) {
  const std::vector<std::string> gains = units.texts(trade.controller);
  return fmt::format(
      "{} has kp at its bound: its rate-loop gain is so low that only kp*kr matters, not a sound "
      "cascade. The same product with kp = {} and kr = {} gives {:.4f} mdeg, {:+.1f} %{}. Lower "
      "the upper bound of kp with [[tuning.bound]] or in the [[loop]].",
      controller, gains.at(trade.position_gain), gains.at(trade.rate_gain),
      trade.boresight_rms / millidegree, 100.0 * (trade.boresight_rms / boresight_rms - 1.0),
      plants > 0 ? fmt::format(", with all constraints met on {} of {} plants before re-tuning",
                               trade.within_constraints, plants)
                 : "");
}

std::string_view trade_not_looked_for() {
  return "The rate-loop gain may be so low that only kp*kr matters, not a sound cascade: check "
         "with `boresight tune`.";
}

}  // namespace boresight::app
