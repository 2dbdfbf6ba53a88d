#include <boresight/io/description/loop_results.hpp>
#include <boresight/io/description/time_domain_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm positive{.minimum = 0.0};
constexpr NumberForm known{.minimum = 0.0, .finite = true};
constexpr std::string_view no_figures = "Why there are no figures; null if the run is complete.";

void describe_influence(Visitor& v, const design::InfluenceResult& one) {
  v.word("influence", to_string(one.influence),
         {"friction", "limits", "quantisation", "orifice", "gear"}, "What is switched off.");
  describe_status(v, one.status, "How the run without it ended.");
  v.number("boresight_rms_without", one.boresight_rms_without, unit::millidegree,
           "Of the run without it.", positive);
  v.number("difference", one.difference, unit::millidegree,
           "Rms of the whole loop less that without the influence.");
}

void describe_command_limit(Visitor& v, double fraction) {
  v.number("at_command_limit", fraction, unit::ratio,
           "Fraction of the samples at which the valve command is at its limit.", known);
}

void describe_rms(Visitor& v, const design::WindResult& wind) {
  v.number("boresight_rms", wind.boresight_rms, unit::millidegree, "About the mean, simulated.",
           positive);
}

void describe_prediction(Visitor& v, const design::WindResult& wind) {
  v.number("predicted_rms", wind.predicted_rms, unit::millidegree,
           "Of the linear plant, by the spectrum.", positive);
}

void describe_static_error(Visitor& v, const design::WindResult& wind) {
  v.number("static_error", wind.static_error, unit::millidegree,
           "Boresight error at rest in the mean wind, by the linear loop: static flexure included.",
           positive);
}

void describe_wind(Visitor& v, const design::WindResult& wind,
                   const design::NonlinearVerificationOptions& options) {
  describe_status(v, wind.status);
  v.text_or_null("message", wind.message, no_figures);
  v.number("duration", options.wind_duration, unit::second, "After settling.", known);
  v.count("seed", options.seeds.front(), "Of wind and noise.");
  describe_rms(v, wind);
  v.number("encoder_rms", wind.encoder_rms, unit::millidegree, "The same of the encoder.",
           positive);
  describe_prediction(v, wind);
  describe_static_error(v, wind);
  v.number("realisation_error", wind.realisation_error, unit::millidegree,
           "Rms of the linear loop on this record less the prediction.");
  v.number("sampling", wind.sampling, unit::millidegree,
           "Rms of the sampled linear loop less that of the continuous one.");
  v.list("influences", wind.influences,
         "What the linear design leaves out, each switched off alone.",
         [&](const design::InfluenceResult& one) { describe_influence(v, one); });
  v.number("interaction", wind.interaction, unit::millidegree,
           "What the influences do only together, and the rest of the nonlinear antenna.");
  describe_command_limit(v, wind.at_command_limit);
}

void describe_integrators(Visitor& v, const design::IntegratorAgreement& both) {
  describe_status(v, both.status,
                  "How the run in wind ended or, if that is complete, the run of CVODES.");
  v.text_or_null("message", both.message, no_figures);
  v.flag(
      "agree", design::agree(both),
      "Both runs are complete, and ratio, or else ratio_without_quantisation, is at most limit.");
  v.number("duration", both.duration, unit::second, "Compared, from the end of settling.", known);
  v.number("boresight_rms", both.collocation_rms, unit::millidegree,
           "About the mean, by exponential collocation, as the run in wind.", positive);
  v.number("cvodes_boresight_rms", both.cvodes_rms, unit::millidegree, "About the mean, by CVODES.",
           positive);
  v.number("difference_rms", both.difference_rms, unit::millidegree,
           "Of the difference between the boresight errors, sample by sample.", positive);
  v.number("ratio", both.ratio(), unit::ratio, "difference_rms over cvodes_boresight_rms.",
           positive);
  v.number(
      "ratio_without_quantisation", both.ratio_without_quantisation, unit::ratio,
      "The same with white noise instead of steps of encoder and tachometer; null unless ratio "
      "exceeds its limit, or if such a run did not complete.",
      positive);
  v.number("limit", design::integrator_agreement_limit, unit::ratio, "Of ratio.", known);
  v.number("cvodes_relative_tolerance", both.cvodes_relative_tolerance, unit::ratio,
           "Of each step of CVODES.", known);
  v.number("cvodes_absolute_tolerance", both.cvodes_absolute_tolerance, {.suffix = "si"},
           "The same for states near 0, each in its unit (rad, rad/s, N m).", known);
  v.count("steps", both.collocation_steps, "Of the exponential collocation, settling included.");
  v.count("cvodes_steps", both.cvodes_steps, "Of CVODES, settling included.");
}

