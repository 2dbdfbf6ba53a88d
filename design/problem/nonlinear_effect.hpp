#pragma once

namespace boresight::design {

/// Rms (rad) of a limit cycle of known amplitude only (rad, half of peak to peak). Computed as that
/// of a sinusoid, amplitude / sqrt(2).
double limit_cycle_rms(double amplitude);

/// Result of a simulation on the nonlinear antenna, as a correction to a controller's linear rms.
/// All studies compare controllers and evaluate budgets by
///   rms = sqrt((factor * linear)^2 + limit_cycle_rms(amplitude)^2).
/// The limit cycle is simulated without wind; independent errors add in quadrature. Without a
/// simulation this is the linear rms.
struct NonlinearEffect {
  double factor = 1.0;     // simulated over linear rms in wind; infinite where a run was lost
  double amplitude = 0.0;  // of the boresight's limit cycle, rad at the sky

  /// Of a simulated and the linear rms in wind (of one unit), and a limit cycle's amplitude (rad).
  /// The factor is infinite if `simulated` is not finite, as of a run that was lost.
  static NonlinearEffect of_simulation(double simulated, double linear, double amplitude);
  /// Rms (rad) including the limit cycle, for a linear rms (rad).
  double rms(double linear) const;
  /// The linear rms (rad) at which rms() equals a budget (rad): the part allowed for wind. 0 if the
  /// limit cycle alone exhausts the budget or a run was lost.
  double linear_limit(double budget) const;
  /// The effect for comparison with budgets, which uses the larger of the linear and the simulated
  /// rms.
  NonlinearEffect for_budgets() const;
};

/// True if an rms (rad) is within a budget (rad), with a relative tolerance for round-off.
bool within_budget(double rms, double budget);

}  // namespace boresight::design
