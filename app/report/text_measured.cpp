#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::MeasuredTuningStatus;
using Rows = std::vector<std::vector<std::string>>;

std::string mdeg(const MeasuredTuneSection& section, double motor_angle) {
  return fmt::format("{:.4f}", motor_angle / section.gear_ratio / millidegree);
}

bool has_controller(const MeasuredController& controller) {
  return controller.tuning.status != MeasuredTuningStatus::unstable;
}

std::string peak_text(const design::MeasuredPeak& peak) {
  return fmt::format("{:.3f} / {:.3f}{}", peak.measured.magnitude, peak.within_confidence.magnitude,
                     peak.basis == control::ResponseBasis::measured ? "" : "*");
}

Document record_part(const MeasuredTuneSection& section) {
  if (!section.channels) return {};
  const control::MeasuredChannels& channels = *section.channels;
  Document text = wrapped(
      fmt::format("Record {}: {:.1f} s from {:.1f} s on, at {:.3g} rad/s of motor. The valve "
                  "command excites {:.3g} to {:.3g} Hz; {} frequencies from {:.3g} to {:.3g} Hz "
                  "are usable, {} left out as not coherent; they resolve {:.0f} % of the band.",
                  section.record, section.length, section.start, section.mean_rate,
                  section.lowest_excited, section.highest_excited, channels.frequency().size(),
                  channels.lowest_frequency() / two_pi, channels.highest_frequency() / two_pi,
                  channels.points_left_out(), 100.0 * channels.resolved_fraction()),
      "  ");
  if (!section.encoder_column.empty() && !channels.encoder_assumed().empty()) {
    text += wrapped(
        fmt::format("The encoder ({}) is incoherent in places from {:.3g} Hz on: there it is "
                    "assumed to follow the motor, with 100 % uncertainty.",
                    section.encoder_column, channels.encoder_assumed().front().lowest / two_pi),
        "  ");
  }
  return text + wrapped(fmt::format("Lowest frequencies: inertia {:.4g} kg.m2 and friction {:.3g} "
                                    "N.m.s/rad at the motor shaft.",
                                    channels.low_end_inertia(), channels.low_end_friction()),
                        "  ");
}

Document controllers_part(const MeasuredTuneSection& section) {
  Rows rows{{"structure", "rms mdeg", "wind", "noise", "S rate", "S valve", "S pos.",
             "effort rad/s", "assumed", "check"}};
  for (const auto& controller : section.controllers) {
    if (!has_controller(controller)) {
      rows.push_back({controller.structure});
      rows.back().insert(rows.back().end(), 8, "-");
      rows.back().emplace_back("none stable");
      continue;
    }
    const auto& tuning = controller.tuning;
    rows.push_back({controller.structure, mdeg(section, tuning.rms), mdeg(section, tuning.wind_rms),
                    mdeg(section, tuning.noise_rms)});
    for (const auto& peak : tuning.verification.peaks) rows.back().push_back(peak_text(peak));
    rows.back().push_back(fmt::format("{:.3f}", tuning.control_effort));
    rows.back().push_back(fmt::format("{:.1f} %", 100.0 * tuning.wind_fraction.total()));
    rows.back().emplace_back(tuning.status == MeasuredTuningStatus::confident ? "verified"
                             : tuning.status == MeasuredTuningStatus::nominal
                                 ? "not confident"
                                 : "misses constraints");
  }
  return essential(table(rows, "l")) +
         wrapped(
             "S: maximum sensitivity Ms as measured / within the confidence region, with the loop "
             "cut at rate loop alone, valve command, position loop; *: at a frequency that was not "
             "measured. assumed: fraction of the wind's variance from such frequencies.",
             "  ");
}

Document gains_part(const MeasuredController& controller) {
  std::vector<std::string> gains;
  const auto& descriptions = control::gain_descriptions(controller.tuning.controller.structure);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    gains.push_back(fmt::format("{} {:.5g}{}", descriptions[k].symbol,
                                controller.tuning.controller.gains[k],
                                descriptions[k].unit == "1" ? "" : " " + descriptions[k].unit));
  }
  return wrapped(fmt::format("{}: {}.", controller.structure, fmt::join(gains, ", ")), "  ", "  ");
}

Document verdict_part(const MeasuredController& controller) {
  const auto& tuning = controller.tuning;
  const auto& check = tuning.verification;
  std::string text = fmt::format(
      "{}: {}{}. Confidence {:g} % at each frequency; the response's errors change 1 + L by at "
      "most {:.0f} %. |L| at the highest measured frequency is {:.2g} (rate loop alone) and "
      "{:.2g}: a resonance above it that raises the response {:.2g} times is not examined. The "
      "confidence costs {:.1f} % of rms. 1 % more oil stiffness would change the rms by {:+.2f} %, "
      "1 % more loss by {:+.2f} %.",
      controller.structure, design::to_string(tuning.status),
      check.failure.empty() ? "" : ": " + check.failure, 100.0 * tuning.confidence,
      100.0 * check.largest_error, check.gain_at_highest[0], check.gain_at_highest[1],
      1.0 / std::max(check.gain_at_highest[0], check.gain_at_highest[1]),
      100.0 * (tuning.rms / tuning.nominal_rms - 1.0), tuning.by_stiffness, tuning.by_loss_rate);
  const auto& on_case = controller.peaks_on_case;
  text += controller.stable_on_case
              ? fmt::format(
                    " On the case's linear plant the same gains have Ms {:.2f}, {:.2f} and {:.2f}.",
                    on_case[0], on_case[1], on_case[2])
              : " On the case's linear plant the same gains are UNSTABLE: do not use them without "
                "a record at tracking speed.";
  if (!tuning.active_constraints.empty()) {
    text += fmt::format(" Active constraints: {}.", fmt::join(tuning.active_constraints, "; "));
  }
  if (!tuning.gains_at_bound.empty()) {
    text += fmt::format(" At the search limit: {}.", fmt::join(tuning.gains_at_bound, ", "));
  }
  return wrapped(text, "  ", "  ");
}

}  // namespace

Document document_of(const MeasuredTuneSection& section) {
  Document text = heading(
      fmt::format("Loops tuned on the measured response, wind {:.3g} m/s", section.wind_speed));
  text += record_part(section) + "\n" + controllers_part(section);
  text += heading("Gains, SI at the motor shaft");
  for (const auto& controller : section.controllers) {
    if (has_controller(controller)) text += essential(gains_part(controller));
  }
  text += heading("Basis of the verdicts");
  for (const auto& controller : section.controllers) {
    if (has_controller(controller)) text += verdict_part(controller);
  }
  for (const auto& note : section.notes) text += wrapped("- " + note + ".", "  ", "  ");
  return text;
}

std::vector<std::string> conclude(const MeasuredTuneSection& section) {
  std::vector<std::string> sentences;
  for (const auto& controller : section.controllers) {
    const auto& tuning = controller.tuning;
    sentences.push_back(
        has_controller(controller)
            ? fmt::format(
                  "{} on the measured response: encoder rms {} mdeg in {:.3g} m/s for wind at "
                  "the motor shaft, {}.",
                  controller.structure, mdeg(section, tuning.rms), section.wind_speed,
                  design::to_string(tuning.status))
            : fmt::format("{} on the measured response: no stable controller found.",
                          controller.structure));
  }
  return sentences;
}

}  // namespace boresight::app
