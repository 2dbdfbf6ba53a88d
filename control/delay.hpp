#pragma once

#include <boresight/plant/state_space.hpp>

namespace boresight::control {

/// A dead time (s) as a rational system with the [order-1/order] Pade approximant of exp(-s delay),
/// in the shifted-Legendre basis (A. Voelker, C. Eliasmith, Neural Computation 30(3), 2018), whose
/// coefficients stay of one size where those of the polynomials grow like factorials.
/// @throws InvalidInput unless delay > 0 and 1 <= order <= 16.
plant::StateSpace delay_approximant(double delay, int order, const std::string& input,
                                    const std::string& output);

}  // namespace boresight::control
