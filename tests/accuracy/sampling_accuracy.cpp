#include <complex>

#include "accuracy_table.hpp"
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::reference {

namespace {

/// What does not depend on the choice of states: D, C B, C A B, C A A B.
std::vector<double> markov_parameters(const plant::StateSpace& system) {
  auto result = flattened(system.d);
  Eigen::MatrixXd moved = system.b;
  for (int k = 0; k < 3; ++k) {
    const auto next = flattened(Eigen::MatrixXd(system.c * moved));
    result.insert(result.end(), next.begin(), next.end());
    moved = (system.a * moved).eval();
  }
  return result;
}

}  // namespace

AccuracySection sampling_accuracy() {
  AccuracySection section(
      "Sampling",
      "`values/c2d.json`: a continuous system of two states sampled by ControlSystems.jl and "
      "MATLAB. Where MATLAB has scaled the states, the first four terms of the pulse response "
      "(D, CB, CAB, CAAB) are compared, which do not depend on that.");
  const auto file = reference_values("c2d");
  nlohmann::json given = file.at("C_222_d");
  const double period = given.at("Ts");
  given.erase("Ts");
  const plant::StateSpace continuous = system_of(given);
  const auto completed = [&](const char* key) {
    plant::StateSpace system = continuous;
    const auto& entry = file.at(key);
    system.a = matrix(entry.at("A"));
    system.b = matrix(entry.at("B"));
    if (entry.at("C").is_array()) system.c = matrix(entry.at("C"));
    if (entry.at("D").is_array()) system.d = matrix(entry.at("D"));
    return system;
  };

  const auto held = plant::sample(continuous, period);
  section.matrix("zoh", "A", held.a, completed("zoh").a, 16, 1e-9);
  section.matrix("zoh", "B", held.b, completed("zoh").b, 16, 1e-9);
  const auto straight = plant::sample(continuous, period, plant::SamplingMethod::first_order_hold);
  section.matrix("foh", "A", straight.a, completed("foh").a, 16, 1e-9);
  section.matrix("foh", "B", straight.b, completed("foh").b, 16, 1e-9);
  section.matrix("foh", "D", straight.d, completed("foh").d, 16, 1e-9);
  for (const auto& [key, warp] :
       {std::pair{"tustin_matlab", 0.0}, std::pair{"tustin_prewarp_10rad_matlab", 10.0}}) {
    const auto bilinear =
        plant::sample(continuous, period, plant::SamplingMethod::tustin, {warp, {}});
    section.matrix(key, "A", bilinear.a, completed(key).a, 13, 1e-9);
    section.numbers(key, "pulse response", markov_parameters(bilinear),
                    markov_parameters(completed(key)), 13, 1e-9);
  }

  const auto& rational = file.at("tf_zoh");
  const plant::StateSpace function =
      plant::rational(ascending(rational.at("num")), ascending(rational.at("den")), "u", "y", "x");
  plant::StateSpace printed = plant::rational(ascending(rational.at("num_d")),
                                              ascending(rational.at("den_d")), "u", "y", "x");
  printed.sample_time = rational.at("Ts");
  section.numbers("tf_zoh", "pulse response",
                  markov_parameters(plant::sample(function, printed.sample_time)),
                  markov_parameters(printed), 15, 1e-9);
  return section;
}

}  // namespace boresight::reference
