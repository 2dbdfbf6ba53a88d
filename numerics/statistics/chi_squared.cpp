#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/chi_squared.hpp>

namespace boresight::numerics {

double chi_squared_999(int freedom) {
  if (freedom < 1) {
    throw InvalidInput(
        fmt::format("chi_squared_999: expected a freedom of at least 1, found {}", freedom));
  }
  constexpr double normal_999 = 3.090232306167813;
  const double n = freedom;
  const double part = 2.0 / (9.0 * n);
  return n * std::pow(1.0 - part + normal_999 * std::sqrt(part), 3);
}

}  // namespace boresight::numerics
