#include <algorithm>
#include <array>
#include <cstddef>

#include <boresight/io/records/column_words.hpp>

namespace boresight::io {
namespace {

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

// Names of the antenna's axis in columns.
const std::vector<std::string_view>& names_of(std::string_view axis) {
  static const std::vector<std::string_view> elevation{"el", "elevation", "elev"};
  static const std::vector<std::string_view> azimuth{"az", "azimuth", "azim"};
  static const std::vector<std::string_view> x{"x"};
  static const std::vector<std::string_view> y{"y"};
  return axis == "elevation" ? elevation : axis == "azimuth" ? azimuth : axis == "X" ? x : y;
}

std::string_view other_axis(std::string_view axis) {
  return axis == "elevation" ? "azimuth"
         : axis == "azimuth" ? "elevation"
         : axis == "X"       ? "Y"
                             : "X";
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words;
  const std::string letters = lower(name);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = letters[i];
    const char before = i > 0 ? letters[i - 1] : ' ';
    const bool capital = name[i] != c && i > 0 && is_letter(name[i - 1]);
    const bool starts =
        (is_letter(c) && (!is_letter(before) || capital)) || (is_digit(c) && !is_digit(before));
    if (starts) words.emplace_back();
    if (is_letter(c) || is_digit(c)) words.back() += c;
  }
  return words;
}

bool is_command(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 12> commands{
      "command", "cmd", "ref",       "reference", "set",         "setpoint",
      "demand",  "com", "commanded", "ratecmd",   "ratecommand", "ratecom"};
  return has_any(words, commands);
}

bool is_rate(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 7> rates{"rate",    "speed",       "velocity", "omega",
                                                  "ratecmd", "ratecommand", "ratecom"};
  return has_any(words, rates);
}

bool is_valve(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word.starts_with("valve") || word.starts_with("servo");
  });
}

bool is_tachometer(const std::vector<std::string>& words) {
  const bool named = std::any_of(words.begin(), words.end(),
                                 [](const std::string& word) { return word.starts_with("tach"); });
  return !is_command(words) && !is_valve(words) && (named || is_rate(words));
}

bool is_rate_command(const std::vector<std::string>& words) {
  return is_command(words) && is_rate(words) && !is_valve(words);
}

bool is_motor_torque(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 1> torque{"torque"};
  constexpr std::array<std::string_view, 1> pressure{"pressure"};
  constexpr std::array<std::string_view, 3> difference{"difference", "differential", "delta"};
  return !is_command(words) &&
         (has_any(words, torque) || (has_any(words, pressure) && has_any(words, difference)));
}

bool is_time(const std::vector<std::string>& words) {
  return words.size() <= 2 && !words.empty() &&
         (words[0] == "time" || words[0] == "timestamp" || (words.size() == 1 && words[0] == "t"));
}

bool is_wind(const std::vector<std::string>& words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return word.starts_with("wind") || word.starts_with("anemometer");
  });
}

bool is_error(const std::vector<std::string>& words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return word.ends_with("error") || word.ends_with("err") || word == "deviation";
  });
}

bool is_boresight(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 4> names{"boresight", "pointing", "beam", "conscan"};
  return has_any(words, names);
}

bool is_encoder(const std::vector<std::string>& words) {
  return std::ranges::any_of(
      words, [](const std::string& word) { return word.starts_with("encoder") || word == "enc"; });
}

bool is_position(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 4> names{"position", "pos", "angle", "actual"};
  return has_any(words, names);
}

bool has_axis(const std::vector<std::string>& words, std::string_view axis) {
  return std::ranges::any_of(names_of(axis), [&](std::string_view name) {
    return std::ranges::find(words, name) != words.end();
  });
}

bool is_of_axis(const std::vector<std::string>& words, std::string_view axis) {
  return has_axis(words, axis) || !has_axis(words, other_axis(axis));
}

}  // namespace boresight::io
