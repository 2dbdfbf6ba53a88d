#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>

#include <fmt/format.h>

#include <boresight/io/records/column_chooser.hpp>
#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/encoder_column.hpp>
#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/units/kinds.hpp>

namespace boresight::io {
namespace {

bool is_port(const std::vector<std::string>& words, bool inlet, long motor, long motors) {
  constexpr std::array<std::string_view, 6> ins{"in", "inlet", "pin", "a", "pa", "inp"};
  constexpr std::array<std::string_view, 5> outs{"out", "outlet", "pout", "b", "pb"};
  if (inlet ? !has_any(words, ins) : !has_any(words, outs)) return false;
  if (inlet ? has_any(words, outs) : has_any(words, ins)) return false;
  std::vector<std::string> numbers;
  std::copy_if(words.begin(), words.end(), std::back_inserter(numbers),
               [](const std::string& word) { return is_digit(word[0]); });
  if (numbers.empty()) return motors == 1;
  return numbers.size() == 1 && numbers[0] == fmt::format("{}", motor);
}

}  // namespace

ChosenColumns choose_columns(const RecordTable& table, const RecordColumnsEntry& entry, long motors,
                             std::string_view axis) {
  const ColumnChooser chooser(table);
  const auto choose = [&](const std::optional<ColumnEntry>& column,
                          std::initializer_list<Dimension> kinds, const auto& fits) {
    return column ? std::optional(chooser.named(*column)) : chooser.guessed(kinds, fits);
  };
  ChosenColumns chosen;
  if (!entry.sample_rate) {
    chosen.time = choose(entry.time, {dimension_of(Kind::time)}, is_time);
    if (!chosen.time) chooser.refuse_missing("time", "time, or record_columns.sample_rate");
  }
  for (const bool inlet : {true, false}) {
    const auto& named = inlet ? entry.inlet : entry.outlet;
    auto& columns = inlet ? chosen.inlet : chosen.outlet;
    for (const auto& column : named) columns.push_back(chooser.named(column));
    for (long motor = 1; named.empty() && motor <= motors; ++motor) {
      const auto column = chooser.guessed({dimension_of(Kind::pressure)},
                                          [&](const std::vector<std::string>& words) {
                                            return is_port(words, inlet, motor, motors);
                                          });
      const std::string side = inlet ? "inlet" : "outlet";
      if (!column) {
        chooser.refuse_missing(fmt::format("{} pressure of motor {}", side, motor), side);
      }
      columns.push_back(*column);
    }
  }
  const auto tachometer =
      choose(entry.tachometer, {dimension_of(Kind::voltage), dimension_of(Kind::angular_rate)},
             is_tachometer);
  if (!tachometer) chooser.refuse_missing("tachometer", "tachometer");
  chosen.tachometer = *tachometer;
  const auto command = [&](const std::optional<ColumnEntry>& column, const auto& fits) {
    return chooser.lacks(column, chosen.remarks)
               ? std::nullopt
               : choose(column,
                        {dimension_of(Kind::voltage), dimension_of(Kind::number),
                         dimension_of(Kind::angular_rate), Dimension{.current = 1}},
                        fits);
  };
  chosen.rate_command = command(entry.rate_command, is_rate_command);
  chosen.valve_command = command(entry.valve_command, is_valve);
  if (!chooser.lacks(entry.encoder, chosen.remarks)) {
    chosen.encoder = entry.encoder ? std::optional(chooser.named(*entry.encoder))
                                   : encoder_by_name(chooser, axis);
  }
  return chosen;
}

}  // namespace boresight::io
