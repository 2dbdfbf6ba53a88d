#include <array>
#include <string_view>

#include <boresight/app/redesign/next_test.hpp>
#include <boresight/app/report/influences.hpp>

namespace boresight::app {
namespace {

constexpr std::string_view friction_test =
    "constant-speed runs at six rates, both ways (6 min of antenna time)";
constexpr std::string_view mode_shapes = "mode shapes from the structural model (no antenna time)";
constexpr std::string_view valve_steps =
    "valve steps about a constant speed (80 s of antenna time)";
constexpr std::string_view still_air =
    "encoder, tachometer and pressures at rest in still air (5 min of antenna time)";

// What the number's key contains, the test that measures it, and the number in words. The first
// that fits.
struct TestOfKey {
  std::string_view part, test, quantity;
};
constexpr std::array<TestOfKey, 14> tests{
    {{"wind_fraction", mode_shapes, "the modes' fractions of wind torque"},
     {"beam_weight", mode_shapes, "the modes' weights in the boresight angle"},
     {"structure.", "valve sine sweep, 0.1 to 8 Hz (2 min of antenna time)", "the structure"},
     {"locked_rotor", "valve sine sweep, 0.1 to 8 Hz, and one with the motors braked (4 min)",
      "the locked-rotor frequency"},
     {"friction", friction_test, "friction"},
     {"leakage", valve_steps, "leakage"},
     {"oil.", "sudden valve opening and closing with pressures recorded (10 s of antenna time)",
      "oil stiffness"},
     {"drive.", valve_steps, "the drive"},
     {"wind.", "encoder error and wind speed for an hour in wind; compare their spectra",
      "the wind model"},
     {"sensor", still_air, "sensor noise"},
     {"noise", still_air, "sensor noise"},
     {"controller.", "step of the valve command, read back by the computer (1 min)",
      "the loop's delay"},
     {"inertia", "fast triangle to the valve (82 s), beside constant-speed runs for friction",
      "inertia"},
     {"", "measure it, or obtain its source", ""}}};

}  // namespace

std::optional<NextTest> next_test(const std::vector<InputEffect>& effects, double rms,
                                  const std::optional<TimeDomainSection>& time_domain,
                                  bool friction_measured) {
  if (!effects.empty() && effects.front().change(rms) >= negligible_change) {
    const std::string& key = effects.front().quantity.key;
    for (const auto& one : tests) {
      if (key.find(one.part) == std::string::npos) continue;
      return NextTest{key, std::string(one.test),
                      one.quantity.empty() ? key : std::string(one.quantity)};
    }
  }
  if (!friction_measured && telling_friction(time_domain, rms) > 0.0)
    return NextTest{"", std::string(friction_test), "friction"};
  return std::nullopt;
}

}  // namespace boresight::app
