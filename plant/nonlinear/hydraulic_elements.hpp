#pragma once

#include <boresight/numerics/value_and_derivative.hpp>

/// Flows and pressures of the parts of a hydraulic circuit, each with its derivative, for systems
/// of differential equations that give their Jacobian. The functions of the state check nothing:
/// they stand in inner loops; the descriptions they take are checked once, by validate() or here.
/// Merritt, H. E., "Hydraulic Control Systems", Wiley 1967.
namespace boresight::plant {

/// Flow (m3/s) through a sharp-edged orifice for the pressure difference dp (Pa), of dp's sign:
///   q = C dp / (dp^2 + dp_s^2)^(1/4),
/// and dq/ddp. q tends to C sqrt(|dp|) well above the transition dp_s (Pa, above 0). Well below it,
/// q is linear with slope C/sqrt(dp_s), like the laminar flow at small differences. It is smooth in
/// between (regRoot of Modelica.Fluid), so a flow reversal needs no event. It is less than C
/// sqrt(|dp|) by the fraction (dp_s/dp)^2/4 above dp_s, and by at most 0.2545 C sqrt(dp_s). C in
/// m3/s per sqrt(Pa), at least 0; other consistent units are possible.
numerics::ValueAndDerivative orifice(double coefficient, double pressure_difference,
                                     double transition);

/// C = Cd A sqrt(2/rho) of an opening A (m2) with discharge coefficient Cd (0.6 to 0.7 for a sharp
/// edge) in oil of density rho (kg/m3): Merritt, chapter 3.
/// @throws InvalidInput for an A below 0, a Cd or rho not above 0, or any not finite.
double orifice_coefficient(double opening, double discharge_coefficient, double density);

/// The flow of an orifice in one direction only: none for dp <= 0, where its slope jumps by
/// C/sqrt(dp_s); best an event.
numerics::ValueAndDerivative check_valve(double coefficient, double pressure_difference,
                                         double transition);

/// dp/dt (Pa/s) per net flow into a volume V (m3) of oil of bulk modulus beta (Pa): beta/V,
/// constant for as long as beta is; V/beta (p - p0) is what the oil has taken in since the pressure
/// was p0.
/// @throws InvalidInput unless both are above 0 and finite.
double volume_stiffness(double bulk_modulus, double volume);

/// A relief valve: a spool that a spring keeps closed up to `opening_pressure` and that follows its
/// balance of forces as a lag of first order. Its opening x counts in the flow per square root of
/// the pressure over the tank's, m3/s per sqrt(Pa): q = x sqrt(p - p_tank).
struct ReliefValve {
  double opening_pressure = 0.0;  // Pa
  double tank_pressure = 0.0;     // Pa
  /// Pressure above the opening pressure per opening: by the spring (Pa per opening), and by the
  /// flow forces for each Pa over the tank's (1 per opening).
  double spring_rate = 0.0;
  double flow_force_rate = 0.0;
  double largest_opening = 0.0;  // m3/s per sqrt(Pa)
  double time_constant = 0.0;    // s
};

/// @throws InvalidInput unless opening_pressure >= tank_pressure, spring_rate, largest_opening and
/// time_constant are above 0, flow_force_rate is at least 0, and all are finite.
void validate(const ReliefValve& valve);

/// Opening at which the spool would rest at a pressure p (Pa) if nothing stopped it,
///   (p - p_open)/(spring_rate + (p - p_tank) flow_force_rate)  for p >= p_tank,
/// negative below the opening pressure, and its derivative. Where it passes 0 and largest_opening,
/// the spool leaves or meets its stops: events.
numerics::ValueAndDerivative free_opening(const ReliefValve& valve, double pressure);

/// Where the spool rests: free_opening within 0..largest_opening. Its derivative is that of the
/// outer side at either end.
numerics::ValueAndDerivative resting_opening(const ReliefValve& valve, double pressure);

}  // namespace boresight::plant
