#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

// In the order of control::loop_breaks.
constexpr std::array peak_keys{"sensitivity_peak_rate_loop", "sensitivity_peak_valve",
                               "sensitivity_peak_position"};

// What may be left out of a case; a change has nothing else.
void read_optional_goals(TableReader& table, GoalsEntry& goals) {
  const auto take = [&](const char* key, Kind kind, const Range& range,
                        std::optional<Quantity>& goal) {
    if (auto found = table.optional_quantity(key, kind, range)) goal = std::move(found);
  };
  for (std::size_t b = 0; b < peak_keys.size(); ++b) {
    take(peak_keys[b], Kind::number, Range::between(1.01, 100.0), goals.peak_at_break[b]);
  }
  take("gain_margin", Kind::level, Range::positive(40.0), goals.gain_margin);
  take("phase_margin", Kind::angle, Range::positive(1.5), goals.phase_margin);
  take("bandwidth", Kind::bandwidth_frequency, Range::positive(1e4), goals.bandwidth);
  take("sensitivity_peak_standstill", Kind::number, Range::between(1.01, 100.0),
       goals.standstill_peak);
  take("limit_cycle_amplitude", Kind::angle, Range::positive(0.01), goals.limit_cycle_amplitude);
  take("static_encoder_error", Kind::angle, Range::not_negative(0.01), goals.static_encoder_error);
  take("crest_factor", Kind::number, Range::between(1.0, 10.0), goals.crest_factor);
  take("beam_rms", Kind::angle, Range::positive(1.0), goals.boresight_rms);
  if (table.has("soft_goal") || table.optional_text("soft_goal")) {
    const std::string kind =
        table.choice("soft_goal", {"nominal", "expected", "worst_case", "quantile"});
    for (const auto known : {ObjectiveKind::nominal, ObjectiveKind::expected,
                             ObjectiveKind::worst_case, ObjectiveKind::quantile}) {
      if (kind == to_string(known)) goals.objective = known;
    }
  }
  if (table.has("rms_over") || table.optional_text("rms_over")) {
    goals.over_climate = table.choice("rms_over", {"design_speed", "climate"}) == "climate";
  }
  if (const auto quantile =
          table.optional_quantity("quantile", Kind::number, Range::between(0.5, 0.999))) {
    if (goals.objective != ObjectiveKind::quantile) {
      table.refuse("quantile", "expected it with the soft_goal 'quantile' only, found it with '" +
                                   std::string(to_string(goals.objective)) + "'");
    }
    goals.quantile = quantile->value;
  }
}

void check_band(const TableReader& table, const GoalsEntry& goals) {
  if (goals.highest_frequency.value <= goals.lowest_frequency.value) {
    table.refuse("highest_frequency", "expected a frequency above lowest_frequency, found " +
                                          in_quotes(goals.highest_frequency.text));
  }
}

constexpr Range peak_range = Range::between(1.01, 100.0);
constexpr Range effort_range = Range::positive();
constexpr Range lowest_range = Range::between(1e-6, 1.0);
constexpr Range highest_range = Range::between(1.0, 1e4);

}  // namespace

std::string_view to_string(ObjectiveKind kind) {
  static constexpr std::array names{"nominal", "expected", "worst_case", "quantile"};
  return names.at(static_cast<std::size_t>(kind));
}

namespace {

// Without counts of its own the study goes to twice what the antenna has, in six steps or ones.
void read_matching(TableReader& file, Case& antenna) {
  const auto built = static_cast<long>(antenna.motor->flywheel_disks);
  const long usual_most = built > 0 ? 2 * built : 12;
  std::optional<long> maximum;
  std::optional<long> step;
  if (auto matching = file.optional_table("matching")) {
    maximum = matching->optional_integer("most_disks", 1, 10000);
    step = matching->optional_integer("step", 1, maximum.value_or(usual_most));
    matching->finish();
  }
  const long last = maximum.value_or(usual_most);
  const long by = step.value_or(std::max(1L, last / 6));
  for (long disks = 0; disks <= last; disks += by) {
    antenna.matching->disks.push_back(static_cast<double>(disks));
  }
}

}  // namespace

void read_goals(TableReader& file, Case& antenna) {
  TableReader table = file.table("goals");
  GoalsEntry& goals = *antenna.goals;
  goals.sensitivity_peak = table.quantity("sensitivity_peak", Kind::number, peak_range);
  constexpr double usual_effort = 0.6 / 125.0;
  goals.control_effort =
      table.quantity_or("valve_effort", Kind::angular_rate, effort_range,
                        usual_effort * antenna.drive->slew_rate.value * gear_ratio(antenna),
                        "usual: 0.6 rad/s with motors that turn at 125 rad/s at slew");
  goals.lowest_frequency = table.quantity("lowest_frequency", Kind::frequency, lowest_range);
  goals.highest_frequency = table.quantity("highest_frequency", Kind::frequency, highest_range);
  read_optional_goals(table, goals);
  table.finish();
  check_band(table, goals);

  read_matching(file, antenna);
}

void change_goals(GoalsEntry& goals, const std::vector<std::string>& changes) {
  std::string text;
  for (const auto& change : changes) {
    const std::size_t equals = change.find('=');
    const std::string key = change.substr(0, equals);
    const bool plain =
        !key.empty() && key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
    // Of what is left, only these could end the text that the value becomes.
    if (equals == std::string::npos || !plain ||
        change.find_first_of("'\n\r", equals) != std::string::npos) {
      throw InvalidInput(
          "--goal: expected KEY=VALUE with a key of [goals], such as "
          "valve_effort=\"0.4 rad/s\", found " +
          in_quotes(change));
    }
    text += fmt::format("{} = '{}'\n", key, change.substr(equals + 1));
  }
  TableReader table = TableReader::parse(text, "--goal");
  const auto take = [&](const char* key, Kind kind, const Range& range, Quantity& goal) {
    if (auto found = table.optional_quantity(key, kind, range)) goal = std::move(*found);
  };
  take("sensitivity_peak", Kind::number, peak_range, goals.sensitivity_peak);
  take("valve_effort", Kind::angular_rate, effort_range, goals.control_effort);
  take("lowest_frequency", Kind::frequency, lowest_range, goals.lowest_frequency);
  take("highest_frequency", Kind::frequency, highest_range, goals.highest_frequency);
  read_optional_goals(table, goals);
  table.finish();
  check_band(table, goals);
}

}  // namespace boresight::io
