#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {

namespace {

std::optional<ChosenColumn> guess(const ColumnChooser& chooser, std::string_view axis,
                                  bool by_name) {
  return chooser.guessed({dimension_of(Kind::angle)}, [&](const ColumnChooser::Words& words) {
    return (by_name ? is_encoder(words) : is_position(words) || has_axis(words, axis)) &&
           !is_command(words) && !is_rate(words) && !is_valve(words) && !is_error(words) &&
           !is_boresight(words) && !is_wind(words) && is_of_axis(words, axis) &&
           std::ranges::none_of(
               words, [](const std::string& word) { return word == "motor" || word == "shaft"; });
  });
}

}  // namespace

std::optional<ChosenColumn> encoder_by_name(const ColumnChooser& chooser, std::string_view axis) {
  return guess(chooser, axis, true);
}

std::optional<ChosenColumn> guessed_encoder(const ColumnChooser& chooser, std::string_view axis) {
  const auto named = encoder_by_name(chooser, axis);
  return named ? named : guess(chooser, axis, false);
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
