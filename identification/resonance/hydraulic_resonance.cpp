#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/resonance/hydraulic_resonance.hpp>
#include <boresight/identification/resonance/ring_inertia.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::identification {
namespace {

double relative(const numerics::Uncertain& number) {
  return number.standard_uncertainty / number.value;
}

double relative(const numerics::Interval& number) {
  return number.standard_uncertainty / number.value;
}

// J = K/(2 pi f)^2 with a frequency known so badly that the interval must not be symmetric.
numerics::Interval single_mass_inertia(const numerics::Interval& stiffness, double frequency,
                                       double uncertainty) {
  const double value = plant::inertia_from_resonance(stiffness.value, frequency);
  const double spread = std::hypot(relative(stiffness), 2.0 * uncertainty / frequency);
  const double factor = std::exp(numerics::normal_975 * spread);
  return {value, value * spread, value / factor, value * factor};
}

void read_spectra(const Campaign& campaign, ResonanceResult& result) {
  TorqueSpectrumOptions options;
  options.expected_frequency = result.expected_frequency;
  for (const TestKind kind : {TestKind::fast_ramp, TestKind::slow_ramp}) {
    for (const auto& record : campaign.records) {
      if (record.test != kind || record.inlet_pressure.empty()) continue;
      const double length = static_cast<double>(record.samples()) * record.sample_time;
      if (length * options.expected_frequency <= 4.0) {
        result.notes.push_back(
            fmt::format("{}: {:.1f} s are too short for a spectrum", record.name, length));
        continue;
      }
      result.spectra.push_back(torque_spectrum(record, campaign.knowledge, options));
      auto& spectrum = result.spectra.back();
      result.notes.insert(result.notes.end(), spectrum.notes.begin(), spectrum.notes.end());
      if (kind != TestKind::fast_ramp || !spectrum.chosen) continue;
      const double f = spectrum.chosen->frequency;
      result.readings.push_back(
          {ResonanceReading::spectrum_peak, record.name,
           "the peak is the mode of a rigid load without losses (the paper's procedure)",
           numerics::normal_interval(f, spectrum.reading_uncertainty),
           single_mass_inertia(result.conventional_stiffness, f, spectrum.reading_uncertainty)});
      if (!spectrum.on_harmonic) continue;
      const auto at = [&](double frequency) {
        return plant::inertia_from_resonance(result.conventional_stiffness.value, frequency);
      };
      const double spacing = spectrum.harmonic_spacing;
      result.notes.push_back(fmt::format(
          "{}: J = K/(2 pi f)^2 at that harmonic is {:.4g} kg m2; the excitation's next lines, at "
          "{:.3f} and {:.3f} Hz, would give {:.4g} and {:.4g}: the procedure can return no value "
          "between",
          record.name, at(f), f - spacing, f + spacing, at(f - spacing), at(f + spacing)));
    }
  }
}

double place_of(const TorqueSpectrum& spectrum) {
  return spectrum.chosen.value_or(SpectralPeak{}).frequency;
}

// The paper's two drive conditions.
void compare_conditions(const Campaign& campaign, ResonanceResult& result) {
  const TorqueSpectrum* fast = nullptr;
  const TorqueSpectrum* slow = nullptr;
  for (const auto& spectrum : result.spectra) {
    for (const auto& record : campaign.records) {
      if (record.name != spectrum.record || !spectrum.chosen) continue;
      if (record.test == TestKind::fast_ramp && fast == nullptr) fast = &spectrum;
      if (record.test == TestKind::slow_ramp && slow == nullptr) slow = &spectrum;
    }
  }
  if (fast == nullptr) return;
  if (slow == nullptr) {
    result.notes.push_back(fmt::format(
        "two drive conditions: {} has its peak at {:.3f} Hz, no slow ramp has one to compare it "
        "with",
        fast->record, place_of(*fast)));
    return;
  }
  const double a = place_of(*fast), b = place_of(*slow);
  result.notes.push_back(fmt::format(
      "two drive conditions: {} has its peak at {:.3f} Hz, {} at {:.3f} Hz, {:.0f} % apart: {}",
      fast->record, a, slow->record, b, 100.0 * std::abs(a - b) / b,
      std::abs(a - b) < 0.08 * b ? "the same mode, unless both lie on harmonics"
                                 : "not the same; one or both are not the hydraulic mode"));
}

void read_rings(const Campaign& campaign, const ResonanceOptions& options,
                ResonanceResult& result) {
  for (const auto& record : campaign.records) {
    if (record.test != TestKind::valve_steps || record.inlet_pressure.empty() || result.rings) {
      continue;
    }
    StepRingOptions ring;
    ring.expected_frequency = result.expected_frequency;
    try {
      result.rings = fit_step_rings(record, campaign, result.stiffness.value, ring);
    } catch (const NumericalFailure& failure) {
      result.notes.emplace_back(failure.what());
      continue;
    }
    const auto& rings = *result.rings;
    if (!rings.notes.empty()) {
      result.notes.push_back(
          fmt::format("{}: {} of {} steps are left out; first: {}", record.name, rings.notes.size(),
                      rings.notes.size() + rings.rings.size(), rings.notes.front()));
    }
    result.frequency = rings.frequency;
    result.damping_ratio = rings.damping_ratio;
    struct Reading {
      ResonanceReading kind;
      const char* assumes;
    };
    const std::array<Reading, 4> kinds{
        {{ResonanceReading::ring_single_mass, "rigid load without losses, J = K/(2 pi f)^2"},
         {ResonanceReading::ring_with_losses,
          "rigid load; leakage and friction slope from the ring's damping and shape"},
         {ResonanceReading::ring_flexible,
          "motors and gears by drawings, the rest on the structure's locked-rotor modes"},
         {ResonanceReading::ring_shape,
          "as before, but torque over rate measured: no oil data, the torque's scale instead"}}};
    for (const auto& reading : kinds) {
      result.readings.push_back(
          {reading.kind, record.name, reading.assumes, rings.frequency,
           ring_inertia(reading.kind, rings.rings, result.stiffness, record, campaign, options)});
    }
    if (options.friction_slope) {
      result.leakage_from_damping =
          leakage_from_damping(rings.rings, result.stiffness, campaign.knowledge, options);
    }
  }
}

void read_responses(const Campaign& campaign, ResonanceResult& result) {
  for (const TestKind kind : {TestKind::valve_chirp, TestKind::valve_steps}) {
    for (const auto& record : campaign.records) {
      if (record.test != kind || record.inlet_pressure.empty() || record.outlet_pressure.empty()) {
        continue;
      }
      try {
        result.responses.push_back(drive_response(record, campaign));
      } catch (const NumericalFailure& failure) {
        result.notes.emplace_back(failure.what());
        continue;
      }
      result.readings.push_back({ResonanceReading::impedance, record.name,
                                 "torque and rate at one shaft, structure's modes fitted; no oil, "
                                 "valve or friction model",
                                 std::nullopt, result.responses.back().impedance.inertia});
    }
  }
}

template <typename Candidates>
std::optional<numerics::Interval> narrowest(const Candidates& candidates) {
  std::optional<numerics::Interval> best;
  for (const auto& candidate : candidates) {
    if (!best || candidate.standard_uncertainty < best->standard_uncertainty) best = candidate;
  }
  return best;
}

void choose(const Campaign& campaign, ResonanceResult& result) {
  for (const auto& reading : result.readings) {
    const bool simple = reading.kind == ResonanceReading::ring_single_mass ||
                        reading.kind == ResonanceReading::ring_with_losses;
    const bool last_resort = reading.kind == ResonanceReading::spectrum_peak;
    if (simple) continue;
    if (!result.best || (result.best->kind == ResonanceReading::spectrum_peak && !last_resort) ||
        reading.inertia.standard_uncertainty < result.best->inertia.standard_uncertainty) {
      result.best = reading;
    }
  }
  std::vector<numerics::Interval> leakages, stiffnesses;
  for (const auto& response : result.responses) {
    result.notes.insert(result.notes.end(), response.notes.begin(), response.notes.end());
    if (!result.frequency && response.hydraulic_frequency) {
      result.frequency = response.hydraulic_frequency;
      result.damping_ratio = response.hydraulic_damping_ratio;
    }
    if (!response.oil) continue;
    leakages.push_back(response.oil->leakage_rate);
    stiffnesses.push_back(response.oil->stiffness);
  }
  if (result.rings) {
    stiffnesses.push_back(result.rings->stiffness);
    if (leakages.empty()) leakages.push_back(result.rings->leakage_rate);
  }
  result.leakage_rate = narrowest(leakages);
  result.stiffness_from_motion = narrowest(stiffnesses);
  if (!result.best) return;
  const auto& knowledge = campaign.knowledge;
  const double motors = knowledge.motor_count * knowledge.motor_inertia.value;
  const auto ratio = [&](double inertia) {
    return inertia > motors ? motors / (inertia - motors) : std::numeric_limits<double>::infinity();
  };
  const numerics::Interval& inertia = result.best->inertia;
  const double load = std::max(inertia.value - motors, 1e-3 * motors);
  result.motor_to_load_ratio = numerics::Interval{
      ratio(inertia.value), ratio(inertia.value) * inertia.standard_uncertainty / load,
      ratio(inertia.upper), ratio(inertia.lower)};
}

// The flexible drive's lowest mode over the rigid one's: K = w^2 (Jm + (J - Jm) A(j w)).
double coupled_over_rigid(const DriveKnowledge& knowledge, double stiffness, double inertia,
                          double fraction) {
  const auto& locked = knowledge.locked_rotor_frequencies;
  const double motor_side =
      knowledge.motor_count * knowledge.motor_inertia.value + knowledge.gear_inertia.value;
  const double rigid = std::sqrt(stiffness / inertia);
  if (locked.empty() || inertia <= motor_side) return 1.0;
  double low = 0.0, high = std::min(rigid, 0.999 * two_pi * locked.front().value);
  for (int round = 0; round < 60; ++round) {
    const double w = 0.5 * (low + high);
    const double dynamic =
        motor_side +
        (inertia - motor_side) * flexible_amplification({0.0, w}, locked, fraction).real();
    (w * w * dynamic < stiffness ? low : high) = w;
  }
  return low / rigid;
}

void explain(const Campaign& campaign, const ResonanceOptions& options, ResonanceResult& result) {
  const auto& knowledge = campaign.knowledge;
  auto& notes = result.notes;
  if (!result.best) {
    notes.emplace_back("no record shows the hydraulic mode: method 2 gives no inertia");
    return;
  }
  const double inertia = result.best->inertia.value;
  result.coupled_over_rigid = coupled_over_rigid(knowledge, result.stiffness.value, inertia,
                                                 options.lowest_mode_fraction.value);
  if (knowledge.locked_rotor_frequencies.empty()) {
    notes.emplace_back(
        "no locked-rotor frequency is given: the structure counts as rigid, and an inertia from "
        "the resonance reads high by what it swings");
  } else if (result.coupled_over_rigid < 1.0) {
    notes.push_back(fmt::format(
        "the structure's lowest mode on a locked rotor is {:.2f} Hz: it makes the hydraulic mode "
        "{:.1f} % lower than a rigid load's ({:.3f} against {:.3f} Hz), and J = K/(2 pi f)^2 reads "
        "{:.1f} % high",
        knowledge.locked_rotor_frequencies.front().value, 100.0 * (1.0 - result.coupled_over_rigid),
        result.coupled_over_rigid * plant::hydraulic_frequency(result.stiffness.value, inertia),
        plant::hydraulic_frequency(result.stiffness.value, inertia),
        100.0 * (1.0 / std::pow(result.coupled_over_rigid, 2) - 1.0)));
  }
  if (!result.rings && result.responses.empty()) {
    notes.emplace_back(
        "damping, leakage and the inertia's split between motor and structure are not identifiable "
        "from the records given: none shows the mode ringing about a moving operating point. Small "
        "valve steps or a valve sweep, the drive moving one way, would show all of them");
  } else if (std::none_of(
                 result.responses.begin(), result.responses.end(),
                 [](const DriveResponse& response) { return !response.impedance.modes.empty(); })) {
    notes.emplace_back(
        "no record shows the structure's modes in torque over rate: the split of the inertia "
        "between motor side and structure is the drawings', not a measurement");
  }
  if (result.rings) {
    const auto of = [&](ResonanceReading kind) {
      const auto found =
          std::find_if(result.readings.begin(), result.readings.end(),
                       [kind](const InertiaReading& reading) { return reading.kind == kind; });
      return found->inertia.value;
    };
    const double single = of(ResonanceReading::ring_single_mass);
    const double losses = of(ResonanceReading::ring_with_losses);
    const double flexible = of(ResonanceReading::ring_flexible);
    notes.push_back(
        fmt::format("rings after {} valve steps: {:.4f} Hz, damping ratio {:.3f}; J = K/(2 pi f)^2 "
                    "is {:.4g} kg m2, with leakage and friction taken out {:.4g} ({:+.1f} %), with "
                    "the structure's flexibility {:.4g} ({:+.1f} %)",
                    result.rings->rings.size(), result.rings->frequency.value,
                    result.rings->damping_ratio.value, single, losses,
                    100.0 * (losses / single - 1.0), flexible, 100.0 * (flexible / losses - 1.0)));
  }
  if (result.stiffness_from_motion) {
    const auto& motion = *result.stiffness_from_motion;
    const double apart = motion.value - result.stiffness.value;
    const double expected =
        std::hypot(motion.standard_uncertainty, result.stiffness.standard_uncertainty);
    notes.push_back(fmt::format(
        "stiffness from oil data {:.4g} N m/rad, from motion alone {:.4g} ({:+.1f} %, {:.1f} "
        "standard uncertainties{}",
        result.stiffness.value, motion.value, 100.0 * apart / result.stiffness.value,
        std::abs(apart) / expected,
        std::abs(apart) > 3.0 * expected
            ? "): they contradict each other; volumes, efficiencies, units or a pressure channel"
            : ")"));
  }
}

}  // namespace

