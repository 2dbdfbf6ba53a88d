#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <boresight/app/figures/figure_id.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

const design::SimulatedChannel* find(const design::SimulatedRecord& record, std::string_view name) {
  const auto found = std::ranges::find(record.channels, name, &design::SimulatedChannel::name);
  return found == record.channels.end() ? nullptr : &*found;
}

// Draws a channel, if the record has it.
void draw(const design::SimulatedRecord& record, std::string_view name, const std::string& called,
          SeriesStyle style, FigurePanel& panel) {
  const auto* channel = find(record, name);
  if (channel == nullptr) return;
  const auto curve = thinned(record.channels.front().values, channel->values);
  panel.series.push_back(make_series(called, style, curve.x, curve.y));
}

void keep(FigurePanel panel, Figure& figure) {
  if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
}

std::string caption_of(const std::string& description, const design::SimulatedRecord& record) {
  return fmt::format("{}; {} samples, minimum and maximum per pixel.{}", description,
                     record.channels.front().values.size(),
                     record.complete ? "" : " The run was interrupted here.");
}

// Torque of all motors: the mean of the motors' pressure differences times what it makes.
void draw_torque(const design::SimulatedRecord& record, double torque_per_pressure,
                 FigurePanel& panel) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(record.channels.front().values.size());
  double motors = 0.0;
  for (int motor = 1;; ++motor) {
    const auto* inlet = find(record, fmt::format("p{}_in", motor));
    const auto* outlet = find(record, fmt::format("p{}_out", motor));
    if (inlet == nullptr || outlet == nullptr) break;
    sum += inlet->values - outlet->values;
    motors += 1.0;
  }
  if (motors == 0.0) return;
  const auto curve =
      thinned(record.channels.front().values, sum * (megapascal * torque_per_pressure / motors));
  panel.series.push_back(
      make_series("all motors, from the pressures", SeriesStyle::line, curve.x, curve.y));
}

void mark_starts(const DriveTestSection& record, FigurePanel& panel) {
  const auto* tachometer = find(record, "tach");
  if (tachometer == nullptr) return;
  for (const bool upward : {true, false}) {
    const auto start = first_start(record.events, upward);
    if (!start || !(record.sample_time > 0.0)) continue;
    const auto at = static_cast<Eigen::Index>(start->time / record.sample_time);
    if (at < 0 || at >= tachometer->values.size()) continue;
    FigureMark& mark = panel.marks.emplace_back();
    mark.x = start->time;
    mark.y = tachometer->values[at];
    mark.label = upward ? "breaks away upward" : "breaks away downward";
  }
  for (const auto& channel : record.clipped) {
    panel.lines.push_back(vertical_line(
        channel.first, fmt::format("{} clipped, {} samples", channel.name, channel.samples)));
  }
}

}  // namespace

Figure drive_test_figure(const DriveTestSection& record, double torque_per_pressure) {
  Figure figure = make_figure(
      figure_id("simulated " + record.test), "Tests of the drive (true values, at the motor shaft)",
      fmt::format("Simulated test {}", record.test), "", make_axis("time", "s"));
  if (record.channels.empty()) return figure;
  figure.caption = caption_of(
      record.description + "; as the recorder of the nonlinear antenna would show it", record);
  FigurePanel rate = make_panel(make_axis("recorded", "V"));
  draw(record, "tach", "tachometer", SeriesStyle::line, rate);
  draw(record, "rate_command", "rate command", SeriesStyle::dashed, rate);
  mark_starts(record, rate);
  keep(std::move(rate), figure);
  FigurePanel pressure = make_panel(make_axis("pressure, motor 1", "MPa"));
  draw(record, "p1_in", "inlet", SeriesStyle::line, pressure);
  draw(record, "p1_out", "outlet", SeriesStyle::dashed, pressure);
  keep(std::move(pressure), figure);
  FigurePanel torque = make_panel(make_axis("torque", "N.m"));
  draw_torque(record, torque_per_pressure, torque);
  keep(std::move(torque), figure);
  FigurePanel valve = make_panel(make_axis("valve command", "V"));
  draw(record, "valve_command", "valve command", SeriesStyle::line, valve);
  keep(std::move(valve), figure);
  return figure;
}

Figure position_test_figure(const PositionTestSection& record) {
  const bool slew = record.test == "slew";
  Figure figure =
      make_figure(figure_id("simulated " + record.test), "Position loop, at the sky (mdeg)",
                  fmt::format("Simulated {}", record.test), "", make_axis("time", "s"));
  if (record.channels.empty()) return figure;
  figure.caption = caption_of(record.description, record);
  if (record.boresight_rms) {
    figure.caption += fmt::format(" Boresight rms about its mean {:.3f} mdeg",
                                  *record.boresight_rms / millidegree);
    figure.caption += record.predicted_rms ? fmt::format(", linear prediction {:.3f} mdeg.",
                                                         *record.predicted_rms / millidegree)
                                           : ".";
  }
  FigurePanel error = make_panel(make_axis("error at the sky", "mdeg"));
  draw(record, "boresight_error", "boresight", SeriesStyle::line, error);
  draw(record, "encoder_error", "encoder", SeriesStyle::dashed, error);
  if (slew) {
    for (const double limit : {-1.0, 1.0}) {
      error.lines.push_back(horizontal_line(limit, limit > 0.0 ? "settled within 1 mdeg" : ""));
    }
  }
  keep(std::move(error), figure);
  if (slew) {
    FigurePanel reference = make_panel(make_axis("command", "deg"));
    draw(record, "reference", "command", SeriesStyle::line, reference);
    keep(std::move(reference), figure);
  }
  FigurePanel torque = make_panel(make_axis("torque at the motors", "N.m"));
  draw(record, "motor_torque", "motors", SeriesStyle::line, torque);
  draw(record, "wind_torque_at_motor", "wind", SeriesStyle::dashed, torque);
  keep(std::move(torque), figure);
  FigurePanel rate = make_panel(make_axis("motor rate", "rad/s"));
  draw(record, "motor_rate", "motors", SeriesStyle::line, rate);
  draw(record, "valve_command", "valve command", SeriesStyle::dashed, rate);
  keep(std::move(rate), figure);
  return figure;
}

}  // namespace boresight::app