void describe_limit_cycles(Visitor& v, const std::vector<design::LimitCycleResult>& limit_cycles) {
  v.list("limit_cycles", limit_cycles,
         "Without wind and noise: at rest, then at the tracking rate.",
         [&](const design::LimitCycleResult& one) {
           v.defined_as("limit_cycle", "What the loop does by itself at one steady rate.");
           describe(v, one, LimitCycleDetail::full);
         });
}

void describe_other_friction(Visitor& v, const std::vector<design::LimitCyclesWithFriction>& runs) {
  v.list("limit_cycles_by_friction", runs,
         "Limit cycles with friction that differs from what is stated, without wind and noise, "
         "confirmed by longer runs: each friction at rest, then at the tracking rate.",
         [&](const design::LimitCyclesWithFriction& one) {
           v.text("friction", one.friction, "What differs.");
           v.number("rate", one.rate, unit::millidegree_per_second, "Of the command.", known);
           v.count("starts", one.starts, "Runs, each from another initial step.");
           v.count("starts_with_limit_cycle", one.limit_cycles,
                   "Of these runs, that end in one or did not complete.");
           v.number("encoder_amplitude", one.encoder_amplitude, unit::millidegree,
                    "Half of peak to peak, the largest; null if a run did not complete.", positive);
         });
}

void describe_predicted(Visitor& v, const std::optional<design::PredictedLimitCycle>& predicted) {
  v.optional_group(
      "predicted_limit_cycle", predicted,
      "The largest at rest, above half an encoder step, by simulation of a reduced antenna or else "
      "by describing functions; null for none, and where limit_cycles_by_friction is empty.",
      [&](const design::PredictedLimitCycle& one) {
        v.defined_as("predicted_limit_cycle", "An estimate; no verdict rests on it.");
        v.flag(
            "confirmed", one.confirmed,
            "By simulation of a reduced antenna; otherwise by describing functions alone, of which "
            "most do not arise.");
        v.number("frequency", one.frequency, unit::hertz,
                 "Of the oscillation; 0 for a confirmed one of fewer than two periods in 100 s.",
                 known);
        v.number("encoder_amplitude", one.encoder_amplitude, unit::millidegree,
                 "Half of peak to peak.", known);
        v.number("boresight_amplitude", one.boresight_amplitude, unit::millidegree, "The same.",
                 known);
      });
}

void describe_reversal(Visitor& v, const std::optional<design::ReversalResult>& reversal) {
  v.optional_group(
      "reversal", reversal, "Slow reversals; null without a tracking rate.",
      [&](const design::ReversalResult& one) {
        v.defined_as("reversal", "A slow triangle of the tracking rate.");
        describe_status(v, one.status);
        v.text_or_null("message", one.message, no_figures);
        v.number("encoder_error", one.encoder_error, unit::millidegree, "Largest after a reversal.",
                 positive);
        v.number("boresight_error", one.boresight_error, unit::millidegree,
                 "Largest after a reversal, about the mean.", positive);
        v.number("encoder_error_without_friction", one.encoder_error_without_friction,
                 unit::millidegree, "What a loop without friction has too.", positive);
        v.number("boresight_error_without_friction_feedforward",
                 one.boresight_error_without_friction_feedforward, unit::millidegree,
                 "boresight_error of a run without friction feedforward; null if it was not made.",
                 positive);
        v.number("time_of_largest", one.time_of_largest, unit::second,
                 "From the reversal to the largest error of the encoder.", positive);
      });
}