std::complex<double> flexible_amplification(
    std::complex<double> s, const std::vector<numerics::Uncertain>& locked_rotor_frequencies,
    double lowest_mode_fraction) {
  const auto& locked = locked_rotor_frequencies;
  if (locked.empty()) return 1.0;
  const auto factor = [&s](double frequency) {
    const std::complex<double> x = s / (two_pi * frequency);
    return 1.0 / (1.0 + x * x);
  };
  const std::complex<double> rest = locked.size() > 1 ? factor(locked[1].value) : 1.0;
  return lowest_mode_fraction * factor(locked.front().value) + (1.0 - lowest_mode_fraction) * rest;
}

numerics::Interval oil_stiffness(const DriveKnowledge& knowledge,
                                 const numerics::Interval& bulk_modulus) {
  plant::HydraulicDrive drive;
  drive.motor_count = knowledge.motor_count;
  drive.displacement = knowledge.displacement.value;
  drive.torque_efficiency = knowledge.torque_efficiency.value;
  drive.volumetric_efficiency = knowledge.volumetric_efficiency.value;
  drive.bulk_modulus = bulk_modulus.value;
  drive.volume_1 = knowledge.volume_1.value;
  drive.volume_2 = knowledge.volume_2.value;
  drive.efficiency_in_stiffness = knowledge.efficiency_in_stiffness;
  const double value = plant::oil_stiffness(drive);
  const double v1 = drive.volume_1, v2 = drive.volume_2;
  double square = std::pow(relative(bulk_modulus), 2) +
                  std::pow(2.0 * relative(knowledge.displacement), 2) +
                  std::pow(v2 / (v1 + v2) * relative(knowledge.volume_1), 2) +
                  std::pow(v1 / (v1 + v2) * relative(knowledge.volume_2), 2);
  if (knowledge.efficiency_in_stiffness == plant::EfficiencyInStiffness::both) {
    square += std::pow(relative(knowledge.torque_efficiency), 2) +
              std::pow(relative(knowledge.volumetric_efficiency), 2);
  }
  return numerics::normal_interval(value, value * std::sqrt(square));
}

