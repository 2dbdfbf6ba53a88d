#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/io/case/friction_leeway.hpp>

namespace boresight::app {
void check_friction_curve_tests(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionCurveEntry& curve = numbers.antenna.friction_curve;
  const auto rate = io::loose_stribeck_rate(curve);
  if (!rate) return;
  std::string most;
  if (rate->moved_most_by) {
    const io::SteadyFrictionTest& test = curve.tests[*rate->moved_most_by];
    most = fmt::format(", moved most by friction_curve.test[{}] of {:.4g} N.m at {:.4g} rad/s",
                       *rate->moved_most_by, test.torque, test.rate);
  }
  found.push_back(
      {"friction tests",
       "friction_curve.test",
       fmt::format("The curve has as many unknowns as the {} tests that it goes through, so that "
                   "nothing is left to check it by. {} the motors' Stribeck rate, {:.3g} rad/s by "
                   "the torques as they stand, is {}{}. Hunting and reversals hang on that rate: "
                   "more tests at low rates settle it.",
                   curve.tests.size(), io::moved_torques(), curve.stribeck_rate.value,
                   io::in_words(*rate, "rad/s"), most),
       {{"Stribeck rate", curve.stribeck_rate.value, "rad/s"},
        {"least Stribeck rate", rate->least, "rad/s"},
        {"largest Stribeck rate", rate->largest, "rad/s"}}});
}

}  // namespace boresight::app
