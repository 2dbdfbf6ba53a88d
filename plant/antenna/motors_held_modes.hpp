#pragma once

#include <vector>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {

/// A vibration mode of bull gear and modes on the gear spring with the motors locked.
struct MotorsHeldMode {
  double frequency = 0.0;         // Hz
  double inertia_fraction = 0.0;  // effective, of the antenna inertia
  /// Fraction of the mode's elastic energy in the gear spring: effective inertia times (2 pi f)^2
  /// over the gear stiffness. These fractions sum to 1 as well.
  double gear_fraction = 0.0;
};

/// These modes, the lowest first, as measured by a hammer test or computed by a finite-element
/// program. Undamped; one more than modes with the bull gear locked. With phi the shape, M the
/// inertias and 1 the rotation of the whole antenna, the effective inertia fraction is
///   (phi^T M 1)^2 / ((phi^T M phi) (1^T M 1));
/// the fractions sum to 1, and times (2 pi f)^2 to the gear stiffness over the antenna inertia.
/// Fractions and frequencies determine the antenna.
/// @throws InvalidInput unless inertias and stiffnesses are positive; NumericalFailure if the
/// eigenvalues do not converge.
std::vector<MotorsHeldMode> motors_held_modes(const Structure& structure);

/// The antennas that have the stated frequencies with the motors locked: locked_rotor_frequency
/// and, in increasing order, those of the modes (at most 8). Each is returned with its modes'
/// frequencies for the bull gear locked, the softest gear spring first. All else is as stated.
///
/// With s = (2 pi f)^2, x_i those of the modes with the bull gear held and r_i = J_i/J_b, the
/// secular equation K_g = s (J_b + sum J_i x_i/(x_i - s)) has the N + 1 stated roots s_0 < ... <
/// s_N if, for each mode,
///   r_i x_i^2 prod_{l != i} |x_l - x_i| = prod_j |s_j - x_i|,    s_{i-1} < x_i < s_i,
/// (residues of both sides of K_g - s (...) = J_b prod (s_j - s)/prod (x_i - s)). One mode has two
/// such antennas or none, more modes often several. Near the upper ends of the x_i the antenna
/// moves as one body on a soft gear spring at the lowest frequency. Near their lower ends the bull
/// gear alone moves on a stiff one at the highest. Closely spaced modes with large effective
/// inertia have no solution. Damped Newton iterations in the logarithms start from either end of
/// every x_i; antennas reached from two starts count once.
///
/// @throws InvalidInput for an inertia fraction that is not positive, fractions that do not sum to
/// less than 1, frequencies that are not positive or not increasing, and more than 8 modes. Also if
/// no antenna is found; the message names the mode whose inertia fraction needs the smallest
/// reduction to give one.
std::vector<StructureSpecification> hold_bull_gear_of(const StructureSpecification& motors_held);

/// The one antenna that has the stated frequencies with the motors locked: locked_rotor_frequency
/// and, in increasing order, those of the modes. The stated inertia fractions are the effective
/// ones of motors_held_modes; the lowest mode has the rest of 1. Each mode is returned with
/// frequency and inertia fraction for the bull gear locked; all else is as stated.
///
/// The turn of the whole antenna bends the gear spring alone (K 1 = K_g e_b), so that a mode of
/// s_j = (2 pi f_j)^2 and effective fraction e_j turns the bull gear by (s_j/K_g) sqrt(e_j J) where
/// its modal inertia is 1, and with K_g = J sum e_j s_j a torque on the bull gear turns it by
///   G(x) = sum p_j/(s_j - x),    p_j = e_j s_j^2/(J (sum e_l s_l)^2),    x = w^2.
/// G rises from pole to pole. Its zeros, one between each two, are the squares x_i of the circular
/// frequencies with the bull gear held, and as 1/G goes to J_i x_i^2/(x - x_i) there, the modes'
/// inertias are J_i = 1/(x_i^2 G'(x_i)); the bull gear's is 1/sum p_j. The zeros are bisected as
/// distances from the nearer pole.
///
/// @throws InvalidInput for a fraction that is not positive, fractions that do not sum to less
/// than 1, frequencies that are not positive or do not rise, and where rounding leaves no antenna
/// of them.
StructureSpecification antenna_of_effective_fractions(const StructureSpecification& motors_held);

}  // namespace boresight::plant
