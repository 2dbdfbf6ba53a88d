#include <boresight/io/description/pointing_limit_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm positive{.minimum = 0.0};
constexpr double square_millidegree = unit::millidegree_in_radians * unit::millidegree_in_radians;

void describe_result(Visitor& v, const design::SampledResult& result) {
  v.defined_as("limit_result", "A controller on one plant.");
  v.text("plant", result.plant, "nominal, or the member's name.");
  v.flag("stable", result.stable(), "By the eigenvalues of the sampled closed loop.");
  v.number("spectral_radius", result.spectral_radius, unit::ratio,
           "Largest magnitude of a closed-loop eigenvalue.", positive);
  v.number("boresight_rms", result.boresight_rms, unit::millidegree,
           "Over all time, by the covariance of the closed loop; null if unstable.", positive);
  v.number("wind_rms", result.wind_rms, unit::millidegree, "The wind's part.", positive);
  v.number("noise_rms", result.noise_rms, unit::millidegree, "The sensors' part.", positive);
  v.number("control_effort", result.control_effort, unit::radian_per_second,
           "Rms of the command from the sensors' noise.", positive);
  v.number("sensitivity_peak", result.peak.magnitude, unit::ratio,
           "Largest |S| at the valve command.", positive);
  v.number("sensitivity_peak_frequency", result.peak.frequency, unit::hertz_of_radians, "Where.",
           positive);
}

void describe_design(Visitor& v, const design::SampledDesign& design) {
  v.count("controller_states", design.controller.a.rows(), "Order of the controller.");
  v.group("nominal", "On the nominal plant.", [&] { describe_result(v, design.nominal); });
  v.count("stable_members", design.stable_members,
          "Members of the ensemble on which it is stable.");
  v.number(
      "worst_rms", design.worst_rms, unit::millidegree,
      "Largest boresight rms of nominal and members; null without members or if one is unstable.",
      positive);
  v.list("members", design.members, "The same controller on each member.",
         [&](const design::SampledResult& member) { describe_result(v, member); });
}

void describe_defined_design(Visitor& v, const design::SampledDesign& design) {
  v.defined_as("limit_design", "A sampled controller on the nominal plant and the ensemble.");
  describe_design(v, design);
}

void describe_lqg(Visitor& v, const design::LimitedLqg& lqg) {
  v.defined_as("limit_lqg", "An LQG controller, with what its design was made to believe.");
  describe_design(v, lqg.design);
  v.count("full_order", lqg.full_order, "Order of the LQG before any reduction.");
  const auto& weights = lqg.weights;
  v.group("weights", "What the design was made to believe; boresight rms in rad of motor.", [&] {
    v.number("command_weight", weights.command_weight, {.suffix = "s2"},
             "Cost of the command's mean square.", positive);
    v.number("input_noise", weights.input_noise, {.suffix = "rad2_per_s"},
             "Intensity of noise added to the command.", positive);
    v.number("spring_noise", weights.spring_noise, {.suffix = "rad2_s"},
             "Intensity of noise in what each spring feels of its deflection.", positive);
    v.number("spring_weight", weights.spring_weight, unit::ratio,
             "Cost of the deflections' mean square.", positive);
    v.number("friction_torque", weights.friction_torque, {.suffix = "N_m"},
             "Rms of the slow torque that stands for friction.", positive);
    v.number("friction_corner", weights.friction_corner, unit::radian_per_second,
             "Corner of that torque.", positive);
  });
}

void describe_controller(Visitor& v, const design::ControllerAgainstLimit& controller) {
  v.text("name", controller.name, "Which.");
  v.group("design", "Sampled.", [&] { describe_defined_design(v, controller.design); });
  v.number(
      "min_rms", controller.min_rms, unit::millidegree,
      "Lower bound at the controller's own effort: root of the largest cost - weight effort^2 over "
      "the bound's points.",
      positive);
  v.number("to_min", controller.to_min, unit::ratio, "Nominal boresight rms over min_rms.",
           positive);
  v.number("to_margin_limited", controller.to_margin_limited, unit::ratio,
           "Over the margin-limited LQG's.", positive);
  v.number("to_robustified", controller.to_robustified, unit::ratio,
           "Over the robustified LQG's on the nominal plant.", positive);
  v.number("worst_to_robustified", controller.worst_to_robustified, unit::ratio,
           "Worst rms over the robustified LQG's worst.", positive);
  v.number("to_flexure", controller.to_flexure, unit::ratio, "Over flexure_rms.", positive);
  v.number("to_full_information", controller.to_full_information, unit::ratio,
           "Over full_information_rms.", positive);
}

}  // namespace

void describe(Visitor& v, const design::PointingLimit& limit) {
  const auto described_lqg = [&](const design::LimitedLqg& lqg) { describe_lqg(v, lqg); };
  v.defined_as(
      "limit",
      "Controllers in their sampled form against the least any controller could do: every ratio "
      "follows from the numbers here.");
  v.number("sample_time", limit.sample_time, unit::second, "Of every controller here.",
           {.above = 0.0, .finite = true});
  v.number("computation_delay", limit.computation_delay, unit::second,
           "From a sample to its command.", {.minimum = 0.0, .finite = true});
  v.number("control_effort_limit", limit.effort_limit, unit::radian_per_second, "Goal.",
           {.above = 0.0, .finite = true});
  v.number("sensitivity_peak_limit", limit.peak_limit, unit::ratio, "Goal at the valve command.",
           {.above = 1.0, .finite = true});
  v.number("wind_filter_log_error", limit.wind_filter_log_error, unit::ratio,
           "Largest |ln| of the shaping filter's spectrum over the wind's in the fitted band.",
           positive);
  v.list("bound_points", limit.bound.points,
         "What bounds every linear controller: mean square >= cost - weight effort^2.",
         [&](const auto& point) {
           v.number("weight", point.weight,
                    {.suffix = "mdeg2_s2_per_rad2", .divisor = square_millidegree}, "Weight.",
                    positive);
           v.number("cost", point.cost, {.suffix = "mdeg2", .divisor = square_millidegree},
                    "Least cost.", positive);
         });
  v.number("min_rms", limit.min_rms, unit::millidegree, "Lower bound at the effort limit.",
           positive);
  v.group("unconstrained", "The least of all, whatever its margins.",
          [&] { describe_defined_design(v, limit.unconstrained); });
  v.optional_group("margin_limited", limit.margin_limited,
                   "LQG that keeps the peak on the nominal plant: a benchmark.", described_lqg);
  v.optional_group("robustified", limit.robustified,
                   "LQG that keeps the goals on every member: a benchmark.", described_lqg);
  v.optional_group(
      "refined", limit.refined,
      "State-space controller, by gradient within the constraints on every member; null without.",
      [&](const design::SampledDesign& design) { describe_defined_design(v, design); });
  v.text("refined_from", limit.refined_from, "Start of that search; empty without.");
  v.number("full_information_rms", limit.full_information_rms, unit::millidegree,
           "Least of any controller that knows the whole state at each sample, effort free.",
           positive);
  v.number("flexure_rms", limit.flexure_rms, unit::millidegree,
           "Flexure beyond the encoder: boresight rms with the encoder at rest.", positive);
  v.list("controllers", limit.controllers, "Each against the limits.",
         [&](const design::ControllerAgainstLimit& controller) {
           describe_controller(v, controller);
         });
}

}  // namespace boresight::io
