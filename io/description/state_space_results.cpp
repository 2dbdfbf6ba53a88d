#include <boresight/io/description/state_space_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>

namespace boresight::io {

void describe(Visitor& v, const design::StateSpaceStudy& study) {
  namespace unit = key_units;
  v.defined_as("state_space_study",
               "A state-space controller instead of loops with gains: `refined` of `limit`, "
               "on the nonlinear antenna. linear_models has its matrices.");
  v.text("name", study.simulated.controller, "With its order.");
  v.word(
      "verdict", to_string(verdict(study)),
      {"incomplete", "limit_cycle", "unsettled", "better", "no_advantage"},
      "The first that applies: a run did not complete; a limit cycle beyond the allowed amplitude; "
      "not settled within the tightest budget after a slew; less rms than the loops, by more than "
      "a tie; none of these.");
  v.number("wind_speed", study.wind_speed, unit::metre_per_second, "Mean.", {.minimum = 0.0});
  v.object("runs", study.simulated.result, "Its runs, as those of the loops in `time_domain`.");
  v.object("expected_rms", study.simulated.rms, "Over the same records of wind as the loops'.");
  v.flag("limit_cycle_free", study.limit_cycle_free,
         "No limit cycle beyond the allowed amplitude.");
  v.optional_group("change", study.change,
                   "Of the simulated rms, limit cycle included, from the recommended loops to this "
                   "controller; null where a run did not complete.",
                   [&](const numerics::Interval& change) {
                     v.number("value", change.value, unit::ratio, "Relative.");
                     v.number("lower_95", change.lower, unit::ratio, "Lower end.");
                     v.number("upper_95", change.upper, unit::ratio, "Upper end.");
                   });
}

}  // namespace boresight::io
