#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_description.hpp>
#include <boresight/io/description/interval_results.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

using identification::FrictionCurveFit;

// No plot shows more than six digits, and a file of these is a third as long.
double short_number(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr) : value;
}

template <typename Numbers>
void list(Visitor& v, std::string_view key, const Numbers& numbers, const KeyUnit& of,
          std::string_view meaning) {
  std::vector<double> rounded;
  for (const double value : numbers) rounded.push_back(short_number(value));
  v.numbers(key, rounded, of, meaning);
}

void describe_windows(Visitor& v, const FrictionCurveFit& fit) {
  // Every so many of a long campaign's windows: a plot is not to be thousands of dots.
  constexpr std::size_t maximum = 600;
  const std::size_t step = 1 + fit.points.size() / maximum;
  std::vector<double> rate, torque;
  for (std::size_t i = 0; i < fit.points.size(); i += step) {
    rate.push_back(fit.points[i].rate);
    torque.push_back(fit.points[i].friction);
  }
  list(v, "rate", rate, unit::radian_per_second, "Mean.");
  list(v, "torque", torque, unit::newton_metre, "Mean.");
}

// Rates (rad/s) of the friction plot's curves, the lowest and the highest; none without any.
struct RateRange {
  double lowest = 0.0, highest = 0.0;
};

std::optional<RateRange> friction_rates(const CampaignSection& section) {
  RateRange range;
  if (!section.friction.empty()) {
    range = {section.friction.front().rate, section.friction.back().rate};
  }
  if (section.impulse && section.impulse->friction) {
    const FrictionCurveFit& fit = *section.impulse->friction;
    range.lowest = range.lowest > 0.0 ? std::min(range.lowest, fit.lowest_rate) : fit.lowest_rate;
    range.highest = std::max(range.highest, fit.highest_rate);
  }
  if (!(range.highest > 0.0)) return std::nullopt;
  range.lowest = std::clamp(range.lowest, 1e-4 * range.highest, 0.5 * range.highest);
  return range;
}

void describe_friction(Visitor& v, const CampaignSection& section, const RateRange& range) {
  const auto fit = section.impulse ? section.impulse->friction : std::optional<FrictionCurveFit>();
  constexpr int points = 60;
  std::vector<double> rate, value, lower, upper, fitted;
  for (int i = 0; i < points && !v.by_example(); ++i) {
    const double w = range.lowest * std::pow(range.highest / range.lowest, i / (points - 1.0));
    rate.push_back(w);
    if (section.grey_box) {
      const auto band = identification::friction_interval(*section.grey_box, w);
      value.push_back(band.value);
      lower.push_back(band.lower);
      upper.push_back(band.upper);
    }
    if (fit) fitted.push_back(plant::friction_torque(fit->curve, w));
  }
  list(v, "rate", rate, unit::radian_per_second, "Of the curves.");
  list(v, "combined", value, unit::newton_metre, "Grey box; empty without.");
  list(v, "combined_lower_95", lower, unit::newton_metre, "Its band.");
  list(v, "combined_upper_95", upper, unit::newton_metre, "Its band.");
  list(v, "curve_as_recorded", fitted, unit::newton_metre, "Fitted curve; empty without.");
  v.optional_group("windows", fit, "Friction in windows of the tests, sign of the rate.",
                   [&](const FrictionCurveFit& there) { describe_windows(v, there); });
}

void describe_spectrum(Visitor& v, const identification::TorqueSpectrum& spectrum) {
  double end = 0.0;
  for (const auto& peak : spectrum.peaks) end = std::max(end, 1.2 * peak.frequency);
  Eigen::Index count = 0;
  while (count < spectrum.frequency.size() && (end == 0.0 || spectrum.frequency(count) <= end)) {
    ++count;
  }
  const auto rounded = [](const std::optional<double>& value) {
    return value ? std::optional(short_number(*value)) : std::nullopt;
  };
  v.text("record", spectrum.record, "The record.");
  v.number("period", rounded(spectrum.period), unit::second, "Of the excitation; null: none.");
  list(v, "frequency", spectrum.frequency.head(count), unit::hertz, "Of the amplitudes.");
  list(v, "amplitude", spectrum.amplitude.head(count), unit::newton_metre, "Of a sine there.");
  v.list("peaks", spectrum.peaks, "Peaks.", [&](const auto& peak) {
    v.number("frequency", short_number(peak.frequency), unit::hertz, "Place.");
    v.number("amplitude", short_number(peak.height), unit::newton_metre, "Height.");
    v.number("over_background", short_number(peak.over_background), unit::ratio,
             "Height over the median about it.");
    v.count("harmonic", peak.harmonic, "Of the excitation; 0: none.");
  });
  v.number("chosen",
           spectrum.chosen ? std::optional(short_number(spectrum.chosen->frequency)) : std::nullopt,
           unit::hertz, "Taken for the mode; null: none.");
  v.flag("chosen_on_harmonic", spectrum.on_harmonic, "It is a harmonic of the excitation.");
  v.texts("notes", spectrum.notes, "On it.");
}

