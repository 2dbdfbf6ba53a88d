#include <boresight/io/description/pointing_limit_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm positive{.least = 0.0};
constexpr double square_millidegree = unit::millidegree_in_radians * unit::millidegree_in_radians;

void describe_result(Visitor& v, const design::SampledResult& result) {
  v.defined_as("limit_result", "A controller on one plant.");
  v.text("plant", result.plant, "nominal, or the member's name.");
  v.flag("stable", result.stable(), "By the eigenvalues of the sampled closed loop.");
  v.number("spectral_radius", result.spectral_radius, unit::ratio,
           "Largest magnitude of a closed-loop eigenvalue.", positive);
  v.number("beam_rms", result.beam_rms, unit::millidegree,
           "Over all time, by the covariance of the closed loop; null if unstable.", positive);
  v.number("wind_rms", result.wind_rms, unit::millidegree, "The wind's part.", positive);
  v.number("noise_rms", result.noise_rms, unit::millidegree, "The sensors' part.", positive);
  v.number("valve_effort", result.valve_effort, unit::radian_per_second,
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
  v.number("worst_rms", design.worst_rms, unit::millidegree,
           "Largest beam rms of nominal and members; null without members or if one is unstable.",
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
  const auto& weights = lqg.weights;
  v.group("weights", "What the design was made to believe; beam rms in rad of motor.", [&] {
    v.number("command_weight", weights.command_weight, {.suffix = "s2"},
             "Cost of the command's mean square.", positive);
    v.number("input_noise", weights.input_noise, {.suffix = "rad2_per_s"},
             "Intensity of noise added to the command.", positive);
    v.number("spring_noise", weights.spring_noise, {.suffix = "rad2_s"},
             "Intensity of noise in what each spring feels of its deflection.", positive);
    v.number("spring_weight", weights.spring_weight, unit::ratio,
             "Cost of the deflections' mean square.", positive);
    v.number("friction_noise", weights.friction_noise, {.suffix = "N2_m2_s"},
             "Intensity of noise torque at the motor.", positive);
  });
}

void describe_law(Visitor& v, const design::LawAgainstLimit& law) {
  v.text("name", law.name, "Which.");
  v.group("design", "Sampled.", [&] { describe_defined_design(v, law.design); });
  v.number("least_rms", law.least_rms, unit::millidegree,
           "Lower bound at the law's own effort: root of the largest cost - weight effort^2 over "
           "the bound's points.",
           positive);
  v.number("to_least", law.to_least, unit::ratio, "Nominal beam rms over least_rms.", positive);
  v.number("to_margin_limited", law.to_margin_limited, unit::ratio,
           "Over the margin-limited LQG's.", positive);
  v.number("to_robustified", law.to_robustified, unit::ratio,
           "Over the robustified LQG's on the nominal plant.", positive);
  v.number("worst_to_robustified", law.worst_to_robustified, unit::ratio,
           "Worst rms over the robustified LQG's worst.", positive);
  v.number("to_encoder_held", law.to_encoder_held, unit::ratio, "Over encoder_held_rms.", positive);
  v.number("to_full_information", law.to_full_information, unit::ratio,
           "Over full_information_rms.", positive);
}

}  // namespace

void describe(Visitor& v, const design::PointingLimit& limit) {
  const auto described_lqg = [&](const design::LimitedLqg& lqg) { describe_lqg(v, lqg); };
  v.defined_as("limit",
               "Laws in their sampled form against the least any controller could do: every ratio "
               "follows from the numbers here.");
  v.number("sample_time", limit.sample_time, unit::second, "Of every controller here.",
           {.above = 0.0, .finite = true});
  v.number("computation_delay", limit.computation_delay, unit::second,
           "From a sample to its command.", {.least = 0.0, .finite = true});
  v.number("valve_effort_limit", limit.effort_limit, unit::radian_per_second, "Goal.",
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
  v.number("least_rms", limit.least_rms, unit::millidegree, "Lower bound at the effort limit.",
           positive);
  v.group("unconstrained", "The least of all, whatever its margins.",
          [&] { describe_defined_design(v, limit.unconstrained); });
  v.optional_group("margin_limited", limit.margin_limited,
                   "LQG that keeps the peak on the nominal plant: a benchmark.", described_lqg);
  v.optional_group("robustified", limit.robustified,
                   "LQG that keeps the goals on every member: a benchmark.", described_lqg);
  v.number("full_information_rms", limit.full_information_rms, unit::millidegree,
           "Least of any controller that knows the whole state at each sample, effort free.",
           positive);
  v.number("encoder_held_rms", limit.encoder_held_rms, unit::millidegree,
           "Flexure beyond the encoder: boresight rms with the encoder at rest.", positive);
  v.list("laws", limit.laws, "Each against the limits.",
         [&](const design::LawAgainstLimit& law) { describe_law(v, law); });
}

}  // namespace boresight::io
