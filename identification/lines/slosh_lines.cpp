#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/lines/slosh_lines.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::identification {
namespace {

numerics::Interval relative_interval(double value, double relative) {
  return numerics::normal_interval(value, std::abs(value) * relative);
}

double relative(const numerics::Uncertain& number) {
  return number.standard_uncertainty / number.value;
}

double relative(const numerics::Interval& number) {
  return number.standard_uncertainty / number.value;
}

// Drawings' lengths to the lines that rang.
void assign_lengths(std::vector<LineRinging>& lines, const DriveKnowledge& knowledge,
                    std::size_t motors, std::vector<std::string>& notes) {
  const auto& lengths = knowledge.line_lengths;
  const auto length_of = [](const LineRinging& line) {
    return line.length.value_or(numerics::Uncertain{}).value;
  };
  if (lengths.empty() || lines.empty()) return;
  if (lengths.size() == 1) {
    for (auto& line : lines) line.length = lengths.front();
    if (motors > 1) {
      notes.push_back(
          fmt::format("one line length ({:.2f} m) is given for {} motors: taken for "
                      "all of them",
                      lengths.front().value, motors));
    }
    return;
  }
  if (lengths.size() >= motors) {
    for (auto& line : lines) line.length = lengths[line.motor];
    for (const auto& a : lines) {
      for (const auto& b : lines) {
        const double apart =
            3.0 * std::hypot(a.frequency.standard_uncertainty, b.frequency.standard_uncertainty);
        if (a.motor != b.motor && a.side == b.side && length_of(a) > 1.02 * length_of(b) &&
            a.frequency.value > b.frequency.value + apart) {
          notes.push_back(fmt::format(
              "motor {} has the longer line ({:.2f} against {:.2f} m) but rings faster than motor "
              "{} ({:.2f} against {:.2f} Hz): check which length belongs to which motor",
              a.motor + 1, length_of(a), length_of(b), b.motor + 1, a.frequency.value,
              b.frequency.value));
        }
      }
    }
    return;
  }
  const auto by_frequency = [](const LineRinging& a, const LineRinging& b) {
    return a.frequency.value < b.frequency.value;
  };
  // Of each side: highest to shortest, lowest to longest.
  for (const LineSide side : {LineSide::inlet, LineSide::outlet}) {
    std::vector<LineRinging*> own;
    for (auto& line : lines) {
      if (line.side == side) own.push_back(&line);
    }
    if (own.size() < 2) continue;
    const auto [low, high] = std::minmax_element(
        own.begin(), own.end(),
        [&](const LineRinging* a, const LineRinging* b) { return by_frequency(*a, *b); });
    (*high)->length = lengths.front();
    (*low)->length = lengths.back();
  }
  notes.push_back(fmt::format(
      "{} line lengths for {} motors: the highest frequency is taken for the shortest line "
      "({:.2f} m), the lowest for the longest ({:.2f} m)",
      lengths.size(), motors, lengths.front().value, lengths.back().value));
}

// Bulk modulus over density of all lines with lengths.
numerics::Uncertain pooled_square_of_wave_speed(const std::vector<LineRinging>& lines,
                                                bool common_length,
                                                std::vector<std::string>& notes) {
  std::vector<numerics::Uncertain> of_motors;
  double length_uncertainty = 0.0;
  std::vector<bool> done(lines.size(), false);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (done[k] || !lines[k].length) continue;
    std::vector<numerics::Uncertain> sides;
    for (std::size_t other = k; other < lines.size(); ++other) {
      const auto& line = lines[other];
      if (line.motor != lines[k].motor || !line.length) continue;
      done[other] = true;
      const double square = std::pow(2.0 * line.length->value * line.frequency.value, 2);
      sides.push_back({square, square * 2.0 * relative(line.frequency)});
    }
    numerics::Uncertain motor = numerics::pooled_mean(sides).mean;
    length_uncertainty = 2.0 * relative(lines[k].length.value_or(numerics::Uncertain{1.0, 0.0}));
    if (!common_length) {
      motor.standard_uncertainty =
          std::hypot(motor.standard_uncertainty, motor.value * length_uncertainty);
    }
    of_motors.push_back(motor);
  }
  const auto pooled = numerics::pooled_mean(of_motors);
  if (of_motors.size() > 1 && pooled.reduced_chi_squared() > 3.0) {
    notes.push_back(fmt::format(
        "the lines' bulk moduli scatter by {:.2f} % beyond their own uncertainties (chi squared "
        "{:.1f} a degree of freedom): a length or a port may be wrong; the interval holds it",
        100.0 * pooled.between / pooled.mean.value, pooled.reduced_chi_squared()));
  }
  numerics::Uncertain result = pooled.mean;
  if (common_length) {
    result.standard_uncertainty =
        std::hypot(result.standard_uncertainty, result.value * length_uncertainty);
  }
  return result;
}

