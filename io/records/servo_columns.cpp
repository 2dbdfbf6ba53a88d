#include <functional>
#include <initializer_list>
#include <utility>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/records/servo_columns.hpp>
#include <boresight/io/units/kinds.hpp>

namespace boresight::io {
namespace {

using Words = ColumnChooser::Words;

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
    result_.motor_torque = chooser_.guessed(
        {dimension_of(Kind::torque), dimension_of(Kind::pressure), voltage}, own(is_motor_torque));
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
    result_.encoder = guessed_encoder(chooser_, axis_);
    return std::move(result_);
  }

 private:
  // Of the drive of this axis, neither wind nor an error.
  std::function<bool(const Words&)> own(bool (*fits)(const Words&)) const {
    return [fits, this](const Words& words) {
      return fits(words) && !is_wind(words) && !is_error(words) && is_of_axis(words, axis_);
    };
  }

  template <typename Condition>
  std::optional<ChosenColumn> position(std::initializer_list<Dimension> kinds,
                                       const Condition& fits) const {
    return chooser_.guessed(kinds, [&](const Words& words) {
      return fits(words) && !is_wind(words) && is_of_axis(words, axis_);
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