void describe_feedforward(Visitor& v, const control::Feedforward& forward, double fraction) {
  constexpr NumberForm finite{.finite = true};
  v.number("rate_to_rate_command", forward.rate_to_rate_command, unit::ratio,
           "Times the commanded rate.", finite);
  v.number("acceleration_to_rate_command", forward.acceleration_to_rate_command, unit::second,
           "Times the commanded acceleration.", finite);
  v.number("rate_to_valve_command", forward.rate_to_valve_command, unit::ratio,
           "Times the commanded rate.", finite);
  v.number("acceleration_to_valve_command", forward.acceleration_to_valve_command, unit::second,
           "Times the commanded acceleration.", finite);
  v.number("friction_to_valve_command", forward.friction_to_valve_command,
           {.suffix = "rad_per_N_m_s"}, "Times the friction torque.", finite);
  v.number("friction_change_to_valve_command", forward.friction_change_to_valve_command,
           {.suffix = "rad_per_N_m"}, "Times the friction torque's rate of change.", finite);
  v.number("rate_to_motor_torque", forward.rate_to_motor_torque, {.suffix = "N_m_s_per_rad"},
           "Times the commanded rate: torque of the motion.", finite);
  v.number("acceleration_to_motor_torque", forward.acceleration_to_motor_torque,
           {.suffix = "kg_m2"}, "Times the commanded acceleration: torque of the motion.", finite);
  v.number("supply_torque", forward.supply_torque, unit::newton_metre,
           "The valve command's feedforward is divided by sqrt(1 - T/supply_torque), T the torque "
           "of motion and friction against the flow, at most 0.9 of this.",
           positive);
  v.number("friction_fraction", fraction, unit::ratio,
           "Of the simulated friction torque; the rest is its mismatch.", known);
  v.group(
      "friction_torque",
      "Friction torque Tf at the commanded rate w of the next sample, 0 at rest: that fraction "
      "of the friction curve. A controller that reads the motor torque reads it less Tf.",
      [&] {
        const plant::FrictionCurve& curve = forward.friction;
        v.number("coulomb", curve.coulomb_torque, unit::newton_metre, "Tc.", finite);
        v.number("breakaway", curve.breakaway_torque, unit::newton_metre, "Ts.", finite);
        v.number("stribeck_rate", curve.stribeck_rate, unit::radian_per_second, "ws.", finite);
        v.number("saturating", curve.saturating_torque, unit::newton_metre, "Th.", finite);
        v.number("saturating_rate", curve.saturating_rate, unit::radian_per_second, "wh.", finite);
        v.number("viscous", curve.viscous_friction, {.suffix = "N_m_s_per_rad"},
                 "Bv: Tf = Tc + (Ts - Tc) exp(-(w/ws)^2) + Th (1 - exp(-w/wh)) + Bv w.", finite);
      });
}

void describe_slew(Visitor& v, const std::optional<design::SlewResult>& slew,
                   double settled_error) {
  constexpr double degree = unit::degree.divisor;
  v.optional_group(
      "slew", slew, "Slew and acquisition; null if there is none.",
      [&](const design::SlewResult& one) {
        v.defined_as("slew", "A move from rest to rest, in still air.");
        describe_status(v, one.status);
        v.text_or_null("message", one.message, no_figures);
        v.number("distance", one.distance, unit::degree, "Of the antenna.", {.finite = true});
        v.number("rate_limit", one.limits.rate, {.suffix = "deg_per_s", .divisor = degree},
                 "That the command keeps.", positive);
        v.number("acceleration_limit", one.limits.acceleration,
                 {.suffix = "deg_per_s2", .divisor = degree}, "That the command keeps.");
        v.flag("limits_achievable", one.achievable_limits,
               "The drive can do the limits asked for; otherwise the limits are what it can do.");
        v.number("command_time", one.command_time, unit::second, "Of the move commanded.",
                 positive);
        v.number("largest_error", one.largest_error, unit::millidegree,
                 "Of the encoder, during the move.", positive);
        v.number("overshoot", one.overshoot, unit::millidegree, "Beyond the target.", positive);
        v.number("settled_error", settled_error, unit::millidegree,
                 "Within which the move counts as settled.", positive);
        v.number("settling_time", one.settling_time, unit::second,
                 "From the end of the command; null if the move was not seen to settle.", positive);
        describe_command_limit(v, one.at_command_limit);
      });
}

}  // namespace

