#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/records/record_columns.hpp>
#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// "Motor 2 p_in" is motor, 2, p, in; "PressIn1" is press, in, 1: letters or digits that stand
// together, a new word at a capital behind a small letter.
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

template <std::size_t Count>
bool has_any(const std::vector<std::string>& words,
             const std::array<std::string_view, Count>& wanted) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
  });
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

bool is_time(const std::vector<std::string>& words) {
  return words.size() <= 2 && !words.empty() &&
         (words[0] == "time" || words[0] == "timestamp" || (words.size() == 1 && words[0] == "t"));
}

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

class Chooser {
 public:
  Chooser(const RecordTable& table) : table_(table) {
    for (const auto& column : table.columns) words_.push_back(words_of(column.name));
  }

  ChosenColumn named(const ColumnEntry& entry) const {
    std::vector<std::size_t> found;
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      names.push_back(table_.columns[i].name);
      if (is_named(table_.columns[i], entry.name)) found.push_back(i);
    }
    if (found.size() == 1) return {found[0], false};
    refuse_at(entry.location, entry.key,
              found.empty() ? fmt::format("expected a column of {}, found {}{} where it has {}",
                                          table_.path, in_quotes(entry.name),
                                          did_you_mean(entry.name, names), columns_of(table_))
                            : fmt::format("expected one column of {}, found {} named {}",
                                          table_.path, found.size(), in_quotes(entry.name)));
  }

  template <typename Condition>
  std::optional<ChosenColumn> guessed(std::initializer_list<Dimension> kinds,
                                      const Condition& fits) const {
    std::vector<std::size_t> with_unit, without;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (!fits(words_[i])) continue;
      const std::optional<Unit> unit = recorded_unit(table_.columns[i].unit);
      if (!unit) {
        without.push_back(i);
      } else if (std::find(kinds.begin(), kinds.end(), unit->dimension) != kinds.end()) {
        with_unit.push_back(i);
      }
    }
    const auto& found = with_unit.empty() ? without : with_unit;
    return found.size() == 1 ? std::optional(ChosenColumn{found[0], true}) : std::nullopt;
  }

  // A command may be recorded in some tests only.
  bool lacks(const std::optional<ColumnEntry>& entry, std::vector<std::string>& remarks) const {
    if (!entry) return false;
    std::vector<std::string_view> names;
    for (const RecordColumn& column : table_.columns) {
      if (is_named(column, entry->name)) return false;
      names.push_back(column.name);
    }
    remarks.push_back(fmt::format("no column {}, which {} names{}: taken as not recorded",
                                  in_quotes(entry->name), entry->key,
                                  did_you_mean(entry->name, names)));
    return true;
  }

  [[noreturn]] void refuse_missing(const std::string& what, const std::string& key) const {
    throw InvalidInput(fmt::format(
        "{}: expected a column for the {}, found none or several that could be it among {} (say "
        "which in the case: record_columns.{})",
        table_.path, what, columns_of(table_), key));
  }

 private:
  const RecordTable& table_;
  std::vector<std::vector<std::string>> words_;
};

std::optional<Unit> unit_as_in_a_case(const std::string& text) {
  try {
    return parse_unit(text);
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

}  // namespace

ChosenColumns choose_columns(const RecordTable& table, const RecordColumnsEntry& entry,
                             long motors) {
  const Chooser chooser(table);
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
  return chosen;
}

bool is_named(const RecordColumn& column, const std::string& name) {
  const std::string wanted = lower(name);
  const std::string own = lower(column.name);
  const std::string unit = lower(column.unit);
  return wanted == own ||
         (!unit.empty() && (wanted == own + " [" + unit + "]" || wanted == own + "[" + unit + "]" ||
                            wanted == own + " (" + unit + ")" || wanted == own + "(" + unit + ")"));
}

std::string columns_of(const RecordTable& table) {
  constexpr std::size_t maximum = 20;
  std::vector<std::string_view> names;
  for (const RecordColumn& column : table.columns) names.push_back(column.name);
  names.resize(std::min(maximum, names.size()));
  const std::size_t more = table.columns.size() - names.size();
  return quoted_list(names) + (more > 0 ? fmt::format(" and {} more", more) : "");
}

std::optional<Unit> recorded_unit(const std::string& text) {
  if (const auto unit = unit_as_in_a_case(text)) return unit;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 37> names{
      {{"v", "V"},
       {"volt", "V"},
       {"volts", "V"},
       {"vdc", "V"},
       {"v dc", "V"},
       {"mv", "mV"},
       {"ma", "mA"},
       {"a", "A"},
       {"amp", "A"},
       {"amps", "A"},
       {"sec", "s"},
       {"secs", "s"},
       {"second", "s"},
       {"seconds", "s"},
       {"msec", "ms"},
       {"millisec", "ms"},
       {"min", "min"},
       {"psi", "psi"},
       {"psig", "psi"},
       {"psia", "psi"},
       {"psid", "psi"},
       {"lbf/in2", "psi"},
       {"lb/in2", "psi"},
       {"kpa", "kPa"},
       {"mpa", "MPa"},
       {"pa", "Pa"},
       {"bar", "bar"},
       {"barg", "bar"},
       {"rpm", "rpm"},
       {"1/min", "rpm"},
       {"rev/min", "rpm"},
       {"deg/sec", "deg/s"},
       {"degrees/s", "deg/s"},
       {"dps", "deg/s"},
       {"\xC2\xB0/s", "deg/s"},
       {"rad/sec", "rad/s"},
       {"percent", "%"}}};
  std::string wanted = lower(text);
  if (wanted == "s" || wanted == "ms") return parse_unit(wanted);
  if (wanted == "\xB0/s") wanted = "deg/s";  // Latin-1
  if (wanted == "deg/s" || wanted == "rad/s") return parse_unit(wanted);
  const auto* const found = std::find_if(names.begin(), names.end(),
                                         [&](const auto& name) { return name.first == wanted; });
  return found != names.end() ? std::optional(parse_unit(found->second)) : std::nullopt;
}

}  // namespace boresight::io