ExtremeLines extremes_of(const std::vector<LineRinging>& lines, const DriveKnowledge& knowledge) {
  const auto [low, high] = std::minmax_element(lines.begin(), lines.end(),
                                               [](const LineRinging& a, const LineRinging& b) {
                                                 return a.frequency.value < b.frequency.value;
                                               });
  const auto [shortest, longest] = std::minmax_element(
      knowledge.line_lengths.begin(), knowledge.line_lengths.end(),
      [](const numerics::Uncertain& a, const numerics::Uncertain& b) { return a.value < b.value; });
  const auto& density = knowledge.oil_density;
  const auto own = [](const numerics::Uncertain& length, const numerics::Interval& frequency) {
    return 2.0 * std::hypot(relative(length), relative(frequency));
  };
  ExtremeLines extremes;
  extremes.highest_frequency = high->frequency.value;
  extremes.lowest_frequency = low->frequency.value;
  const double of_shortest =
      plant::bulk_modulus_from_slosh(shortest->value, extremes.highest_frequency, density.value);
  const double of_longest =
      plant::bulk_modulus_from_slosh(longest->value, extremes.lowest_frequency, density.value);
  const double u_shortest = own(*shortest, high->frequency);
  const double u_longest = own(*longest, low->frequency);
  extremes.bulk_modulus_shortest =
      relative_interval(of_shortest, std::hypot(u_shortest, relative(density)));
  extremes.bulk_modulus_longest =
      relative_interval(of_longest, std::hypot(u_longest, relative(density)));
  const double mean = 0.5 * (of_shortest + of_longest);
  const double scatter = 0.5 * std::abs(of_shortest - of_longest) / mean;
  extremes.mean = relative_interval(
      mean, std::hypot(std::max(0.5 * std::hypot(u_shortest, u_longest), scatter / 1.4),
                       relative(density)));
  return extremes;
}

}  // namespace

void add_bulk_moduli(SloshResult& result, const DriveKnowledge& knowledge, std::size_t motors) {
  assign_lengths(result.lines, knowledge, motors, result.notes);
  const auto& density = knowledge.oil_density;
  bool any_length = false;
  for (auto& line : result.lines) {
    if (!line.length) continue;
    any_length = true;
    const double speed = 2.0 * line.length->value * line.frequency.value;
    const double u = std::hypot(relative(*line.length), relative(line.frequency));
    line.wave_speed = relative_interval(speed, u);
    if (density.value > 0.0) {
      line.bulk_modulus =
          relative_interval(density.value * speed * speed, std::hypot(2.0 * u, relative(density)));
    }
  }
  if (!any_length) {
    result.notes.emplace_back("no line length is given: frequencies without a bulk modulus");
    return;
  }
  const auto square =
      pooled_square_of_wave_speed(result.lines, knowledge.line_lengths.size() == 1, result.notes);
  result.wave_speed = relative_interval(std::sqrt(square.value), 0.5 * relative(square));
  if (density.value > 0.0) {
    result.bulk_modulus = relative_interval(density.value * square.value,
                                            std::hypot(relative(square), relative(density)));
    if (result.lines.size() > 1) result.extreme_lines = extremes_of(result.lines, knowledge);
  }
}

}  // namespace boresight::identification
