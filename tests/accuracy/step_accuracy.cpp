#include <cmath>

#include "accuracy_table.hpp"
#include <boresight/control/analysis/step_characteristics.hpp>

namespace boresight::reference {

namespace {

struct Quantity {
  const char* key;   // in the file
  const char* name;  // here
  double value;
};

std::vector<Quantity> quantities_of(const control::StepCharacteristics& step) {
  return {{"RiseTime", "rise time", step.rise_time},
          {"SettlingTime", "settling time", step.settling_time},
          {"Peak", "peak", step.peak},
          {"Overshoot", "overshoot, percent", 100.0 * step.overshoot},
          {"Undershoot", "undershoot, percent", 100.0 * step.undershoot}};
}

constexpr double grid = 5e-5;  // s, of the reference's peak times

plant::StateSpace system_called(const nlohmann::json& cases, const char* name) {
  return system_of(case_of(cases, name).at("system"));
}

/// Where 1 - near e^(-slow t) - (1 - near) e^(-fast t) reaches a level.
double reaches(double level, double slow, double fast, double near) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 * (low + high);
    const double value = 1.0 - near * std::exp(-slow * t) - (1.0 - near) * std::exp(-fast * t);
    (value < level ? low : high) = t;
  }
  return high;
}

void degenerate_rows(AccuracySection& section, const nlohmann::json& cases) {
  const auto integrator = control::step_characteristics(system_called(cases, "pc_type1"));
  section.stated("pc_type1", "all but the peak", "nan",
                 !integrator.settles && std::isnan(integrator.rise_time) &&
                     std::isnan(integrator.settling_time) && std::isnan(integrator.overshoot) &&
                     std::isnan(integrator.final_value));
  section.stated("pc_type1", "peak", "infinite", std::isinf(integrator.peak));

  const auto negative = control::step_characteristics(system_called(cases, "pc337_negative_final"));
  section.printed("pc337_negative_final", "final value", {negative.final_value},
                  {printed_number(std::string("-1.4010327"))});

  // s divided out of both polynomials by hand.
  const auto cancelled =
      control::step_characteristics(system_called(cases, "pc640_origin_cancellation"));
  const auto by_hand = control::step_characteristics(plant::rational(
      {8.4159075, 27.6062153, 10.7161216, 5.3998},
      {8.4159075, 44.4380303, 74.7874022, 55.8912172, 22.079728, 5.684}, "u", "y", "x"));
  section.numbers("pc640_origin_cancellation", "final value, rise and settling time",
                  {cancelled.final_value, cancelled.rise_time, cancelled.settling_time},
                  {by_hand.final_value, by_hand.rise_time, by_hand.settling_time}, 16, 1e-6);

  // (s + c)/(s^2/w + s + c) with a fast and a slow pole: closed form.
  const auto both = control::step_characteristics(system_called(cases, "pc440_fast_plus_slow"));
  const double w = 106700.0 / 10.67, c = 57910.0 / 106700.0;
  const double fast = 0.5 * (w + std::sqrt(w * w - 4.0 * w * c)), slow = w * c / fast;
  const double near = w * (slow - c) / (slow * (slow - fast));
  section.number("pc440_fast_plus_slow", "rise time", both.rise_time,
                 reaches(0.9, slow, fast, near) - reaches(0.1, slow, fast, near), 16, 1e-6);
  section.number("pc440_fast_plus_slow", "settling time", both.settling_time,
                 reaches(0.98, slow, fast, near), 16, 1e-6);
}

}  // namespace

AccuracySection step_accuracy() {
  AccuracySection section(
      "Step characteristics",
      "`values/step_info.json`: the documentation of MATLAB and issues of python-control, "
      "recomputed. Published values rest on coarse time grids and are off by up to two percent; "
      "the "
      "recomputed peak times rest on one of 5e-5 s (that ours are right is shown by the slope, in "
      "tests/control/analysis/step_characteristics_test.cpp).");
  const auto file = reference_values("step_info");
  for (const auto& entry : file.at("cases")) {
    const std::string name = entry.at("id");
    const auto step = control::step_characteristics(system_of(entry.at("system")));
    if (entry.contains("verified")) {
      const auto& verified = entry.at("verified");
      const double peak_time = verified.at("PeakTime");
      section.number(name, "peak time", step.peak_time, peak_time, 5, grid / peak_time);
      for (const auto& [key, quantity, value] : quantities_of(step)) {
        if (verified.contains(key))
          section.number(name, quantity, value, verified.at(key), 8, 1e-6);
      }
    }
  }
  degenerate_rows(section, file.at("cases"));
  return section;
}

}  // namespace boresight::reference
