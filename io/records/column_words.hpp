#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::io {

/// Small letters for A to Z, other bytes as they are.
std::string lower(std::string_view text);
bool is_digit(char c);

/// Words of a column's name, in small letters: letters or digits that stand together, a new word at
/// a capital behind a small letter. "Motor 2 p_in" has motor, 2, p, in; "PressIn1" press, in, 1.
std::vector<std::string> words_of(const std::string& name);

template <std::size_t Count>
bool has_any(const std::vector<std::string>& words,
             const std::array<std::string_view, Count>& wanted) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return std::ranges::find(wanted, word) != wanted.end();
  });
}

/// Signals by the words of a name, whatever the unit; see choose_columns.
bool is_command(const std::vector<std::string>& words);
bool is_rate(const std::vector<std::string>& words);
bool is_valve(const std::vector<std::string>& words);
bool is_tachometer(const std::vector<std::string>& words);
bool is_rate_command(const std::vector<std::string>& words);
bool is_motor_torque(const std::vector<std::string>& words);
bool is_time(const std::vector<std::string>& words);
bool is_wind(const std::vector<std::string>& words);
bool is_error(const std::vector<std::string>& words);
bool is_boresight(const std::vector<std::string>& words);
bool is_encoder(const std::vector<std::string>& words);
bool is_position(const std::vector<std::string>& words);

/// Whether the words name this axis of a case ("elevation", "azimuth", "X", "Y").
bool has_axis(const std::vector<std::string>& words, std::string_view axis);
/// Not of the other axis alone.
bool is_of_axis(const std::vector<std::string>& words, std::string_view axis);

}  // namespace boresight::io
