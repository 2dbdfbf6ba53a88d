#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/limit_cycle_wording.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "-";
}

std::string decibel(double gain) {
  return std::isfinite(gain) && gain > 0.0 ? fmt::format("{:.1f}", 20.0 * std::log10(gain)) : "-";
}

// Where less than half of the hydraulic mode is oil, and which mode has most.
Document oil_modes_part(const MatchSection& section) {
  std::vector<const MatchPoint*> points;
  for (const auto& point : section.points) {
    if (io::little_of_oil(point.hydraulic, point.oil_mode)) points.push_back(&point);
  }
  if (points.empty()) return {};
  const auto described = [](const MatchPoint& point) {
    return fmt::format("{:.3g} Hz (zeta {:.3f}) with {:.2f} disks", point.oil_mode.frequency,
                       point.oil_mode.damping_ratio, point.disks);
  };
  return wrapped(fmt::format("Less than half of the hydraulic mode's elastic energy is in the "
                             "oil{}; the dominant hydraulic mode is at {}{}.",
                             points.size() == section.points.size()
                                 ? ""
                                 : fmt::format(" at {} of these inertias", points.size()),
                             described(*points.front()),
                             points.size() == 1 ? "" : " to " + described(*points.back())),
                 "  ");
}

Document motors_part(const MatchSection& section) {
  Rows rows{{"disks", "R", "J kg.m2", "hydr. Hz", "zeta", "deg/s2", "slew s", "rule zeta",
             "of best a", ""}};
  for (const auto& point : section.points) {
    rows.push_back({fmt::format("{:.2f}", point.disks),
                    fmt::format("{:.3f}", point.motor_to_load_ratio),
                    fmt::format("{:.3f}", point.reflected_inertia),
                    fmt::format("{:.3f}", point.hydraulic.frequency),
                    fmt::format("{:.3f}", point.hydraulic.damping_ratio),
                    fmt::format("{:.3f}", point.acceleration / degree),
                    std::isfinite(point.slew_time) ? fmt::format("{:.1f}", point.slew_time) : "-",
                    fmt::format("{:.2f}", point.two_mass_damping),
                    fmt::format("{:.2f}", point.acceleration_of_best_ratio), label_of(point)});
  }
  return table(rows, "rrrrrrrrrl") +
         wrapped(
             fmt::format(
                 "R: motors over gear train and antenna. hydr., zeta: the hydraulic mode, the "
                 "lowest that moves the oil, with the structure bending. deg/s2: at the sky, {} at "
                 "{:.3g} deg/s, the case's slew rate or four fifths of what supply and valve hold. "
                 "slew: {:.3g} deg at that rate and acceleration. rule zeta: 1/2 sqrt(J_L/J_m). of "
                 "best a: acceleration for given torque over the maximum at any gear ratio.",
                 section.slew_by_simulation
                     ? "half of what the torque beyond valve drop and friction gives,"
                     : "what the supply torque beyond friction gives, without valve drop or "
                       "reserve,",
                 section.slew_rate / degree, section.slew_distance / degree),
             "  ") +
         oil_modes_part(section);
}

Document rms_part(const MatchSection& section) {
  Rows rows{{"disks", "R"}};
  std::string alignment = "rr";
  for (const auto& series : section.series) {
    rows.front().push_back(series.name);
    alignment += 'r';
  }
  rows.front().emplace_back();
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const auto& point = section.points[i];
    std::vector<std::string> row{fmt::format("{:.2f}", point.disks),
                                 fmt::format("{:.3f}", point.motor_to_load_ratio)};
    for (const auto& series : section.series) {
      const auto& value = series.values[i];
      std::string text = mdeg(value.boresight_rms);
      if (!value.found && std::isfinite(value.boresight_rms)) text += '!';
      if (series.best == i) text += '*';
      row.push_back(text);
    }
    row.push_back(label_of(point));
    rows.push_back(std::move(row));
  }
  return table(rows, alignment + "l") + wrapped(
                                            "*: minimum of its column. !: violates a constraint on "
                                            "some plant; -: no stable controller found.",
                                            "  ");
}

