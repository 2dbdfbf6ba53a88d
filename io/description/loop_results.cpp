#include <optional>
#include <vector>

#include <boresight/io/description/loop_results.hpp>

namespace boresight::io {

namespace unit = key_units;

namespace {

// What the loop must keep, cut at one place.
struct BreakGoals {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  double sensitivity_peak = 0.0;
  std::optional<double> gain_margin, phase_margin;
};

}  // namespace

void describe_break(Visitor& v, std::string_view key, control::LoopBreak loop_break) {
  using enum control::LoopBreak;
  v.word(key, to_string(loop_break),
         {to_string(rate_loop_alone), to_string(valve_command), to_string(position_loop)},
         "Where the loop is cut.");
}

void describe_breaks(Visitor& v, const design::Constraints& goals) {
  std::vector<BreakGoals> breaks;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    breaks.push_back({control::loop_breaks.at(b), goals.sensitivity_peak.at(b),
                      goals.gain_margin.at(b), goals.phase_margin.at(b)});
  }
  v.list("loop_breaks", breaks, "Goals of the loop cut at each of three places.",
         [&](const BreakGoals& one) {
           describe_break(v, "loop_break", one.loop_break);
           v.number("sensitivity_peak", one.sensitivity_peak, unit::ratio,
                    "Largest sensitivity allowed.", {.above = 0.0, .finite = true});
           v.number("gain_margin", one.gain_margin, unit::decibel,
                    "Least, up and down; null: none asked for.");
           v.number("phase_margin", one.phase_margin, unit::degree, "Least; null: none asked for.");
         },
         {.minimum = control::loop_breaks.size(), .maximum = control::loop_breaks.size()});
}

void describe(Visitor& v, const control::Margins& margins) {
  v.number("increasing_gain_margin", margins.increasing_gain_margin, unit::decibel,
           "Smallest rise of the gain that makes the loop unstable, if any does.",
           {.column = {"gain up dB", 1}});
  v.number("decreasing_gain_margin", margins.decreasing_gain_margin, unit::decibel,
           "Largest fall of the gain that makes the loop unstable, if any does.",
           {.column = {"gain down dB", 1}});
  v.number("modulus_margin", margins.distance_to_minus_one(), unit::ratio,
           "Smallest |1 + L|, the loop's distance from -1: the inverse of the largest |S|.",
           {.minimum = 0.0, .column = {"modulus", 3}});
  v.number("phase_margin", margins.phase_margin_deg, unit::degree_as_kept,
           "Smallest over the gain crossovers; 180 without any.", {.column = {"phase deg", 1}});
  v.number("delay_margin", margins.delay_margin, unit::second,
           "Smallest extra dead time that makes the loop unstable, if any does.",
           {.minimum = 0.0, .column = {"delay ms", 1, 1e3}});
}

void describe_sensitivity(Visitor& v, const control::Margins& margins) {
  v.number("sensitivity_peak", margins.sensitivity.magnitude, unit::ratio,
           "Largest |S|, S = 1/(1 + L).", {.minimum = 0.0});
  v.number("sensitivity_peak_frequency", margins.sensitivity.frequency, unit::hertz_of_radians,
           "Where |S| is largest.", {.minimum = 0.0});
}

void describe_status(Visitor& v, design::RunStatus status, std::string_view meaning) {
  v.word("status", to_string(status), {"complete", "interrupted", "lost", "failed"}, meaning);
}

void describe(Visitor& v, const design::LimitCycleResult& result, LimitCycleDetail detail) {
  const bool counted = detail != LimitCycleDetail::score;
  const bool full = detail == LimitCycleDetail::full;
  v.number("rate", result.rate, unit::millidegree_per_second, "Steady, at the sky.",
           {.finite = true});
  describe_status(v, result.status);
  if (full)
    v.text_or_null("message", result.message, "Why there are no figures; null if complete.");
  v.flag("limit_cycle", result.limit_cycle,
         "In one run at least an oscillation lasts, above the resolution of the encoder.");
  if (counted) {
    v.count("starts", result.starts,
            "Runs, each moved by another step at its start; the figures are of the worst.",
            {.minimum = 1});
    v.count("starts_with_limit_cycle", result.starts_with_limit_cycle, "Runs with a limit cycle.");
    v.number("encoder_amplitude", result.encoder_amplitude, unit::millidegree,
             "Half of peak to peak.", {.minimum = 0.0});
  }
  v.number("boresight_amplitude", result.boresight_amplitude, unit::millidegree,
           "Half of peak to peak.", {.minimum = 0.0});
  v.number("frequency", result.frequency, unit::hertz, "Null with less than two periods seen.",
           {.minimum = 0.0});
  if (full) {
    v.number("valve_command_rms", result.valve_command_rms, unit::radian_per_second,
             "About its mean, at the end of the run.", {.minimum = 0.0});
    v.number("persistence", result.persistence, unit::ratio, "Amplitude over that before.",
             {.minimum = 0.0});
  }
}

}  // namespace boresight::io
