#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_comparison.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::io {
namespace {

using identification::FrictionTreatment;
using identification::ResonanceReading;
using identification::WindowRule;
using numerics::Interval;

double percent(double ratio) {
  return 100.0 * (ratio - 1.0);
}

std::string name_of(ResonanceReading kind) {
  switch (kind) {
    case ResonanceReading::spectrum_peak:
      return "spectrum's peak";
    case ResonanceReading::ring_single_mass:
      return "valve steps, K/(2 pi f)^2";
    case ResonanceReading::ring_with_losses:
      return "valve steps, damping-corrected";
    case ResonanceReading::ring_flexible:
      return "valve steps, flexible load";
    case ResonanceReading::ring_shape:
      return "valve steps, no oil data";
    case ResonanceReading::impedance:
      break;
  }
  return "torque over rate";
}

std::string name_of(WindowRule rule, FrictionTreatment treatment) {
  std::string name = "impulse, ";
  switch (rule) {
    case WindowRule::two_on_the_ramp:
      name += "two windows";
      break;
    case WindowRule::every_speed_change:
      name += "all changes";
      break;
    case WindowRule::same_path:
      return name + "friction cancelled";
    case WindowRule::whole_records:
      return name + "whole records, curve";
  }
  switch (treatment) {
    case FrictionTreatment::constant_speed_line:
      return name + ", straight line";
    case FrictionTreatment::slow_ramp_line:
      return name + ", slow ramp";
    case FrictionTreatment::curve:
      return name + ", curve";
    case FrictionTreatment::cancelled:
      break;
  }
  return name + ", cancelled";
}

std::string assumptions_of(const identification::ImpulseEstimate& estimate) {
  switch (estimate.treatment) {
    case FrictionTreatment::constant_speed_line:
      return "friction is the straight line through the constant-speed tests";
    case FrictionTreatment::slow_ramp_line:
      return "friction is the slow ramp's Coulomb level and the constant-speed slope";
    case FrictionTreatment::cancelled:
      return "friction depends on speed and direction alone";
    case FrictionTreatment::curve:
      break;
  }
  return estimate.rule == WindowRule::whole_records
             ? "friction is one curve for all tests; inertia fitted with it"
             : "friction is the curve fitted to all tests";
}

// Empty where the peak is not one of the excitation's lines.
std::string harmonic_lock(const identification::TorqueSpectrum& spectrum, double stiffness) {
  if (!spectrum.chosen || !spectrum.on_harmonic) return {};
  const identification::SpectralPeak& peak = *spectrum.chosen;
  std::string text = fmt::format(
      "Harmonic lock: the peak at {:.3f} Hz is harmonic {} of the {:.3g} s excitation, not the "
      "mode itself. ",
      peak.frequency, peak.harmonic, spectrum.period.value_or(0.0));
  const double spacing = spectrum.harmonic_spacing;
  for (const double next : {peak.frequency - spacing, peak.frequency + spacing}) {
    if (!(next > 0.0)) continue;
    text += fmt::format("The line at {:.3f} Hz would give {:.4g} kg.m2. ", next,
                        plant::inertia_from_resonance(stiffness, next));
  }
  return text;
}

// What in a spectrum's reading is oil data, flexibility, and the rest: harmonic or losses.
std::string why_spectrum(const CampaignSection& section,
                         const identification::ResonanceResult& resonance,
                         const identification::InertiaReading& one, const Case& antenna) {
  const auto inertia = combined(section, "inertia");
  const double frequency = one.frequency ? one.frequency->value : 0.0;
  std::string why;
  for (const auto& spectrum : resonance.spectra) {
    if (spectrum.record == one.record) {
      why = harmonic_lock(spectrum, resonance.conventional_stiffness.value);
    }
  }
  const double flexible = 1.0 / std::pow(resonance.coupled_over_rigid, 2);
  if (inertia && frequency > 0.0) {
    const auto stiffness = combined(section, "oil stiffness");
    const double oil = stiffness ? resonance.conventional_stiffness.value / stiffness->value : 1.0;
    const double all = one.inertia.value / inertia->value;
    why += fmt::format(
        "Of {:+.1f} %, flexibility of the antenna makes {:+.1f} % (it lowers the mode), the oil's "
        "stiffness {:+.1f} %, and reading the mode at {:.3f} Hz instead of {:.3f} Hz {:+.1f} %. ",
        percent(all), percent(flexible), percent(oil), frequency,
        resonance.coupled_over_rigid *
            std::sqrt((stiffness ? stiffness->value : resonance.stiffness.value) / inertia->value) /
            two_pi,
        percent(all / (flexible * oil)));
  }
  const auto& knowledge = section.knowledge;
  const double both = knowledge.torque_efficiency.value * knowledge.volumetric_efficiency.value;
  const bool with = antenna.oil->efficiency_in_stiffness;
  why += fmt::format(
      "Efficiency convention: efficiencies {} the stiffness here; the other way it would read "
      "{:.4g} kg.m2 ({:+.1f} %).",
      with ? "in" : "not in", one.inertia.value * (with ? 1.0 / both : both),
      percent(with ? 1.0 / both : both));
  return why;
}

std::string why_rings(const identification::ResonanceResult& resonance,
                      const identification::InertiaReading& one) {
  const double flexible = 1.0 / std::pow(resonance.coupled_over_rigid, 2);
  const auto of = [&](ResonanceReading kind) -> std::optional<double> {
    for (const auto& other : resonance.readings) {
      if (other.kind == kind && other.record == one.record) return other.inertia.value;
    }
    return std::nullopt;
  };
  const auto single = of(ResonanceReading::ring_single_mass);
  const auto losses = of(ResonanceReading::ring_with_losses);
  const auto bent = of(ResonanceReading::ring_flexible);
  switch (one.kind) {
    case ResonanceReading::ring_single_mass:
      if (single && losses && bent) {
        return fmt::format(
            "Takes the load as rigid and without losses: leakage and friction make {:+.1f} %, the "
            "antenna's flexibility {:+.1f} %.",
            percent(*single / *losses), percent(*losses / *bent));
      }
      break;
    case ResonanceReading::ring_with_losses:
      return fmt::format("Takes the load as rigid: flexibility alone makes {:+.1f} %.",
                         bent ? percent(one.inertia.value / *bent) : percent(flexible));
    case ResonanceReading::ring_flexible:
      return "Rests on the drawings' split of the inertia and on the oil's data.";
    default:
      break;
  }
  return "Takes its scale from pressures and tachometer: their errors are its interval.";
}

InertiaRow mass_row(const CampaignSection& section) {
  const auto& knowledge = section.knowledge;
  const double motors = knowledge.motor_count * knowledge.motor_inertia.value;
  const double side = motors + knowledge.gear_inertia.value;
  InertiaRow row;
  row.name = "mass properties (drawings)";
  row.of_the_paper = true;
  row.inertia = numerics::normal_interval(
      side + knowledge.antenna_inertia.value,
      std::hypot(knowledge.motor_count * knowledge.motor_inertia.standard_uncertainty,
                 knowledge.gear_inertia.standard_uncertainty,
                 knowledge.antenna_inertia.standard_uncertainty));
  row.assumes = "drawings and the structural group's antenna inertia";
  if (const auto inertia = combined(section, "inertia")) {
    row.why = fmt::format(
        "Motors and gears make {:.4g} kg.m2 of it; the combined inertia leaves {:.4g} for the "
        "antenna where the drawings have {:.4g} ({:+.1f} %).",
        side, inertia->value - side, knowledge.antenna_inertia.value,
        percent(knowledge.antenna_inertia.value / (inertia->value - side)));
  }
  return row;
}

void add_resonance(const CampaignSection& section, const Case& antenna,
                   std::vector<InertiaRow>& rows) {
  if (!section.resonance) return;
  const auto& resonance = *section.resonance;
  for (const auto& reading : resonance.readings) {
    InertiaRow row;
    row.name = name_of(reading.kind);
    row.of_the_paper = reading.kind == ResonanceReading::spectrum_peak;
    if (reading.kind == ResonanceReading::spectrum_peak ||
        reading.kind == ResonanceReading::impedance) {
      row.name += fmt::format(" ({})", reading.record);
    }
    row.inertia = reading.inertia;
    row.assumes = reading.assumes;
    row.why = row.of_the_paper ? why_spectrum(section, resonance, reading, antenna)
                               : why_rings(resonance, reading);
    rows.push_back(std::move(row));
  }
}

void add_impulse(const CampaignSection& section, std::vector<InertiaRow>& rows) {
  if (!section.impulse) return;
  for (const auto& estimate : section.impulse->estimates) {
    InertiaRow row;
    row.name = name_of(estimate.rule, estimate.treatment);
    row.of_the_paper = estimate.rule == WindowRule::two_on_the_ramp &&
                       estimate.treatment != FrictionTreatment::curve;
    row.inertia = estimate.inertia;
    row.assumes = assumptions_of(estimate);
    row.why = estimate.note;
    if (!estimate.fractions.empty()) {
      row.why += fmt::format("{}Its interval is mostly {} ({:.0f} %).", row.why.empty() ? "" : " ",
                             estimate.fractions.front().source,
                             100.0 * estimate.fractions.front().fraction);
    }
    rows.push_back(std::move(row));
  }
}

}  // namespace

