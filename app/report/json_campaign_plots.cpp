#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/report/json_campaign.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::app {
namespace {

using identification::FrictionCurveFit;
using Json = nlohmann::ordered_json;

// No plot shows more than six digits, and a file of these is a third as long.
Json short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

template <typename Numbers>
Json list(const Numbers& numbers) {
  Json json = Json::array();
  for (const double value : numbers) json.push_back(short_number(value));
  return json;
}

Json friction_points(const FrictionCurveFit& fit) {
  // Every so many of a long campaign's windows: a plot is not to be thousands of dots.
  constexpr std::size_t most = 600;
  const std::size_t step = 1 + fit.points.size() / most;
  Json rate = Json::array(), torque = Json::array();
  for (std::size_t i = 0; i < fit.points.size(); i += step) {
    rate.push_back(short_number(fit.points[i].rate));
    torque.push_back(short_number(fit.points[i].friction));
  }
  return {{"rate_rad_per_s", std::move(rate)}, {"torque_N_m", std::move(torque)}};
}

Json friction_plot(const CampaignSection& section) {
  double lowest = 0.0, highest = 0.0;
  const FrictionCurveFit* fit = nullptr;
  if (section.impulse && section.impulse->friction) fit = &*section.impulse->friction;
  if (!section.friction.empty()) {
    lowest = section.friction.front().rate;
    highest = section.friction.back().rate;
  }
  if (fit != nullptr) {
    lowest = lowest > 0.0 ? std::min(lowest, fit->lowest_rate) : fit->lowest_rate;
    highest = std::max(highest, fit->highest_rate);
  }
  if (!(highest > 0.0)) return nullptr;
  lowest = std::clamp(lowest, 1e-4 * highest, 0.5 * highest);
  constexpr int points = 60;
  Json rate = Json::array(), value = Json::array(), lower = Json::array(), upper = Json::array(),
       fitted = Json::array();
  for (int i = 0; i < points; ++i) {
    const double w = lowest * std::pow(highest / lowest, i / (points - 1.0));
    rate.push_back(short_number(w));
    if (section.grey_box) {
      const auto band = identification::friction_interval(*section.grey_box, w);
      value.push_back(short_number(band.value));
      lower.push_back(short_number(band.lower));
      upper.push_back(short_number(band.upper));
    }
    if (fit != nullptr) fitted.push_back(short_number(plant::friction_torque(fit->curve, w)));
  }
  return {{"rate_rad_per_s", std::move(rate)},
          {"reconciled_N_m", std::move(value)},
          {"reconciled_lower_95_N_m", std::move(lower)},
          {"reconciled_upper_95_N_m", std::move(upper)},
          {"curve_as_recorded_N_m", std::move(fitted)},
          {"windows", fit != nullptr ? friction_points(*fit) : Json(nullptr)}};
}

Json spectrum_plot(const identification::TorqueSpectrum& spectrum) {
  double end = 0.0;
  Json peaks = Json::array();
  for (const auto& peak : spectrum.peaks) {
    end = std::max(end, 1.2 * peak.frequency);
    peaks.push_back({{"frequency_Hz", short_number(peak.frequency)},
                     {"amplitude_N_m", short_number(peak.height)},
                     {"over_background_1", short_number(peak.over_background)},
                     {"harmonic", peak.harmonic}});
  }
  Eigen::Index count = 0;
  while (count < spectrum.frequency.size() && (end == 0.0 || spectrum.frequency(count) <= end)) {
    ++count;
  }
  return {{"record", spectrum.record},
          {"period_s", spectrum.period ? short_number(*spectrum.period) : Json(nullptr)},
          {"frequency_Hz", list(spectrum.frequency.head(count))},
          {"amplitude_N_m", list(spectrum.amplitude.head(count))},
          {"peaks", std::move(peaks)},
          {"chosen_Hz", spectrum.chosen ? short_number(spectrum.chosen->frequency) : Json(nullptr)},
          {"chosen_on_harmonic", spectrum.on_harmonic},
          {"notes", spectrum.notes}};
}

Json ringing_plot(const SloshTest& test) {
  Json plots = Json::array();
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const auto& line : test.result.lines) {
    lowest = std::min(lowest, line.frequency.value);
    highest = std::max(highest, line.frequency.value);
  }
  for (const auto& plot : test.result.plots) {
    // The spectrum about the lines.
    Eigen::Index first = 0, count = 0;
    while (first < plot.frequency.size() && plot.frequency(first) < 0.6 * lowest) ++first;
    while (first + count < plot.frequency.size() && plot.frequency(first + count) < 1.4 * highest) {
      ++count;
    }
    plots.push_back({{"motor", plot.motor + 1},
                     {"side", plot.side == identification::LineSide::inlet ? "inlet" : "outlet"},
                     {"start_s", short_number(plot.start)},
                     {"pressure_Pa", list(plot.pressure)},
                     {"fitted_Pa", list(plot.fitted)},
                     {"frequency_Hz", list(plot.frequency.segment(first, count))},
                     {"amplitude_Pa", list(plot.amplitude.segment(first, count))},
                     {"fitted_amplitude_Pa", list(plot.fitted_amplitude.segment(first, count))}});
  }
  return {{"record", test.record}, {"ports", std::move(plots)}};
}