void describe_ringing(Visitor& v, const SloshTest& test) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const auto& line : test.result.lines) {
    lowest = std::min(lowest, line.frequency.value);
    highest = std::max(highest, line.frequency.value);
  }
  v.text("record", test.record, "The record.");
  v.list("ports", test.result.plots, "By port.", [&](const auto& plot) {
    // The spectrum about the lines.
    Eigen::Index first = 0, count = 0;
    while (first < plot.frequency.size() && plot.frequency(first) < 0.6 * lowest) ++first;
    while (first + count < plot.frequency.size() && plot.frequency(first + count) < 1.4 * highest) {
      ++count;
    }
    v.count("motor", plot.motor + 1, "From 1.", {.minimum = 1});
    v.word("side", plot.side == identification::LineSide::inlet ? "inlet" : "outlet",
           {"inlet", "outlet"}, "The port.");
    v.number("start", short_number(plot.start), unit::second, "Of the window.");
    list(v, "pressure", plot.pressure, unit::pascal,
         "Less slow part and cross-talk, sampled as the record.");
    list(v, "fitted", plot.fitted, unit::pascal, "The same.");
    list(v, "frequency", plot.frequency.segment(first, count), unit::hertz, "Of the amplitudes.");
    list(v, "amplitude", plot.amplitude.segment(first, count), unit::pascal, "Of the pressure.");
    list(v, "fitted_amplitude", plot.fitted_amplitude.segment(first, count), unit::pascal,
         "Of the fit.");
  });
}

void describe_rings(Visitor& v, const identification::StepRings& rings) {
  v.list("rings", rings.rings, "Those used.", [&](const auto& ring) {
    v.number("time", short_number(ring.time), unit::second, "Of the step.");
    v.number("mean_rate", short_number(ring.mean_rate), unit::radian_per_second, "Of the motor.");
    describe_interval(v, "frequency", ring.frequency, "Hz", "Undamped natural.");
    describe_interval(v, "damping_ratio", ring.damping_ratio, "1", "Of the ring.");
  });
  const bool drawn = rings.plot_signals.cols() == 2 && rings.plot_fitted.cols() == 2;
  const auto column = [&](const auto& signals, Eigen::Index at) {
    return drawn ? Eigen::VectorXd(signals.col(at)) : Eigen::VectorXd();
  };
  list(v, "time", rings.plot_time, unit::second, "Of the first ring's plot.");
  list(v, "torque", column(rings.plot_signals, 0), unit::newton_metre, "Less its trend.");
  list(v, "rate", column(rings.plot_signals, 1), unit::radian_per_second, "Less its trend.");
  list(v, "fitted_torque", column(rings.plot_fitted, 0), unit::newton_metre, "Fit.");
  list(v, "fitted_rate", column(rings.plot_fitted, 1), unit::radian_per_second, "Fit.");
}

void describe_response(Visitor& v, const identification::DriveResponse& response) {
  const KeyUnit of{.suffix = "N_m_s_per_rad"};
  v.text("record", response.record, "The record.");
  list(v, "frequency", response.frequency, unit::hertz, "Of the values.");
  list(v, "measured_real", response.measured.real().eval(), of, "Measured.");
  list(v, "measured_imaginary", response.measured.imag().eval(), of, "Measured.");
  list(v, "fitted_real", response.fitted.real().eval(), of, "Fit.");
  list(v, "fitted_imaginary", response.fitted.imag().eval(), of, "Fit.");
}

void describe_hold_out(Visitor& v, const HoldOut& held) {
  const auto& recorded = held.result.recorded;
  const auto& simulated = held.result.simulated;
  v.number("sample_time", short_number(recorded.sample_time), unit::second, "Of all series.");
  list(v, "rate", recorded.rate, unit::radian_per_second, "Recorded.");
  list(v, "torque", recorded.torque, unit::newton_metre, "Recorded.");
  list(v, "simulated_rate", simulated.rate, unit::radian_per_second, "Simulated.");
  list(v, "simulated_torque", simulated.torque, unit::newton_metre, "Simulated.");
}

}  // namespace

void describe_campaign_plots(Visitor& v, const CampaignSection& section) {
  const identification::ResonanceResult none;
  const auto& resonance = section.resonance ? *section.resonance : none;
  v.defined_as("campaign_plots", "Data of plots, to six digits.");
  v.optional_group("friction", friction_rates(section), "Friction against speed.",
                   [&](const RateRange& range) { describe_friction(v, section, range); });
  v.list("torque_spectra", resonance.spectra, "Of fast and slow ramps.",
         [&](const auto& spectrum) { describe_spectrum(v, spectrum); });
  v.list("line_ringing", section.slosh, "Of slosh tests, the strongest event.",
         [&](const SloshTest& test) { describe_ringing(v, test); });
  v.optional_group("step_rings", resonance.rings, "Rings after valve steps; null without.",
                   [&](const auto& rings) { describe_rings(v, rings); });
  v.list("torque_over_rate", resonance.responses, "Of sweeps and steps.",
         [&](const auto& response) { describe_response(v, response); });
  v.optional_group("hold_out", section.hold_out,
                   "The record held out, recorded and simulated, sampled alike; null without.",
                   [&](const HoldOut& held) { describe_hold_out(v, held); });
}

}  // namespace boresight::io