Document best_part(const MatchSection& section) {
  Rows rows{{"structure", "disks", "R", "mdeg", "within 1 %", "within 5 %", "kinks", "3rd diff.",
             "at kinks"}};
  for (const auto& series : section.series) {
    std::vector<std::string> row{series.name};
    if (series.best) {
      const auto& point = section.points[*series.best];
      row.insert(row.end(),
                 {fmt::format("{:.2f}{}", point.disks, series.best_at_end ? " (end)" : ""),
                  fmt::format("{:.2f}", point.motor_to_load_ratio),
                  mdeg(series.values[*series.best].boresight_rms),
                  fmt::format("{:.1f}..{:.1f}", series.within_1_percent.lowest,
                              series.within_1_percent.highest),
                  fmt::format("{:.1f}..{:.1f}", series.within_5_percent.lowest,
                              series.within_5_percent.highest)});
    } else {
      row.insert(row.end(), 5, "-");
    }
    const auto& smooth = series.smoothness;
    row.push_back(fmt::format("{}", smooth.kinks.size()));
    row.push_back(smooth.even_stretches == 0
                      ? "-"
                      : fmt::format("{:.1e} ({})", smooth.largest_even, smooth.even_stretches));
    row.push_back(fmt::format("{:.1e}", smooth.largest_at_kinks));
    rows.push_back(std::move(row));
  }
  return table(rows, "lrrrrrrrr") +
         wrapped(fmt::format("Ranges in disks. 3rd diff.: largest third difference of ln rms over "
                             "four points with the same active constraints (how many), to be below "
                             "3 x {:g}, three times the tuner's tolerance; at kinks: where active "
                             "constraints, plants or solution branches change.",
                             section.tolerance),
                 "  ");
}

std::vector<std::size_t> shown_points(const MatchSection& section, const MatchSeries& series) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    if (i == 0 || !label_of(section.points[i]).empty() || series.best == i) shown.push_back(i);
  }
  return shown;
}

Document margins_part(const MatchSection& section) {
  Rows rows{{"structure", "disks", "wind", "noise", "dB up", "dB down", "deg", "ms", "Hz", "s2",
             "effort", "demand", "N.m", "check"}};
  for (const auto& series : section.series) {
    for (const std::size_t i : shown_points(section, series)) {
      const auto& value = series.values[i];
      if (!std::isfinite(value.boresight_rms)) continue;
      double up = HUGE_VAL, down = 0.0, phase = 180.0, delay = HUGE_VAL;
      for (const auto& margins : value.margins) {
        up = std::min(up, margins.increasing_gain_margin);
        down = std::max(down, margins.decreasing_gain_margin);
        phase = std::min(phase, margins.phase_margin_deg);
        delay = std::min(delay, margins.delay_margin);
      }
      rows.push_back(
          {series.name, fmt::format("{:.2f}", section.points[i].disks), mdeg(value.wind_rms),
           mdeg(value.noise_rms), decibel(up), decibel(down), fmt::format("{:.1f}", phase),
           fmt::format("{:.1f}", 1e3 * delay), fmt::format("{:.3f}", value.bandwidth),
           fmt::format("{:.3g}", value.acceleration_error),
           fmt::format("{:.3f}", value.control_effort), fmt::format("{:.2f}", value.gust_demand),
           fmt::format("{:.0f}", value.gust_torque),
           value.verification.passed ? "passed" : value.verification.failure});
    }
  }
  return table(rows, "lrrrrrrrrrrrrl") +
         wrapped(
             fmt::format(
                 "On the case's plant. wind, noise: rms, mdeg. dB, deg, ms: smallest gain, "
                 "phase and delay margin of the three breaks. Hz: where the position loop's "
                 "|S| reaches 0.71. s2: mdeg of error per mdeg/s2 of constant acceleration that "
                 "is not fed forward, steady with a position integral, otherwise after "
                 "1/(2 pi f) at the lowest frequency f of the analysis. effort: control effort, "
                 "rad/s. demand "
                 "(rad/s), N.m: valve and motors in the mean wind and {:g} times the rms of "
                 "its gusts. check: eigenvalues, Ms and rms confirmed independently.",
                 section.goals.crest_factor),
             "  ");
}

