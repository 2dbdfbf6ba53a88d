#pragma once

#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A dead time (s) as a rational system with the [order-1/order] Pade approximant of exp(-s delay),
/// in the shifted-Legendre basis (A. Voelker, C. Eliasmith, Neural Computation 30(3), 2018). Its
/// coefficients keep one order of magnitude, while those of the polynomials grow like factorials.
/// @throws InvalidInput unless delay > 0 and 1 <= order <= 16.
plant::StateSpace delay_approximant(double delay, int order, const std::string& input,
                                    const std::string& output);

/// Ascending powers of s, both 1 at s = 0.
struct PadeCoefficients {
  std::vector<double> numerator;
  std::vector<double> denominator;
};

/// Numerator and denominator of the [numerator_degree/denominator_degree] Pade approximant of
/// exp(-s delay), delay in s. Each coefficient is computed from the previous one (G. H. Golub, C.
/// F. Van Loan, Matrix Computations, 4th ed., 9.3.1).
/// @throws InvalidInput unless delay > 0 and the degrees are 0 to 16, not both 0.
PadeCoefficients pade_coefficients(double delay, int numerator_degree, int denominator_degree);

/// The same as a balanced companion realisation with states `output`_delay_1, .... Its response is
/// accurate to about 1e-13 at degree 16. With equal degrees it has a feedthrough of +-1.
/// @throws InvalidInput as pade_coefficients, and if the numerator has the higher degree.
plant::StateSpace pade_approximant(double delay, int numerator_degree, int denominator_degree,
                                   const std::string& input, const std::string& output);

}  // namespace boresight::control
