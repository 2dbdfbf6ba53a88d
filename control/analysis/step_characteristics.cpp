#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/control/analysis/decaying_response.hpp>
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/control/equations/lyapunov_factor.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/minimal_realisation.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::control {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
// Of the final value: what is closer to it than this has reached it.
constexpr double equal = 1e-12;
// Of the final value: below this a response is over.
constexpr double over = 1e-14;

// The response as final + C x(t) with x(0) = `start`, turned so that final >= 0.
struct Transient {
  Eigen::MatrixXd a;
  Eigen::RowVectorXd c;
  Eigen::VectorXd start;
  double initial = 0.0;  // at t = 0
  double final = 0.0;
  double sign = 1.0;
  double sample_time = 0.0;
  // The same as a sum of modes Re(amplitude exp(pole t)), where the eigenvectors are sound.
  Eigen::VectorXcd poles, amplitudes;
};

// What the searches find, turned in the same way.
struct Findings {
  double rise_from = nan, rise_to = nan, settled = nan;
  double settling_min = nan, settling_max = nan;  // less the final value
  double highest = 0.0, highest_time = 0.0;       // less the final value, as is the lowest
  double lowest = 0.0, lowest_time = 0.0;
};

void check(const plant::StateSpace& system, const StepOptions& options) {
  plant::validate(system);
  if (system.inputs.size() != 1 || system.outputs.size() != 1) {
    throw InvalidInput(
        fmt::format("step_characteristics: expected one input and one output, found {} and {}",
                    system.inputs.size(), system.outputs.size()));
  }
  if (!(options.settling_band > 0.0) || !(options.settling_band < 1.0)) {
    throw InvalidInput(
        fmt::format("step_characteristics: expected a settling_band between 0 and 1, found {}",
                    options.settling_band));
  }
  if (!(options.rise_from >= 0.0) || !(options.rise_to > options.rise_from) ||
      !(options.rise_to < 1.0)) {
    throw InvalidInput(
        fmt::format("step_characteristics: expected 0 <= rise_from < rise_to < 1, found {} and {}",
                    options.rise_from, options.rise_to));
  }
}

// Better than this condition of the eigenvectors, modes keep more digits than exp(A t) does.
constexpr double sound_condition = 1e6;

// Whether a steady state exists; refuses what diverges or oscillates.
bool settles(const plant::StateSpace& system) {
  const bool sampled = system.sample_time > 0.0;
  const double size = sampled ? 1.0 : system.a.norm();
  bool steady = true;
  for (const std::complex<double> pole : numerics::eigenvalues(system.a)) {
    const double margin = sampled ? 1.0 - std::abs(pole) : -pole.real();
    if (margin > 1e-13 * size) continue;
    // Integrators in a chain come out of rounding as a small circle around their place.
    if (std::abs(sampled ? pole - 1.0 : pole) <= 1e-7 * size) {
      steady = false;
      continue;
    }
    throw NumericalFailure(
        fmt::format("step_characteristics: expected a stable system, found a pole at {:.6g} "
                    "{:+.6g}j; close a loop that stabilises it first",
                    pole.real(), pole.imag()));
  }
  return steady;
}

void add_modes(const plant::StateSpace& system, Transient& transient) {
  plant::ModalForm form;
  try {
    form = plant::modal_form(system);
  } catch (const NumericalFailure&) {
    return;  // poles in a chain: the dense route serves them
  }
  if (!(form.condition <= sound_condition)) return;
  transient.poles = form.poles;
  transient.amplitudes.resize(form.poles.size());
  for (Eigen::Index i = 0; i < form.poles.size(); ++i) {
    const double both = form.poles[i].imag() > 0.0 ? 2.0 : 1.0;
    transient.amplitudes[i] =
        transient.sign * both * form.output(0, i) * form.input(i, 0) / form.poles[i];
  }
}

// A - I for a sampled system: what C (...)^-1 B is formed with.
Eigen::MatrixXd at_rest(const plant::StateSpace& system) {
  Eigen::MatrixXd shifted = system.a;
  if (system.sample_time > 0.0) shifted.diagonal().array() -= 1.0;
  return shifted;
}

// D - C A^-1 B, or 0 where it is no larger than what one rounding of each element of the system
// may make of it (a loop that integrates: the difference of large numbers). `by_element`: elements
// are known to their own last digit, otherwise to that of the norm.
double final_value(const plant::StateSpace& system, bool by_element) {
  const char* what = "step_characteristics";
  const Eigen::MatrixXd a = at_rest(system);
  const Eigen::VectorXd state = numerics::linear_solve(a, system.b, what).col(0);
  const Eigen::VectorXd costate =
      numerics::linear_solve(a.transpose(), system.c.transpose(), what).col(0);
  // One step of refinement makes the errors of the solution small element by element.
  const Eigen::VectorXd correction =
      numerics::linear_solve(a, system.b.col(0) - a * state, what).col(0);
  const double value = system.d(0, 0) - (system.c * (state + correction))(0);
  const Eigen::VectorXd size = state.cwiseAbs();
  const double through =
      by_element ? costate.cwiseAbs().dot(a.cwiseAbs() * size + system.b.cwiseAbs().col(0))
                 : costate.norm() * (a.norm() * state.norm() + system.b.norm());
  const double doubt = std::abs(system.d(0, 0)) + system.c.row(0).cwiseAbs().dot(size) + through;
  return std::abs(value) > 8.0 * std::numeric_limits<double>::epsilon() * doubt ? value : 0.0;
}

Transient transient_of(const plant::StateSpace& system, const plant::StateSpace& minimal) {
  Transient result;
  result.a = minimal.a;
  result.c = minimal.c.row(0);
  result.sample_time = minimal.sample_time;
  result.start = numerics::linear_solve(at_rest(minimal), minimal.b, "step_characteristics").col(0);
  try {
    result.final = final_value(plant::balanced(system), true);
  } catch (const NumericalFailure&) {
    result.final = final_value(minimal, false);  // a pole at the origin that has been cancelled
  }
  result.initial = system.d(0, 0);
  if (result.final < 0.0) {
    result.sign = -1.0;
    result.initial = -result.initial;
    result.final = -result.final;
    result.c = -result.c;
  }
  if (result.sample_time == 0.0) add_modes(minimal, result);
  return result;
}

Findings search(const Transient& transient, const StepOptions& options) {
  const bool by_modes = transient.poles.size() > 0;
  DecayingResponse response = by_modes ? DecayingResponse(transient.poles, transient.amplitudes)
                                       : DecayingResponse(transient.a, transient.c);
  const auto start = response.start(by_modes ? response.modal_start() : transient.start);
  const double final = transient.final;
  Findings found;
  // A final value of 0 leaves the size of the transient to compare with.
  double size = std::max(final, std::abs(start.value));
  if (size == 0.0) size = transient.c.norm() * transient.start.norm();
  const auto highest = response.extreme(start, 1.0, over * size);
  const auto lowest = response.extreme(start, -1.0, over * size);
  // At the start the response is known without rounding.
  const double first = transient.initial - final;
  found.highest = highest.time > 0.0 ? highest.value : first;
  found.highest_time = highest.time;
  found.lowest = lowest.time > 0.0 ? lowest.value : first;
  found.lowest_time = lowest.time;
  if (!(final > equal * std::max(highest.value, -lowest.value))) return found;

  const auto from = response.first_reach(start, (options.rise_from - 1.0) * final, over * final);
  const auto to = response.first_reach(start, (options.rise_to - 1.0) * final, over * final);
  if (!from || !to) return found;  // impossible: the response ends at its final value
  found.rise_from = from->time;
  found.rise_to = to->time;
  found.settled = response.last_beyond(start, options.settling_band * final).value_or(0.0);
  found.settling_max = response.extreme(*to, 1.0, over * final).value;
  found.settling_min = response.extreme(*to, -1.0, over * final).value;
  return found;
}

// The same, sample by sample.
Findings search_samples(const Transient& transient, const StepOptions& options) {
  const Eigen::MatrixXd bound =
      real_lyapunov_factor(lyapunov_factor("step_characteristics", transient.a.transpose(),
                                           transient.c.transpose(), TimeDomain::sampled))
          .transpose();
  const double final = transient.final;
  Eigen::VectorXd x = transient.start, next = x;
  Findings found;
  const double first = transient.c.dot(x);
  double size = std::max(final, std::abs(first));
  if (size == 0.0) size = (bound * x).norm();
  found.highest = found.lowest = first;
  found.settled = 0.0;
  constexpr double max_work = 1e10;  // multiplications
  const auto max_samples =
      static_cast<Eigen::Index>(max_work / static_cast<double>(transient.a.size() + 1));
  for (Eigen::Index k = 0; (bound * x).norm() > over * size; ++k) {
    if (k == max_samples) {
      throw NumericalFailure(fmt::format(
          "step_characteristics: the response has not settled after {} samples", max_samples));
    }
    const double value = transient.c.dot(x);
    const double time = static_cast<double>(k) * transient.sample_time;
    if (value > found.highest) {
      found.highest = value;
      found.highest_time = time;
    }
    if (value < found.lowest) {
      found.lowest = value;
      found.lowest_time = time;
    }
    if (std::isnan(found.rise_from) && value >= (options.rise_from - 1.0) * final) {
      found.rise_from = time;
    }
    if (std::isnan(found.rise_to) && value >= (options.rise_to - 1.0) * final) {
      found.rise_to = time;
      found.settling_min = found.settling_max = value;
    }
    if (!std::isnan(found.rise_to)) {
      found.settling_min = std::min(found.settling_min, value);
      found.settling_max = std::max(found.settling_max, value);
    }
    if (std::abs(value) >= options.settling_band * final) {
      found.settled = time + transient.sample_time;
    }
    next.noalias() = transient.a * x;
    x.swap(next);
  }
  return found;
}

StepCharacteristics put_together(const Transient& transient, const Findings& found) {
  const double final = transient.final, sign = transient.sign;
  StepCharacteristics result;
  const double largest = std::max({final, found.highest, -found.lowest});
  const bool rests_at_zero = !(final > equal * largest);
  result.final_value = rests_at_zero ? 0.0 : sign * final;
  const double above = found.highest > equal * largest ? found.highest : 0.0;
  const double top = final + above, bottom = final + found.lowest;
  result.peak = std::max(top, -bottom);
  result.peak_time = above > 0.0 ? found.highest_time : infinity;
  if (-bottom > top) result.peak_time = found.lowest_time;
  if (rests_at_zero) {
    result.rise_time = result.settling_time = result.settling_min = result.settling_max = nan;
    result.overshoot = result.undershoot = nan;
    return result;
  }
  result.rise_time = found.rise_to - found.rise_from;
  result.settling_time = found.settled;
  // The final value itself, which is approached, counts.
  const double low = final + std::min(found.settling_min, 0.0);
  const double high = final + (found.settling_max > equal * final ? found.settling_max : 0.0);
  result.settling_min = sign > 0.0 ? low : -high;
  result.settling_max = sign > 0.0 ? high : -low;
  result.overshoot = above / final;
  result.undershoot = bottom < -equal * final ? -bottom / final : 0.0;
  return result;
}

}  // namespace

StepCharacteristics step_characteristics(const plant::StateSpace& system,
                                         const StepOptions& options) {
  check(system, options);
  const plant::StateSpace minimal = plant::balanced(
      plant::minimal_realisation(system, {.tolerance = options.minimal_tolerance}).system);
  if (minimal.states.empty()) {
    const double gain = system.d(0, 0), none = gain == 0.0 ? nan : 0.0;
    return {true, gain, none, none, gain, gain, none, none, std::abs(gain), 0.0};
  }
  if (!settles(minimal)) {
    return {false, nan, nan, nan, nan, nan, nan, nan, infinity, nan};
  }
  const Transient transient = transient_of(system, minimal);
  return put_together(transient, minimal.sample_time > 0.0 ? search_samples(transient, options)
                                                           : search(transient, options));
}

}  // namespace boresight::control
