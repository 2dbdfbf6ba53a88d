#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/servo_columns.hpp>
#include <boresight/io/units/kinds.hpp>

namespace boresight::io {
namespace {

using Words = ColumnChooser::Words;

bool is_wind(const Words& words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return word.starts_with("wind") || word.starts_with("anemometer");
  });
}

bool is_error(const Words& words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return word.ends_with("error") || word.ends_with("err") || word == "deviation";
  });
}

bool is_boresight(const Words& words) {
  constexpr std::array<std::string_view, 4> names{"boresight", "pointing", "beam", "conscan"};
  return has_any(words, names);
}

bool is_encoder(const Words& words) {
  return std::ranges::any_of(
      words, [](const std::string& word) { return word.starts_with("encoder") || word == "enc"; });
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

bool has_axis(const Words& words, std::string_view axis) {
  return std::ranges::any_of(names_of(axis), [&](std::string_view name) {
    return std::ranges::find(words, name) != words.end();
  });
}

bool is_position(const Words& words) {
  constexpr std::array<std::string_view, 4> names{"position", "pos", "angle", "actual"};
  return has_any(words, names);
}

class ServoChooser {
 public:
  ServoChooser(const Case& antenna, const RecordTable& table)
      : entry_(antenna.campaign->columns), axis_(antenna.axis), chooser_(table) {}

  ServoColumns choose() {
    const Dimension angle = dimension_of(Kind::angle);
    const Dimension rate = dimension_of(Kind::angular_rate);
    const Dimension voltage = dimension_of(Kind::voltage);
    const std::initializer_list<Dimension> commands{voltage, dimension_of(Kind::number), rate,
                                                    dimension_of(Kind::current)};
    result_.time = named_or_guessed(entry_.time, {dimension_of(Kind::time)}, is_time);
    if (!result_.time && !entry_.sample_rate) {
      chooser_.refuse_missing("time", "time, or record_columns.sample_rate");
    }
    result_.tachometer = named_or_guessed(entry_.tachometer, {voltage, rate}, own(is_tachometer));
    result_.rate_command = named_or_guessed(entry_.rate_command, commands, own(is_rate_command));
    result_.valve_command = named_or_guessed(entry_.valve_command, commands, own(is_valve));
    result_.wind_speed = chooser_.guessed({dimension_of(Kind::speed)}, is_wind);
    result_.wind_direction = chooser_.guessed({angle}, is_wind);
    result_.boresight_error = position({angle}, [](const Words& words) {
      return is_boresight(words) && !is_command(words) && !is_rate(words);
    });
    result_.position_error = position({angle}, [](const Words& words) {
      return is_error(words) && !is_boresight(words) && !is_rate(words);
    });
    result_.position_command = position({angle}, [](const Words& words) {
      return is_command(words) && !is_rate(words) && !is_valve(words) && !is_error(words) &&
             !is_boresight(words);
    });
    const auto encoder = [this](bool by_name) {
      return [by_name, this](const Words& words) {
        return (by_name ? is_encoder(words) : is_position(words) || has_axis(words, axis_)) &&
               !is_command(words) && !is_rate(words) && !is_error(words) && !is_boresight(words);
      };
    };
    result_.encoder = position({angle}, encoder(true));
    if (!result_.encoder) result_.encoder = position({angle}, encoder(false));
    return std::move(result_);
  }

 private:
  // Not of the other axis alone.
  bool is_of_axis(const Words& words) const {
    return has_axis(words, axis_) || !has_axis(words, other_axis(axis_));
  }

  // Of the drive of this axis, neither wind nor an error.
  std::function<bool(const Words&)> own(bool (*fits)(const Words&)) const {
    return [fits, this](const Words& words) {
      return fits(words) && !is_wind(words) && !is_error(words) && is_of_axis(words);
    };
  }

  template <typename Condition>
  std::optional<ChosenColumn> position(std::initializer_list<Dimension> kinds,
                                       const Condition& fits) const {
    return chooser_.guessed(kinds, [&](const Words& words) {
      return fits(words) && !is_wind(words) && is_of_axis(words);
    });
  }

  // The case names columns of its campaign's files, which another file need not have.
  std::optional<ChosenColumn> named_or_guessed(const std::optional<ColumnEntry>& entry,
                                               std::initializer_list<Dimension> kinds,
                                               const std::function<bool(const Words&)>& fits) {
    std::vector<std::string> remarks;
    if (entry && !chooser_.lacks(entry, remarks)) return chooser_.named(*entry);
    const auto guess = chooser_.guessed(kinds, fits);
    if (!guess) result_.remarks.insert(result_.remarks.end(), remarks.begin(), remarks.end());
    return guess;
  }

  const RecordColumnsEntry& entry_;
  const std::string& axis_;
  ColumnChooser chooser_;
  ServoColumns result_;
};

}  // namespace

ServoColumns choose_servo_columns(const Case& antenna, const RecordTable& table) {
  return ServoChooser(antenna, table).choose();
}

}  // namespace boresight::io
