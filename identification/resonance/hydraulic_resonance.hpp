#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/resonance/drive_response.hpp>
#include <boresight/identification/resonance/hydraulic_ring.hpp>
#include <boresight/identification/resonance/torque_spectrum.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// The oil spring at the motor shaft from a bulk modulus and the drive's data: plant::oil_stiffness
/// with first-order uncertainties of both efficiencies (if they enter), displacement (squared) and
/// volumes. By the knowledge's convention about efficiencies in it. @throws as
/// plant::oil_stiffness.
numerics::Interval oil_stiffness(const DriveKnowledge& knowledge,
                                 const numerics::Interval& bulk_modulus);

/// The same with both efficiencies in it whatever the convention: the spring that recorded torque
/// has against recorded rate, dT/dt = K (q - w), since torque counts with the torque efficiency and
/// flow with the volumetric one.
numerics::Interval oil_stiffness_in_motion(const DriveKnowledge& knowledge,
                                           const numerics::Interval& bulk_modulus);

/// How a reflected inertia follows from the hydraulic mode.
enum class ResonanceReading {
  spectrum_peak,     // the paper's: J = K/(2 pi f)^2 at the peak of a ramp's torque spectrum
  ring_single_mass,  // the same formula at the frequency of rings after valve steps
  ring_with_losses,  // rigid load, leakage and friction taken out of the frequency
  ring_flexible,     // and the load's part that swings on the structure's spring
  ring_shape,        // as before, with torque over rate of the mode in the place of K
  impedance          // torque over rate over a band of frequencies: DriveResponse
};

struct InertiaReading {
  ResonanceReading kind = ResonanceReading::spectrum_peak;
  std::string record;
  std::string assumes;
  std::optional<numerics::Interval> frequency;  // Hz, that it rests on
  numerics::Interval inertia;                   // kg m2
};

struct ResonanceOptions {
  /// Share of the load's inertia behind the structure that swings with its lowest mode; the rest
  /// with the second. Where no record shows it.
  numerics::Uncertain lowest_mode_share{0.85, 0.09};
  /// Slope of friction at the speed of the valve steps, N m s/rad, if another test gave it: then
  /// leakage also follows from the rings' damping alone.
  std::optional<numerics::Uncertain> friction_slope;
};

/// Everything that method 2 makes of a campaign after the bulk modulus.
struct ResonanceResult {
  /// N m/rad, oil data: what motion shows, both efficiencies in it, for all but the paper's
  /// reading.
  numerics::Interval stiffness;
  /// By the case's convention about efficiencies: the paper's J = K/(2 pi f)^2 at a spectrum's
  /// peak.
  numerics::Interval conventional_stiffness;
  double expected_frequency = 0.0;      // Hz, rigid, drawings' inertia on that stiffness
  std::vector<TorqueSpectrum> spectra;  // fast ramps, then slow ramps
  std::optional<StepRings> rings;
  std::vector<DriveResponse> responses;  // chirps, then steps
  std::vector<InertiaReading> readings;  // by kind
  /// Of the mode about a moving operating point, structure and losses in it.
  std::optional<numerics::Interval> frequency;  // Hz
  std::optional<numerics::Interval> damping_ratio;
  /// The reading with the smallest uncertainty of those that a flexible, lossy drive does not
  /// contradict; the spectrum's peak where there is no other.
  std::optional<InertiaReading> best;
  /// All motors over everything else (paper, eq. 27) with `best`; upper end infinity where the
  /// interval reaches the motors' own inertia.
  std::optional<numerics::Interval> motor_to_load_ratio;
  std::optional<numerics::Interval> leakage_rate;  // 1/s
  std::optional<numerics::Interval> leakage_from_damping;
  /// Stiffness from motion alone: torque and rate, no oil data. N m/rad
  std::optional<numerics::Interval> stiffness_from_motion;
  /// Lowest mode of the flexible drive over that of the same drive with a rigid structure,
  /// undamped; below 1. J = K/(2 pi f)^2 reads high by its inverse square.
  double coupled_over_rigid = 1.0;
  std::vector<std::string> notes;
};

/// Hydraulic resonance and what it says of inertia, stiffness and leakage (Sommerville section III;
/// physics section 1), by every reading that the campaign's records allow: spectra of fast and slow
/// ramps, rings after valve steps, response to a valve chirp. Says in words which of them are
/// harmonics of the excitation, what flexibility and losses do to the simple formula, and what the
/// tests given cannot tell.
/// @throws InvalidInput for knowledge without positive inertias, displacement, volumes.
ResonanceResult identify_resonance(const Campaign& campaign, const numerics::Interval& bulk_modulus,
                                   const ResonanceOptions& options = {});

/// Share of the load's dynamic inertia at complex frequency s (1/s) over its static one, for masses
/// on undamped springs: sum of share_k/(1 + (s/w_k)^2).
std::complex<double> flexible_amplification(
    std::complex<double> s, const std::vector<numerics::Uncertain>& locked_rotor_frequencies,
    double lowest_mode_share);

}  // namespace boresight::identification
