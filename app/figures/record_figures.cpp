#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/figure_id.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/record_figures.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using identification::RecordDefect;
using Signal = RecordTrace::Signal;

FigureSeries series_of(const ThinnedSeries& data, const std::string& name, double scale,
                       SeriesStyle style) {
  FigureSeries series = make_series(name, style, data.x, data.y);
  for (double& value : series.y) value *= scale;
  return series;
}

// The drawn value nearest to a time.
double value_at(const ThinnedSeries& data, double time) {
  double nearest = std::numeric_limits<double>::infinity(), value = 0.0;
  for (std::size_t i = 0; i < data.x.size(); ++i) {
    const double distance = std::abs(data.x[i] - time);
    if (std::isfinite(data.y[i]) && distance < nearest) {
      nearest = distance;
      value = data.y[i];
    }
  }
  return value;
}

// One mark for each kind of defect of a channel, however often it was found.
void mark_defects(const io::RecordNotes& record, const RecordTrace& trace, double scale,
                  FigurePanel& panel) {
  std::vector<const RecordDefect*> first;
  for (const auto& defect : record.defects) {
    const bool seen = std::ranges::any_of(first, [&](const auto* one) {
      return one->kind == defect.kind && one->channel == defect.channel;
    });
    if (defect.channel == trace.channel && !seen) first.push_back(&defect);
  }
  for (const auto* defect : first) {
    Eigen::Index count = 0;
    for (const auto& one : record.defects) {
      if (one.kind == defect->kind && one.channel == defect->channel) count += one.count;
    }
    panel.marks.push_back({defect->first_time, scale * value_at(trace.series, defect->first_time),
                           fmt::format("{}: {} samples, {}", to_string(defect->kind), count,
                                       to_string(defect->handling))});
  }
}

void add_trace(const io::RecordNotes& record, const RecordTrace& trace, const std::string& name,
               double scale, FigurePanel& panel) {
  panel.series.push_back(series_of(trace.series, name, scale, SeriesStyle::line));
  if (!trace.masked.x.empty()) {
    panel.series.push_back(
        series_of(trace.masked, "replacing masked samples", scale, SeriesStyle::dashed));
  }
  mark_defects(record, trace, scale, panel);
}

bool has_defect(const io::RecordNotes& record, const std::string& channel) {
  return std::ranges::any_of(record.defects,
                             [&](const auto& defect) { return defect.channel == channel; });
}

// Of the record as a whole, at the top panel.
void draw_times(const io::RecordNotes& record, FigurePanel& panel) {
  for (const auto& defect : record.defects) {
    if (!defect.channel.empty() || !std::isfinite(defect.first_time)) continue;
    panel.lines.push_back(
        {FigureLine::Direction::vertical, defect.first_time,
         fmt::format("{}, {}", to_string(defect.kind), to_string(defect.handling))});
  }
}

Figure record_figure(const io::RecordNotes& record, const std::vector<RecordTrace>& traces) {
  FigurePanel rate = make_panel(make_axis("motor rate", "rad/s"));
  FigurePanel torque = make_panel(make_axis("torque", "N.m"));
  FigurePanel valve = make_panel(make_axis("valve command", "rad/s"));
  FigurePanel pressure = make_panel(make_axis("pressure", "MPa"));
  for (const auto& trace : traces) {
    switch (trace.signal) {
      case Signal::tachometer:
        add_trace(record, trace, fmt::format("tachometer ({})", trace.channel), 1.0, rate);
        break;
      case Signal::rate_command:
        rate.series.push_back(series_of(trace.series, fmt::format("command ({})", trace.channel),
                                        1.0, SeriesStyle::dashed));
        mark_defects(record, trace, 1.0, rate);
        break;
      case Signal::valve_command:
        add_trace(record, trace, fmt::format("valve command ({})", trace.channel), 1.0, valve);
        break;
      case Signal::torque:
        add_trace(record, trace, "all motors, from the pressures", 1.0, torque);
        break;
      case Signal::pressure:
        if (has_defect(record, trace.channel)) {
          add_trace(record, trace, trace.channel, 1.0 / megapascal, pressure);
        }
        break;
    }
  }
  draw_times(record, rate);
  Figure figure;
  figure.id = figure_id("record " + record.name);
  figure.section = "Records";
  figure.title = fmt::format("Record {}: {}", record.name,
                             record.refusal.empty() ? io::to_string(record.test) : "not used");
  figure.caption =
      fmt::format("{}, {} recorded rows, at the motor shaft; minimum and maximum per pixel. {}",
                  record.path, record.rows,
                  record.defects.empty() ? "No defects were found."
                                         : "Marked: first occurrence of each kind of defect, its "
                                           "samples in the record, and its handling.");
  figure.x = make_axis("time", "s");
  for (auto* panel : {&rate, &torque, &valve, &pressure}) {
    if (!panel->series.empty()) figure.panels.push_back(std::move(*panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> record_figures(const io::CampaignNotes& notes,
                                   const std::vector<std::vector<RecordTrace>>& traces) {
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < std::min(notes.records.size(), traces.size()); ++i) {
    Figure figure = record_figure(notes.records[i], traces[i]);
    if (!figure.panels.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace boresight::app
