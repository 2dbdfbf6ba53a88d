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

/// Methods to compute a reflected inertia from the hydraulic mode.
enum class ResonanceReading {
  spectrum_peak,     // the paper's: J = K/(2 pi f)^2 at the peak of a ramp's torque spectrum
  ring_single_mass,  // the same formula at the frequency of rings after valve steps
  ring_with_losses,  // rigid load; frequency corrected for leakage and friction
  ring_flexible,     // also for the load's part that moves on the structure's spring
  ring_shape,        // as before, with the mode's torque over rate instead of K
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
  /// Fraction of the load's inertia behind the structure that moves with its lowest mode; the rest
  /// moves with the second. Used if no record shows it.
  numerics::Uncertain lowest_mode_fraction{0.85, 0.09};
  /// Slope of friction at the speed of the valve steps, N m s/rad, if known from another test.
  /// Leakage then also follows from the rings' damping alone.
  std::optional<numerics::Uncertain> friction_slope;
};

/// Results of method 2 for a campaign, given the bulk modulus.
struct ResonanceResult {
  /// N m/rad, from oil data, with both efficiencies as in motion; used by all readings except
  /// Sommerville's.
  numerics::Interval stiffness;
  /// By the case's convention about efficiencies: for Sommerville's J = K/(2 pi f)^2 at a
  /// spectrum's peak.
  numerics::Interval conventional_stiffness;
  double expected_frequency = 0.0;      // Hz, rigid, drawings' inertia on that stiffness
  std::vector<TorqueSpectrum> spectra;  // fast ramps, then slow ramps
  std::optional<StepRings> rings;
  std::vector<DriveResponse> responses;  // chirps, then steps
  std::vector<InertiaReading> readings;  // by kind
  /// Of the mode about a moving operating point, including structure and losses.
  std::optional<numerics::Interval> frequency;  // Hz
  std::optional<numerics::Interval> damping_ratio;
  /// The reading with the smallest uncertainty among those valid for a flexible, lossy drive; the
  /// spectrum's peak if there is no other.
  std::optional<InertiaReading> best;
  /// All motors over everything else (Sommerville, eq. 27) with `best`; upper end infinity if the
  /// interval reaches the motors' own inertia.
  std::optional<numerics::Interval> motor_to_load_ratio;
  std::optional<numerics::Interval> leakage_rate;  // 1/s
  std::optional<numerics::Interval> leakage_from_damping;
  /// Stiffness from motion alone: torque and rate, no oil data. N m/rad
  std::optional<numerics::Interval> stiffness_from_motion;
  /// Lowest mode of the flexible drive over that of the same drive with a rigid structure,
  /// undamped; below 1. The inertia J = K/(2 pi f)^2 is too large by its inverse square.
  double coupled_over_rigid = 1.0;
  std::vector<std::string> notes;
};

/// Hydraulic resonance, and inertia, stiffness and leakage computed from it (Sommerville section
/// III; physics section 1). Uses every reading that the campaign's records allow: spectra of fast
/// and slow ramps, rings after valve steps, response to a valve chirp. The notes state which peaks
/// are harmonics of the excitation, the effect of flexibility and losses on the simple formula, and
/// what the tests cannot determine.
/// @throws InvalidInput for knowledge without positive inertias, displacement, volumes.
ResonanceResult identify_resonance(const Campaign& campaign, const numerics::Interval& bulk_modulus,
                                   const ResonanceOptions& options = {});

/// Ratio of the load's dynamic inertia at complex frequency s (1/s) to its static one, for masses
/// on undamped springs: sum of f_k/(1 + (s/w_k)^2), f_k the inertia fractions.
std::complex<double> flexible_amplification(
    std::complex<double> s, const std::vector<numerics::Uncertain>& locked_rotor_frequencies,
    double lowest_mode_fraction);

}  // namespace boresight::identification
