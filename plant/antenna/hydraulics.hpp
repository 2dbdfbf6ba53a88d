#pragma once

namespace boresight::plant {

/// Bulk modulus beta = (2 L f)^2 rho (Pa) of the oil in a line of length L (m) whose pressure wave
/// runs to the closed motor port and back once a period of the slosh frequency f (Hz); density rho
/// (kg/m3). Sommerville eqs. 21-26: a half-wave line. A valve end that releases the pressure would
/// make it a quarter wave, f = c/(4L), and beta four times larger.
double bulk_modulus_from_slosh(double line_length, double slosh_frequency, double density);

/// The slosh frequency (Hz) that a bulk modulus (Pa) makes in a half-wave line: the inverse of
/// bulk_modulus_from_slosh.
double slosh_frequency(double line_length, double bulk_modulus, double density);

/// What the efficiencies of a hydraulic motor do to the oil spring. Sommerville eq. 17 multiplies
/// the stiffness by both; a spring is conservative, so dissipative efficiencies arguably do not
/// belong there.
enum class EfficiencyInStiffness { both, none };

/// Motors in parallel on two common lines.
struct HydraulicDrive {
  double motor_count = 1.0;
  /// Displacement of one motor (m3/rad).
  double displacement = 0.0;
  double torque_efficiency = 1.0;
  double volumetric_efficiency = 1.0;
  double bulk_modulus = 0.0;  // Pa
  double volume_1 = 0.0;      // m3, trapped between valve and motor ports
  double volume_2 = 0.0;
  EfficiencyInStiffness efficiency_in_stiffness = EfficiencyInStiffness::both;
};

/// Oil spring at the motor shaft, K = e_t e_v beta D^2 (1/V1 + 1/V2) (N m/rad), D the displacement
/// of all motors together (m3/rad): Sommerville eq. 17.
/// @throws InvalidInput unless every factor is positive and finite.
double oil_stiffness(const HydraulicDrive& drive);

/// Torque of all motors per pressure difference between the ports, e_t D (N m/Pa): eq. 9.
double torque_per_pressure(const HydraulicDrive& drive);

/// f = sqrt(K/J)/(2 pi) (Hz): eq. 18.
double hydraulic_frequency(double oil_stiffness, double reflected_inertia);

/// J = K/(2 pi f)^2 (kg m2): eqs. 19, 20. Takes the antenna as rigid and loss-free: a flexible
/// structure makes the first mode lower than this formula's, so the inertia reads high; with both
/// leakage and friction the mode moves with them too (physics: wn^2 = (K/J)(1 + Bf lambda/K)).
double inertia_from_resonance(double oil_stiffness, double frequency);

/// Damping ratio of the hydraulic mode of a rigid load, (lambda + Bf/J)/(2 wn) with
/// wn^2 = (K + Bf lambda)/J: leakage rate lambda (1/s), viscous friction Bf (N m s/rad).
double hydraulic_damping(double oil_stiffness, double reflected_inertia, double leakage_rate,
                         double viscous_friction);

}  // namespace boresight::plant
