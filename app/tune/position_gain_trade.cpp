#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>

namespace boresight::app {

std::string trade_in_words(const design::PositionGainTrade& trade, const io::GainUnits& units,
                           std::string_view law, double beam_rms, std::size_t plants) {
  const std::vector<std::string> gains = units.texts(trade.law);
  return fmt::format(
      "{} has kp at its bound because its rate loop hardly acts, so that kp x kr counts. With the "
      "same product kp = {} and kr = {} have {:.4f} mdeg, {:+.1f} %{}. A lower upper bound of kp "
      "([[tuning.bound]], or that of a [[loop]]) has the search look for laws whose rate loop "
      "acts.",
      law, gains.at(trade.position_gain), gains.at(trade.rate_gain), trade.beam_rms / millidegree,
      100.0 * (trade.beam_rms / beam_rms - 1.0),
      plants > 0 ? fmt::format(", with every goal kept on {} of {} plants before tuning again",
                               trade.within_goals, plants)
                 : "");
}

std::string_view trade_not_looked_for() {
  return "Where the rate loop hardly acts only the product kp x kr counts, and the bound of kp is "
         "no sharp limit: `boresight tune` of that case says whether this is so.";
}

}  // namespace boresight::app