Json rings_plot(const identification::StepRings& rings) {
  Json all = Json::array();
  for (const auto& ring : rings.rings) {
    all.push_back({{"time_s", short_number(ring.time)},
                   {"mean_rate_rad_per_s", short_number(ring.mean_rate)},
                   {"frequency", interval_json(ring.frequency, "Hz")},
                   {"damping_ratio", interval_json(ring.damping_ratio, "1")}});
  }
  Json plot{{"rings", std::move(all)}, {"time_s", list(rings.plot_time)}};
  const bool drawn = rings.plot_signals.cols() == 2 && rings.plot_fitted.cols() == 2;
  plot["torque_N_m"] = drawn ? list(rings.plot_signals.col(0)) : Json::array();
  plot["rate_rad_per_s"] = drawn ? list(rings.plot_signals.col(1)) : Json::array();
  plot["fitted_torque_N_m"] = drawn ? list(rings.plot_fitted.col(0)) : Json::array();
  plot["fitted_rate_rad_per_s"] = drawn ? list(rings.plot_fitted.col(1)) : Json::array();
  return plot;
}

Json response_plot(const identification::DriveResponse& response) {
  return {{"record", response.record},
          {"frequency_Hz", list(response.frequency)},
          {"measured_real_N_m_s_per_rad", list(response.measured.real().eval())},
          {"measured_imaginary_N_m_s_per_rad", list(response.measured.imag().eval())},
          {"fitted_real_N_m_s_per_rad", list(response.fitted.real().eval())},
          {"fitted_imaginary_N_m_s_per_rad", list(response.fitted.imag().eval())}};
}

Json hold_out_plot(const HoldOut& held) {
  const auto& recorded = held.result.recorded;
  const auto& simulated = held.result.simulated;
  return {{"sample_time_s", short_number(recorded.sample_time)},
          {"rate_rad_per_s", list(recorded.rate)},
          {"torque_N_m", list(recorded.torque)},
          {"simulated_rate_rad_per_s", list(simulated.rate)},
          {"simulated_torque_N_m", list(simulated.torque)}};
}

}  // namespace

Json campaign_plots_json(const CampaignSection& section) {
  Json spectra = Json::array(), slosh = Json::array(), responses = Json::array();
  Json rings = nullptr;
  for (const auto& test : section.slosh) slosh.push_back(ringing_plot(test));
  if (section.resonance) {
    for (const auto& spectrum : section.resonance->spectra) {
      spectra.push_back(spectrum_plot(spectrum));
    }
    for (const auto& response : section.resonance->responses) {
      responses.push_back(response_plot(response));
    }
    if (section.resonance->rings) rings = rings_plot(*section.resonance->rings);
  }
  return {{"friction", friction_plot(section)},
          {"torque_spectra", std::move(spectra)},
          {"line_ringing", std::move(slosh)},
          {"step_rings", std::move(rings)},
          {"torque_over_rate", std::move(responses)},
          {"hold_out", section.hold_out ? hold_out_plot(*section.hold_out) : Json(nullptr)}};
}

}  // namespace boresight::app