numerics::Interval oil_stiffness_in_motion(const DriveKnowledge& knowledge,
                                           const numerics::Interval& bulk_modulus) {
  DriveKnowledge with = knowledge;
  with.efficiency_in_stiffness = plant::EfficiencyInStiffness::both;
  return oil_stiffness(with, bulk_modulus);
}

ResonanceResult identify_resonance(const Campaign& campaign, const numerics::Interval& bulk_modulus,
                                   const ResonanceOptions& options) {
  const auto& knowledge = campaign.knowledge;
  const double drawings = knowledge.motor_count * knowledge.motor_inertia.value +
                          knowledge.gear_inertia.value + knowledge.antenna_inertia.value;
  if (!(drawings > 0.0) || !std::isfinite(drawings)) {
    throw InvalidInput(fmt::format(
        "identify_resonance: expected motor, gear and antenna inertias above 0 to say where to "
        "look, found {} kg m2 in all",
        drawings));
  }
  ResonanceResult result;
  result.stiffness = oil_stiffness_in_motion(knowledge, bulk_modulus);
  result.conventional_stiffness = oil_stiffness(knowledge, bulk_modulus);
  result.expected_frequency = plant::hydraulic_frequency(result.stiffness.value, drawings);
  read_spectra(campaign, result);
  compare_conditions(campaign, result);
  read_rings(campaign, options, result);
  read_responses(campaign, result);
  choose(campaign, result);
  explain(campaign, options, result);
  return result;
}

}  // namespace boresight::identification