void describe(Visitor& v, const design::TimeDomainStudy& study) {
  const design::NonlinearVerification& result = study.result;
  const double settled_error = study.options.settled_error;
  v.defined_as("time_domain",
               "The best tuned controller in the time domain, on the nonlinear antenna.");
  v.text("controller", study.controller, "Its name.");
  v.number("wind_speed", study.wind_speed, unit::metre_per_second, "Mean.", known);
  v.number("sample_time", study.sample_time, unit::second, "Of the controller.", known);
  v.number("encoder_resolution", study.encoder_resolution, unit::millidegree,
           "Steps of the encoder: those whose rounding error is its noise.", known);
  v.number("allowed_limit_cycle", study.options.allowed_limit_cycle, unit::millidegree,
           "Boresight amplitude of the largest limit cycle that does not exclude a controller.",
           known);
  v.group("feedforward",
          "From the commanded motion to the controller's commands, at the motor shaft.",
          [&] { describe_feedforward(v, study.feedforward, study.friction_feedforward); });
  v.group("wind",
          "In wind, against the linear prediction: boresight_rms is the sum of predicted_rms, "
          "realisation_error, sampling, all differences and interaction.",
          [&] { describe_wind(v, result.wind, study.options); });
  v.object("expected_rms", study.rms,
           "Over records of wind of that length; null if there was but one.");
  v.optional_group(
      "integrators", result.integrators,
      "The run in wind by a second integrator, CVODES, on the same equations; null if it was not "
      "repeated.",
      [&](const design::IntegratorAgreement& both) { describe_integrators(v, both); });
  describe_limit_cycles(v, result.limit_cycles);
  describe_other_friction(v, study.limit_cycles_by_friction);
  describe_predicted(v, study.predicted_limit_cycle);
  describe_reversal(v, result.reversal);
  describe_slew(v, result.slew, settled_error);
  v.list("candidates", study.candidates,
         "The controllers that this one was chosen from by the least simulated rms, limit cycle "
         "included, itself among them; empty where there was no choice.",
         [&](const design::TimeDomainStudy::Candidate& one) {
           v.text("controller", one.controller, "Its name.");
           describe_status(v, one.result.wind.status, "How its run in wind ended.");
           describe_rms(v, one.result.wind);
           v.object("expected_rms", one.rms,
                    "Over several records of wind; null if there was but one.");
           describe_prediction(v, one.result.wind);
           describe_limit_cycles(v, one.result.limit_cycles);
           describe_reversal(v, one.result.reversal);
           describe_slew(v, one.result.slew, settled_error);
         });
}

void describe(Visitor& v, const design::NonlinearVerification& run) {
  v.defined_as("compared_run", "A controller on the nonlinear antenna, compared with others.");
  describe_status(v, run.wind.status, "How the run in wind ended.");
  v.text_or_null("message", run.wind.message, no_figures);
  describe_rms(v, run.wind);
  describe_prediction(v, run.wind);
  describe_static_error(v, run.wind);
  describe_limit_cycles(v, run.limit_cycles);
  describe_reversal(v, run.reversal);
}

void describe(Visitor& v, const design::SimulatedRms& found) {
  v.defined_as("simulated_rms", "Boresight rms over several records of wind.");
  describe_status(v, found.status, "How the worst of the runs ended.");
  v.count("records", found.records, "On the nonlinear antenna.");
  v.count("winds", found.winds, "Those and further ones, through the linear loop's response.");
  v.number("rms", found.rms.value, unit::millidegree, "Root of the expected mean square.",
           positive);
  v.number("lower", found.rms.lower, unit::millidegree, "End of the 95 % interval.", positive);
  v.number("upper", found.rms.upper, unit::millidegree, "End of the 95 % interval.", positive);
}

void describe(Visitor& v, const design::NonlinearEffect& effect) {
  v.defined_as("nonlinear_effect",
               "What a simulation adds to linear rms: sqrt((factor linear)^2 + amplitude^2 / 2).");
  v.number("factor", effect.factor, unit::ratio,
           "Simulated over linear rms in wind; 1 without a simulation, null if a run was lost.",
           positive);
  v.number("limit_cycle_amplitude", effect.amplitude, unit::millidegree,
           "Half of peak to peak of the boresight, at rest or tracking.", known);
}

}  // namespace boresight::io
