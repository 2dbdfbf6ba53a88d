#include <cmath>
#include <limits>

#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {

std::optional<ChosenColumn> guessed_encoder(const ColumnChooser& chooser, std::string_view axis) {
  const auto guess = [&](bool by_name) {
    return chooser.guessed({dimension_of(Kind::angle)}, [&](const ColumnChooser::Words& words) {
      return (by_name ? is_encoder(words) : is_position(words) || has_axis(words, axis)) &&
             !is_command(words) && !is_rate(words) && !is_valve(words) && !is_error(words) &&
             !is_boresight(words) && !is_wind(words) && is_of_axis(words, axis);
    });
  };
  const auto named = guess(true);
  return named ? named : guess(false);
}

void make_continuous(Eigen::VectorXd& angle) {
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double& value : angle) {
    if (!std::isfinite(value)) continue;
    if (std::isfinite(last)) value = last + std::remainder(value - last, two_pi);
    last = value;
  }
}

}  // namespace boresight::io
