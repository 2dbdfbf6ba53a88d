#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/identification/resonance/torque_spectrum.hpp>
#include <boresight/identification/signals/spectrum.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct AmplitudeSpectrum {
  VectorXd frequency, amplitude;
};

AmplitudeSpectrum amplitude_spectrum(const VectorXd& signal, double sample_time) {
  const Index samples = signal.size();
  const VectorXd window = window_samples(SpectralWindow::hann, samples);
  const Index padded = numerics::fast_transform_length(4 * samples);
  VectorXd longer = VectorXd::Zero(padded);
  longer.head(samples) = (signal.array() - signal.mean()).matrix().cwiseProduct(window);
  AmplitudeSpectrum result;
  result.amplitude = numerics::fourier_transform(longer).cwiseAbs() * (2.0 / window.sum());
  const auto last = static_cast<double>(result.amplitude.size() - 1);
  result.frequency = VectorXd::LinSpaced(result.amplitude.size(), 0.0,
                                         last / (static_cast<double>(padded) * sample_time));
  return result;
}

// The period that the first harmonics' places agree on: what a record holds before the first and
// after the last period pulls the autocorrelation's maximum by some tenths of a percent.
double refined_period(const VectorXd& signal, double sample_time, double period) {
  const auto spectrum = amplitude_spectrum(signal, sample_time);
  PeakOptions options;
  options.lowest = 0.5 / period;
  options.highest = std::min(25.5 / period, 0.4 / sample_time);
  options.background_bins = 16;
  double numbers = 0.0, places = 0.0;
  for (const auto& peak : spectral_peaks(spectrum.frequency, spectrum.amplitude, options)) {
    const double number = std::round(peak.frequency * period);
    if (std::abs(peak.frequency * period - number) > 0.25) continue;
    const double weight = peak.height * peak.height;
    numbers += weight * number * number;
    places += weight * number * peak.frequency;
  }
  return places > 0.0 ? numbers / places : period;
}

std::optional<double> excitation_period(const DriveRecord& record, const VectorXd& torque) {
  const auto period_of = [&](const VectorXd& signal) {
    auto period = repetition_period(signal, record.sample_time);
    if (period) period = refined_period(signal, record.sample_time, *period);
    return period;
  };
  for (const auto* command : {&record.rate_command, &record.valve_command}) {
    // A command that is only noise about 0 does not repeat itself.
    if (!command->has_value()) continue;
    if (const auto period = period_of((*command)->values)) return period;
  }
  return period_of(torque);
}

std::optional<double> structural_neighbour(double frequency, const DriveKnowledge& knowledge,
                                           double tolerance) {
  for (const auto& mode : knowledge.locked_rotor_frequencies) {
    if (std::abs(frequency / mode.value - 1.0) < tolerance) return mode.value;
  }
  return std::nullopt;
}

double amplitude_near(const TorqueSpectrum& spectrum, double frequency) {
  const double bin = spectrum.frequency(1);
  const auto reach = static_cast<Index>(std::ceil(0.5 * spectrum.resolution / bin));
  const Index from =
      std::clamp<Index>(std::llround(frequency / bin) - reach, 0, spectrum.amplitude.size() - 1);
  const Index count = std::min<Index>(2 * reach + 1, spectrum.amplitude.size() - from);
  return spectrum.amplitude.segment(from, count).maxCoeff();
}

// Even harmonics count when they are at least a third of their odd neighbours.
double spacing_about(const TorqueSpectrum& spectrum, double period, int harmonic) {
  double odd = 0.0, even = 0.0;
  for (int number = std::max(1, harmonic - 3); number <= harmonic + 3; ++number) {
    double& own = number % 2 == 0 ? even : odd;
    own = std::max(own, amplitude_near(spectrum, static_cast<double>(number) / period));
  }
  return (even > 0.33 * odd && odd > 0.33 * even ? 1.0 : 2.0) / period;
}

}  // namespace

