#include <string>
#include <vector>

#include <boresight/app/report/measured_report.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

using control::ResponseBasis;
using design::MeasuredTuningStatus;

std::string_view basis_name(ResponseBasis basis) {
  switch (basis) {
    case ResponseBasis::assumed_below:
      return "assumed below";
    case ResponseBasis::measured:
      return "measured";
    case ResponseBasis::encoder_assumed:
      return "encoder assumed";
    case ResponseBasis::unresolved:
      return "unresolved";
    case ResponseBasis::assumed_above:
      return "assumed above";
  }
  return "measured";
}

std::string_view status_name(MeasuredTuningStatus status) {
  switch (status) {
    case MeasuredTuningStatus::confident:
      return "confident";
    case MeasuredTuningStatus::nominal:
      return "nominal";
    case MeasuredTuningStatus::infeasible:
      return "infeasible";
    case MeasuredTuningStatus::unstable:
      return "unstable";
  }
  return "unstable";
}

void describe_fraction(io::Visitor& v, std::string_view key,
                       const design::AssumedFraction& fraction, std::string_view meaning) {
  v.group(key, meaning, [&] {
    v.number("below", fraction.below, unit::ratio, "Below the lowest usable frequency.");
    v.number("encoder", fraction.encoder, unit::ratio,
             "Where only the encoder's angle is assumed.");
    v.number("unresolved", fraction.unresolved, unit::ratio,
             "Where the points do not resolve the response.");
    v.number("above", fraction.above, unit::ratio, "Above the highest usable frequency.");
  });
}

// A gain of a controller.
struct MeasuredGain {
  control::GainDescription gain;
  double value = 0.0;
};

void describe_gains(io::Visitor& v, const control::Controller& controller) {
  std::vector<MeasuredGain> gains;
  for (std::size_t k = 0; k < controller.gains.size(); ++k) {
    gains.push_back({control::gain_descriptions(controller.structure).at(k), controller.gains[k]});
  }
  v.list("gains", gains, "In the structure's order.", [&](const MeasuredGain& one) {
    v.text("name", one.gain.name, "Name.");
    v.text("symbol", one.gain.symbol, "Symbol.");
    v.text("unit", one.gain.unit, "SI unit, of the motor shaft.");
    v.number("value", one.value, {.suffix = "si"}, "Value.");
  });
}

// The loop cut at one place.
struct MeasuredBreak {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  design::MeasuredPeak peak;
  control::MeasuredMargins margins;
};

void describe_breaks(io::Visitor& v, const design::MeasuredVerification& check) {
  std::vector<MeasuredBreak> breaks;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    breaks.push_back({control::loop_breaks.at(b), check.peaks.at(b), check.margins.at(b)});
  }
  v.list("loop_breaks", breaks, "By loop break.", [&](const MeasuredBreak& one) {
    io::describe_break(v, "loop_break", one.loop_break);
    v.number("sensitivity_peak", one.peak.measured.magnitude, unit::ratio, "As measured.");
    v.number("sensitivity_peak_frequency", one.peak.measured.frequency, unit::hertz_of_radians,
             "Where.");
    v.number("sensitivity_peak_within_confidence", one.peak.within_confidence.magnitude,
             unit::ratio, "Largest over the responses within the confidence; null: they reach -1.");
    v.number("within_confidence_frequency", one.peak.within_confidence.frequency,
             unit::hertz_of_radians, "Where.");
    v.word("basis", basis_name(one.peak.basis),
           {"assumed below", "measured", "encoder assumed", "unresolved", "assumed above"},
           "What the response rests on there.");
    v.number("phase_margin", one.margins.margins.phase_margin_deg, unit::degree_as_kept,
             "On the measured points.");
    v.count("unresolved_intervals", one.margins.unresolved.size(),
            "Intervals in which the points do not resolve the loop gain.");
  });
}