Interval motor_to_load_ratio(const identification::DriveKnowledge& knowledge,
                             const Interval& inertia) {
  const double motors = knowledge.motor_count * knowledge.motor_inertia.value;
  const double error = knowledge.motor_count * knowledge.motor_inertia.standard_uncertainty;
  const auto ratio = [&](double total) {
    return total > motors ? motors / (total - motors) : std::numeric_limits<double>::infinity();
  };
  // The motors' own uncertainty beside the inertia's, in the load.
  const auto end = [&](double bound) {
    const double half = std::hypot(bound - inertia.value, numerics::normal_975 * error);
    return inertia.value + (bound > inertia.value ? half : -half);
  };
  const double value = ratio(inertia.value);
  const double load = inertia.value - motors;
  const double spread = load > 0.0 ? value * std::hypot(inertia.standard_uncertainty, error) / load
                                   : std::numeric_limits<double>::infinity();
  return {value, spread, ratio(end(inertia.upper)), ratio(end(inertia.lower))};
}

std::vector<InertiaRow> inertia_rows(const CampaignSection& section, const Case& antenna) {
  std::vector<InertiaRow> rows{mass_row(section)};
  add_resonance(section, antenna, rows);
  add_impulse(section, rows);
  for (auto& row : rows) {
    row.motor_to_load_ratio = motor_to_load_ratio(section.knowledge, row.inertia);
    row.difference = difference_from_combined(section, "inertia", row.inertia);
  }
  return rows;
}

}  // namespace boresight::io
