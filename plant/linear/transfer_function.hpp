#pragma once

#include <complex>
#include <string>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// gain (s - z1)(s - z2).../((s - p1)(s - p2)...) as a state space with states `name`.1, `name`.2,
/// ...; z in place of s where sample_time > 0. A cascade of sections of one or two poles, from the
/// slowest on, each with the zeros nearest to its poles and with a gain of about 1 at its own
/// frequency: no polynomial of the whole is formed, so high orders and poles many decades apart
/// keep their digits (unlike with `rational`). Errors are some 1e-16 of the largest response: where
/// zeros far from all poles make the response small beside its feedthrough (a differentiator at low
/// frequency), no state space keeps more.
/// @throws InvalidInput for more zeros than poles, a root that is not finite, a complex root
/// without its conjugate, a gain that is not finite, or a negative sample time (s).
StateSpace zeros_poles_gain(const std::vector<std::complex<double>>& zeros,
                            const std::vector<std::complex<double>>& poles, double gain,
                            const std::string& input, const std::string& output,
                            const std::string& name, double sample_time = 0.0);

}  // namespace boresight::plant