void describe_check(io::Visitor& v, const MeasuredController& controller) {
  const auto& check = controller.tuning.verification;
  describe_breaks(v, check);
  v.flag("verified", check.passed, "On the measured points by other code than the tuner's.");
  v.text_or_null("verification_failure", check.failure, "Why not; null if it is.");
  v.count("unstable_poles_rate_loop_alone", check.unstable[0], "By the encirclements of 1 + L.");
  v.count("unstable_poles", check.unstable[1], "The same with both loops closed.");
  v.number("largest_relative_error", check.largest_error, unit::ratio,
           "Of 1 + L within the confidence; below 1 none changes its encirclements.");
  v.number("loop_gain_at_highest_rate_loop_alone", check.gain_at_highest[0], unit::ratio,
           "|L| where the measurement ends.");
  v.number("loop_gain_at_highest", check.gain_at_highest[1], unit::ratio,
           "The same with both loops closed.");
  v.flag("stable_on_case", controller.stable_on_case,
         "The same gains on the case's linear plant, by eigenvalues.");
  v.numbers_if("sensitivity_peaks_on_case", controller.stable_on_case, controller.peaks_on_case,
               unit::ratio, "Theirs there, by loop break; null if unstable.", {.finite = true});
}

void describe_controller(io::Visitor& v, const MeasuredTuneSection& section,
                         const MeasuredController& controller) {
  const auto& tuning = controller.tuning;
  const io::KeyUnit sky{.suffix = "mdeg",
                        .multiplier = 1.0 / section.gear_ratio / unit::millidegree.divisor};
  v.text("structure", controller.structure, "As the user names it.");
  v.word("status", status_name(tuning.status), {"confident", "nominal", "infeasible", "unstable"},
         "Goals met within the confidence, by the measured response only, not met, or no stable "
         "controller.");
  v.members_if(tuning.status != MeasuredTuningStatus::unstable, [&] {
    describe_gains(v, tuning.controller);
    v.number("rms", tuning.rms, sky, "Of the encoder at the sky, one axis.");
    v.number("wind_rms", tuning.wind_rms, sky, "Its part by wind.");
    v.number("noise_rms", tuning.noise_rms, sky, "Its part by sensor noise.");
    v.number("nominal_rms", tuning.nominal_rms, sky,
             "Of the best controller for the measured response alone.");
    v.number("control_effort", tuning.control_effort, unit::radian_per_second,
             "Rms of the noise-driven valve command.");
    v.group("assumed_fractions",
            "Fractions of the variances that rest on frequencies not measured.", [&] {
              describe_fraction(v, "wind", tuning.wind_fraction, "Of the wind's variance.");
              describe_fraction(v, "noise", tuning.noise_fraction, "Of the noise's.");
              describe_fraction(v, "effort", tuning.effort_fraction, "Of the control effort's.");
            });
    v.number("rms_by_oil_stiffness", tuning.by_stiffness, unit::ratio,
             "d ln rms/d ln K, with fixed gains.");
    v.number("rms_by_oil_loss_rate", tuning.by_loss_rate, unit::ratio,
             "d ln rms/d ln lambda, with fixed gains.");
    v.number("confidence", tuning.confidence, unit::ratio, "Probability at each frequency.");
    v.number("confidence_radius", tuning.radius, unit::ratio, "The same in standard deviations.");
    describe_check(v, controller);
    v.texts("active_constraints", tuning.active_constraints, "What limits the result.");
    v.texts("gains_at_bound", tuning.gains_at_bound, "Gains at a bound of the search.");
    v.count("starts", tuning.starts, "Random starts.");
    v.count("starts_at_optimum", tuning.starts_at_optimum, "Within 1 % of the best.");
    v.count("rounds", tuning.rounds, "How often least favourable responses were taken.");
    v.count("evaluations", tuning.evaluations, "Of the loop.");
  });
}

