#include <cmath>

#include "accuracy_table.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/reduction/gramians.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::reference {

namespace {

/// A number, "inf", or where there is none nothing.
void add_norm(AccuracySection& section, const std::string& name, const std::string& quantity,
              double found, const nlohmann::json& entry, const char* key) {
  if (!entry.contains(key)) return;
  const auto& reference = entry.at(key);
  if (reference.is_string()) {
    section.stated(name, quantity, "infinite", std::isinf(found));
  } else {
    section.number(name, quantity, found, reference, 15, 1e-9);
  }
}

/// 1/(1 + L) of the loop P C.
plant::StateSpace sensitivity_of(const nlohmann::json& system) {
  const auto plant = sections_of(system.at("P_zpk"));
  const auto controller = plant::renamed(sections_of(system.at("C_zpk")),
                                         {{"u", "error"}, {"y", "u"}, {"section1.1", "integral"}});
  const auto total =
      plant::static_gain(Eigen::RowVector2d(1.0, -1.0), {"reference", "y"}, {"error"});
  return plant::connect({plant, controller, total}, {"reference"}, {"error"});
}

void peak_and_h2_rows(AccuracySection& section, const nlohmann::json& cases) {
  for (const auto& entry : cases) {
    const std::string name = entry.at("id");
    if (name == "slicot_AB13DD" || name == "property_cs584") continue;  // have tables, tests
    if (name == "issue_cs1014") {
      const auto peak = control::peak_gain(sensitivity_of(entry.at("system")));
      const auto& verified = entry.at("verified");
      section.printed(name, "Ms", {peak.lower}, {printed_number(verified.at("hinf"))});
      section.number(name, "its frequency", peak.frequency, verified.at("freq"), 6, 1e-5);
      continue;
    }
    const plant::StateSpace system = system_of(entry.at("system"));
    const auto peak = control::peak_gain(system);
    add_norm(section, name, "peak gain", peak.lower, entry, "hinf");
    add_norm(section, name, "peak gain", peak.lower, entry, "linf");
    add_norm(section, name, "its frequency", peak.frequency, entry, "hinf_freq");
    add_norm(section, name, "H2 norm", control::h2_norm(system).value, entry, "h2");
    if (!entry.contains("zoh_Ts0.1")) continue;
    const auto sampled = plant::sample(system, 0.1);
    const auto& held = entry.at("zoh_Ts0.1");
    add_norm(section, name, "peak gain, sampled at 0.1 s", control::peak_gain(sampled).lower, held,
             "hinf");
    const double h2 = control::h2_norm(sampled).value;
    if (name == "pc_G1") {
      // x[k+1] = a x[k] + (1 - a) u[k], a = e^-0.1, has the variance (1 - a)^2/(1 - a^2).
      section.number(name, "H2 norm, sampled at 0.1 s", h2, std::sqrt(std::tanh(0.05)), 16, 1e-9,
                     "exact sqrt(tanh(0.05)); the file's 0.223513699524858 is 1.1e-8 low");
    } else {
      add_norm(section, name, "H2 norm, sampled at 0.1 s", h2, held, "h2");
    }
  }
}

void covariance_rows(AccuracySection& section, const nlohmann::json& entry) {
  const std::string name = "covariance";
  const plant::StateSpace system = system_of(entry);
  const Eigen::Matrix2d white = Eigen::Matrix2d::Identity();
  section.matrix(name, "of the outputs", control::output_covariance(system, white).covariance,
                 matrix(entry.at("cov")), 13, 1e-9);
  plant::StateSpace direct = system;
  direct.d = white;
  section.stated(name, "with direct feedthrough", "infinite",
                 std::isinf(control::output_covariance(direct, white).covariance(0, 0)));
  plant::StateSpace sampled = direct;
  sampled.sample_time = 1.0;
  section.matrix(name, "of the same matrices, sampled",
                 control::output_covariance(sampled, white).covariance,
                 matrix(entry.at("discrete_Ts1_D_I")), 15, 1e-9);
}

void hankel_rows(AccuracySection& section, const nlohmann::json& entry) {
  std::vector<PrintedNumber> printed;
  for (const auto& value : entry.at("hsv_verified")) printed.push_back(printed_number(value));
  section.printed("hsv", "Hankel singular values",
                  flattened(Eigen::MatrixXd(control::hankel_singular_values(system_of(entry)))),
                  printed);
}

}  // namespace

AccuracySection norm_accuracy() {
  AccuracySection section(
      "Norms, covariances, Hankel singular values",
      "`values/norms_gramians.json`, from python-control, ControlSystems.jl, Octave and the "
      "literature. Its property of 10 000 random systems is a test of its own "
      "(tests/control/analysis/peak_gain_test.cpp), and SLICOT's AB13DD is among SLICOT's "
      "examples.");
  const auto file = reference_values("norms_gramians");
  peak_and_h2_rows(section, file.at("hinf_h2"));
  covariance_rows(section, file.at("covariance").at(0));
  hankel_rows(section, file.at("hsv").at(0));
  return section;
}

}  // namespace boresight::reference
