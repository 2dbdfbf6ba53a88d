#pragma once

namespace boresight::design {

/// Rms (rad) of a limit cycle of that amplitude (rad, half of peak to peak) of which no more is
/// known: that of a sinusoid, amplitude / sqrt(2).
double limit_cycle_rms(double amplitude);

/// What simulation on the nonlinear antenna says of a controller beyond its linear rms. Every study
/// compares controllers and judges budgets by
///   rms = sqrt((factor * linear)^2 + limit_cycle_rms(amplitude)^2):
/// the limit cycle is seen without wind, and errors that do not depend on one another add in
/// quadrature. Without a simulation: the linear rms.
struct NonlinearEffect {
  double factor = 1.0;     // simulated over linear rms in wind; infinite where a run was lost
  double amplitude = 0.0;  // of the boresight's limit cycle, rad at the sky

  /// Rms (rad) with the limit cycle, of a linear rms (rad).
  double rms(double linear) const;
  /// The linear rms (rad) whose rms() is a budget (rad): what wind may cause. 0 where the limit
  /// cycle alone takes the budget or the run was lost.
  double linear_limit(double budget) const;
  /// Budgets are held against the larger of the linear and the simulated rms.
  NonlinearEffect for_budgets() const;
};

/// Whether an rms (rad) keeps a budget (rad), met to the last digit included.
bool within_budget(double rms, double budget);

}  // namespace boresight::design
