#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/loss_wording.hpp>

namespace boresight::app {

std::string loss_text(double decibels, int decimals) {
  if (!std::isfinite(decibels)) return "-";
  if (decibels > largest_parabola_loss) return fmt::format("> {:g}", largest_parabola_loss);
  return fmt::format("{:.{}f}", decibels, decimals);
}

std::string beyond_the_parabola() {
  return fmt::format("> {:g}: beyond {:g} dB the parabolic beam model does not hold.",
                     largest_parabola_loss, largest_parabola_loss);
}

}  // namespace boresight::app