void describe_bands(io::Visitor& v, std::string_view key,
                    const std::vector<control::PointBand>& bands, std::string_view meaning) {
  v.list(key, bands, meaning, [&](const control::PointBand& band) {
    v.number("lowest", band.lowest, unit::hertz_of_radians, "From.");
    v.number("highest", band.highest, unit::hertz_of_radians, "To.");
  });
}

// What the channels cover.
struct MeasuredRange {
  double lowest = 0.0, highest = 0.0;  // rad/s
  std::size_t frequencies = 0, left_out = 0;
  double resolved = 0.0;
  std::vector<control::PointBand> unresolved, encoder_assumed;
  double inertia = 0.0, friction = 0.0;
};

MeasuredRange range_of(const std::optional<control::MeasuredChannels>& channels) {
  if (!channels) return {};
  return {channels->lowest_frequency(),
          channels->highest_frequency(),
          static_cast<std::size_t>(channels->frequency().size()),
          channels->points_left_out(),
          channels->resolved_fraction(),
          channels->unresolved(),
          channels->encoder_assumed(),
          channels->low_end_inertia(),
          channels->low_end_friction()};
}

void describe_range(io::Visitor& v, const MeasuredRange& range) {
  v.number("lowest", range.lowest, unit::hertz_of_radians, "Lowest usable frequency.");
  v.number("highest", range.highest, unit::hertz_of_radians, "Highest usable frequency.");
  v.count("frequencies", range.frequencies, "Usable ones.");
  v.count("frequencies_left_out", range.left_out, "For their coherence.");
  v.number("resolved_fraction", range.resolved, unit::ratio, "Of the excited band, in ln f.");
  describe_bands(v, "unresolved", range.unresolved,
                 "Between usable frequencies that do not resolve the response.");
  describe_bands(v, "encoder_assumed", range.encoder_assumed,
                 "Where only the encoder's angle is assumed.");
  v.number("inertia", range.inertia, {.suffix = "kg_m2"},
           "Of the whole at the motor shaft, by the lowest frequencies.");
  v.number("friction", range.friction, {.suffix = "N_m_s_per_rad"},
           "Its slope, by the lowest frequencies.");
}

}  // namespace

void describe(io::Visitor& v, const MeasuredTuneSection& section) {
  v.defined_as("measured_tuning",
               "What the command tune found on a measured response (--measured), see "
               "docs/measured-tuning.md.");
  v.text("record", section.record, "Its name.");
  v.number("start", section.start, unit::second, "Of the part used.");
  v.number("length", section.length, unit::second, "Of the part used.");
  v.number("mean_motor_rate", section.mean_rate, unit::radian_per_second,
           "About which everything holds.");
  v.number("lowest_excited", section.lowest_excited, unit::hertz,
           "Where the valve command has power, from.");
  v.number("highest_excited", section.highest_excited, unit::hertz, "To.");
  describe_range(v, range_of(section.channels));
  v.text_or_null("encoder_column", section.encoder_column,
                 "Null: none recorded, the case's structure gives its angle.");
  v.number("oil_stiffness", section.oil.stiffness, {.suffix = "N_m_per_rad"},
           "K, with which wind acts.");
  v.number("oil_loss_rate", section.oil.loss_rate, unit::per_second, "lambda.");
  v.text("oil_source", section.oil_source, "Where both come from.");
  v.number("wind_speed", section.wind_speed, unit::metre_per_second, "Mean.");
  v.numbers("sensitivity_peak_limits", section.goals.sensitivity_peak, unit::ratio,
            "Largest allowed, by loop break.", {.finite = true});
  v.number("control_effort_constraint", section.goals.control_effort, unit::radian_per_second,
           "Largest allowed.");
  v.list(
      "controllers", section.controllers, "A structure each, tuned on the measured response.",
      [&](const MeasuredController& controller) { describe_controller(v, section, controller); });
  v.texts("notes", section.notes, "What is assumed and what is not evaluated.");
}

}  // namespace boresight::app
