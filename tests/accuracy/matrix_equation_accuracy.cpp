#include <cmath>
#include <functional>

#include "accuracy_table.hpp"
#include <boresight/control/equations/riccati.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::reference {

namespace {

control::RiccatiProblem problem_of(const nlohmann::json& entry) {
  const Eigen::MatrixXd a = matrix(entry.at("A"));
  const Eigen::MatrixXd b = matrix(entry.at("B"), a.rows());
  return {a, b, matrix(entry.at("Q"), a.rows()), matrix(entry.at("R"), b.cols()), {}};
}

/// What an error of the library says, or "" if there is none.
std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void riccati_rows(AccuracySection& section, const nlohmann::json& cases) {
  for (const auto& entry : cases) {
    const std::string name = entry.at("id");
    const bool sampled = entry.at("kind") == "dare";
    const auto problem = problem_of(entry);
    const auto solve = [&] {
      return sampled ? control::solve_discrete_riccati(problem) : control::solve_riccati(problem);
    };
    const std::string expected = entry.value("expected", "");
    if (expected.starts_with("error naming")) {
      const bool detectable = expected.ends_with("detectability");
      const std::string message = message_of(solve);
      section.stated(name, "refusal", expected,
                     message.find(detectable ? "detectable" : "stabilisable") != std::string::npos);
      continue;
    }
    const auto solution = solve();
    if (entry.contains("X_octave")) {
      std::vector<PrintedNumber> printed;
      for (const double element : flattened(matrix(entry.at("X_octave")))) {
        printed.push_back({element, 0.5e-4});
      }
      section.printed(name, "X", flattened(solution.x), printed);
    } else if (entry.at("X").is_string()) {  // "((1+sqrt(5))/2) * I2"
      section.matrix(name, "X", solution.x,
                     0.5 * (1.0 + std::sqrt(5.0)) * Eigen::Matrix2d::Identity(), 16, 1e-9);
    } else {
      section.matrix(name, "X", solution.x, matrix(entry.at("X")), 16, 1e-9);
    }
  }
}

void response_rows(AccuracySection& section, const nlohmann::json& file) {
  const auto& scaled = file.at("badly_scaled_frequency_response");
  plant::DenseResponse response(matrices_of(scaled));
  for (const auto& row : scaled.at("exact").at("values")) {
    const double w = row.at(0);
    const auto gain = response.channel(w);
    section.matrix("badly scaled system", "response at " + row.at(0).dump() + " rad/s",
                   Eigen::RowVector2d(gain.real(), gain.imag()),
                   Eigen::RowVector2d(row.at(1).get<double>(), row.at(2).get<double>()), 16, 1e-9);
  }
  const auto& balancing = file.at("slycot11_tb05ad_balancing_bug");
  plant::DenseResponse cascade(matrices_of(balancing));
  const auto gain = cascade.at({balancing.at("s").at(0), balancing.at("s").at(1)})(0, 0);
  section.matrix("slycot11_tb05ad_balancing_bug", "response",
                 Eigen::RowVector2d(gain.real(), gain.imag()),
                 Eigen::RowVector2d(balancing.at("H").at(0).get<double>(),
                                    balancing.at("H").at(1).get<double>()),
                 16, 1e-9);
}

}  // namespace

AccuracySection matrix_equation_accuracy() {
  AccuracySection section(
      "Riccati equations, scaling",
      "`values/riccati_scaling.json`: equations on which Drake, wpimath and others failed, "
      "with the solutions of Octave (4 decimals) or in closed form; a badly scaled system whose "
      "response is known from rational arithmetic.");
  const auto file = reference_values("riccati_scaling");
  riccati_rows(section, file.at("care_dare"));
  response_rows(section, file);
  return section;
}

}  // namespace boresight::reference