std::string limit_cycle_text(const std::vector<design::LimitCycleResult>& limit_cycles,
                             std::size_t which) {
  if (which >= limit_cycles.size()) return "-";
  return limit_cycle_cell(limit_cycles[which]);
}

Document time_part(const MatchSection& section) {
  Rows rows{{"structure", "disks", "limit cycle at rest", "at tracking rate", "reversal encoder",
             "boresight", "without friction"}};
  for (const auto& series : section.series) {
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const auto& run = series.values[i].time_domain;
      if (!run) continue;
      std::vector<std::string> row{series.name, fmt::format("{:.2f}", section.points[i].disks),
                                   limit_cycle_text(run->limit_cycles, 0),
                                   limit_cycle_text(run->limit_cycles, 1)};
      if (run->reversal) {
        row.insert(row.end(),
                   {mdeg(run->reversal->encoder_error), mdeg(run->reversal->boresight_error),
                    mdeg(run->reversal->encoder_error_without_friction)});
      }
      rows.push_back(std::move(row));
    }
  }
  if (rows.size() == 1) return {};
  return "\n" + table(rows, "lrrrrrr") +
         wrapped(fmt::format("On the nonlinear antenna. {}. reversal: largest error (mdeg) after "
                             "velocity reversals at {:.4g} mdeg/s.",
                             limit_cycle_legend(), section.tracking_rate / millidegree),
                 "  ");
}

Document variants_part(const MatchSection& section) {
  Document text;
  for (const auto& variants : section.variants) {
    text += subheading(fmt::format("{}, tuned on single plants: rms (mdeg) by number of disks",
                                   variants.structure));
    std::vector<std::string> header{"with"};
    for (const double disks : variants.disks) header.push_back(fmt::format("{:.3g}", disks));
    header.insert(header.end(), {"best", "within 5 %"});
    Rows rows{std::move(header)};
    for (const auto& variant : variants.variants) {
      std::vector<std::string> row{name_of(variant)};
      for (const double rms : variant.rms) row.push_back(mdeg(rms));
      row.push_back(variant.best ? fmt::format("{:.3g}", variants.disks[*variant.best]) : "-");
      row.push_back(fmt::format("{:.1f}..{:.1f}", variant.within_5_percent.lowest,
                                variant.within_5_percent.highest));
      rows.push_back(std::move(row));
    }
    text += table(rows, "l");
  }
  return text;
}

Document rules_part(const MatchSection& section) {
  std::vector<std::string> header{"rule", "R", "disks"};
  for (const auto& series : section.series) header.push_back(series.name);
  Rows rows{std::move(header)};
  for (const auto& rule : section.rules) {
    std::vector<std::string> row{text_of(rule.rule),
                                 fmt::format("{:.2f}", rule.motor_to_load_ratio),
                                 rule.disks ? fmt::format("{:.2f}", *rule.disks) : "-"};
    for (const double cost : rule.cost) {
      row.push_back(std::isfinite(cost) ? fmt::format("{:+.1f} %", 100.0 * cost) : "-");
    }
    rows.push_back(std::move(row));
  }
  return "\n" + table(rows, "l") +
         wrapped("Cost: rms over each structure's own minimum, interpolated linearly.", "  ");
}

}  // namespace

Document document_of(const MatchSection& section) {
  Document text = heading("Inertia matching");
  text += wrapped(
      fmt::format("Each structure tuned at each motor inertia for {:.3g} m/s of wind ({} model), "
                  "every constraint met on {} plants (objective: {} rms); {} random starts each "
                  "and {} rounds of warm starts{}, {} evaluations.",
                  section.wind_speed, plant::to_string(section.wind_model),
                  std::max<std::size_t>(section.members, 1), to_string(section.objective.kind),
                  section.starts, section.rounds,
                  section.settled ? " until converged" : ", not converged", section.evaluations),
      "  ");
  text += "\n" + motors_part(section);
  text += "\n" + essential(rms_part(section));
  text += "\n" + best_part(section);
  text += "\n" + margins_part(section);
  text += time_part(section);
  text += variants_part(section);
  text += rules_part(section);
  return text;
}

}  // namespace boresight::app