TorqueSpectrum torque_spectrum(const DriveRecord& record, const DriveKnowledge& knowledge,
                               const TorqueSpectrumOptions& options) {
  const double expected = options.expected_frequency;
  const Index samples = record.samples();
  const double length = static_cast<double>(samples) * record.sample_time;
  if (!(expected > 0.0) || !(length * expected > 4.0)) {
    throw InvalidInput(fmt::format(
        "torque_spectrum: expected a positive frequency to look about and a record of at least "
        "four of its periods, found {} Hz and {:.3g} s in '{}'",
        expected, length, record.name));
  }
  TorqueSpectrum result;
  result.record = record.name;
  const VectorXd torque = recorded_torque(record, knowledge);
  result.period = excitation_period(record, torque);

  auto spectrum = amplitude_spectrum(torque, record.sample_time);
  result.frequency = std::move(spectrum.frequency);
  result.amplitude = std::move(spectrum.amplitude);
  result.resolution = 2.0 / length;

  PeakOptions peaks;
  peaks.lowest = 0.25 * expected;
  peaks.highest = 4.0 * expected;
  if (!knowledge.locked_rotor_frequencies.empty()) {
    peaks.highest = std::max(peaks.highest, knowledge.locked_rotor_frequencies.back().value);
  }
  peaks.highest = std::min(peaks.highest, 0.35 / record.sample_time);
  peaks.min_over_background = 1.5;
  // The background over some three resolutions: what is between the harmonics.
  peaks.background_bins = 16;
  result.peaks = spectral_peaks(result.frequency, result.amplitude, peaks);
  const auto weight = [](const SpectralPeak& peak) { return peak.height * peak.frequency; };
  std::stable_sort(
      result.peaks.begin(), result.peaks.end(),
      [&](const SpectralPeak& a, const SpectralPeak& b) { return weight(a) > weight(b); });
  result.harmonics_resolved = result.period && result.resolution < 0.6 / *result.period;
  if (result.period && result.harmonics_resolved) {
    label_harmonics(result.peaks, *result.period, 0.35 * result.resolution);
  } else if (result.period) {
    result.notes.push_back(
        fmt::format("{}: {:.1f} periods of {:.2f} s do not resolve the excitation's harmonics, "
                    "{:.4f} Hz apart: "
                    "a peak may be one",
                    record.name, length / *result.period, *result.period, 1.0 / *result.period));
  } else {
    result.notes.push_back(fmt::format(
        "{}: neither a command nor the torque repeats itself: harmonics of the excitation cannot "
        "be told from resonances",
        record.name));
  }
  for (const auto& peak : result.peaks) {
    if (peak.frequency < options.lowest_fraction * expected ||
        peak.frequency > options.highest_fraction * expected || peak.over_background < 3.0) {
      continue;
    }
    if (const auto mode =
            structural_neighbour(peak.frequency, knowledge, options.structural_tolerance)) {
      result.notes.push_back(fmt::format(
          "{}: the peak at {:.3f} Hz is left out: the structure has a mode at {:.3f} Hz",
          record.name, peak.frequency, *mode));
      continue;
    }
    result.chosen = peak;
    break;
  }
  if (!result.chosen) {
    result.notes.push_back(fmt::format(
        "{}: no peak of the torque stands out between {:.2f} and {:.2f} Hz", record.name,
        options.lowest_fraction * expected, options.highest_fraction * expected));
    return result;
  }
  const auto& peak = *result.chosen;
  result.on_harmonic = peak.harmonic > 0;
  result.reading_uncertainty = result.resolution / 6.0;
  if (!result.period || !result.on_harmonic) return result;
  result.harmonic_spacing = spacing_about(result, *result.period, peak.harmonic);
  result.envelope_lowest = result.envelope_highest = peak.frequency;
  for (const auto& other : result.peaks) {
    if (other.harmonic == 0 || weight(other) < 0.6 * weight(peak)) continue;
    result.envelope_lowest = std::min(result.envelope_lowest, other.frequency);
    result.envelope_highest = std::max(result.envelope_highest, other.frequency);
  }
  result.reading_uncertainty =
      (0.5 * (result.envelope_highest - result.envelope_lowest) + result.harmonic_spacing) /
      std::numbers::sqrt3;
  result.notes.push_back(fmt::format(
      "{}: the peak at {:.3f} Hz is harmonic {} of the {:.2f} s excitation ({:.4f} Hz from it): it "
      "shows where the excitation is, not a resonance. The excitation has lines every {:.3f} Hz "
      "there, those from {:.2f} to {:.2f} Hz about as strong: the mode is known to {:.2f} Hz (1 "
      "sigma, {:.0f} %) and an inertia from it to {:.0f} %",
      record.name, peak.frequency, peak.harmonic, *result.period, peak.from_harmonic,
      result.harmonic_spacing, result.envelope_lowest, result.envelope_highest,
      result.reading_uncertainty, 100.0 * result.reading_uncertainty / peak.frequency,
      200.0 * result.reading_uncertainty / peak.frequency));
  return result;
}

}  // namespace boresight::identification
