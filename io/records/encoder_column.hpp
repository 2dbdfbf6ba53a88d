#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Core>

#include <boresight/io/records/column_chooser.hpp>

namespace boresight::io {

/// The column of the encoder by its words: encoder or enc, else position, pos, angle, actual or the
/// axis; an angle, neither of the other axis alone nor of a motor or shaft, nor a command, rate,
/// valve, error or wind.
std::optional<ChosenColumn> guessed_encoder(const ColumnChooser& chooser, std::string_view axis);

/// The same by encoder or enc alone.
std::optional<ChosenColumn> encoder_by_name(const ColumnChooser& chooser, std::string_view axis);

/// Makes angles (rad, NaN: none) continuous: a step of more than half a turn is a full turn of the
/// display.
void make_continuous(Eigen::VectorXd& angle);

}  // namespace boresight::io
