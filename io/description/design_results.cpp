#include <algorithm>
#include <map>

#include <boresight/io/description/design_results.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm positive{.minimum = 0.0};

// One cut of the loop: the certified peak of its sensitivity, and its margins.
struct DesignBreak {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  control::PeakGain peak;
  control::Margins margins;
};

KeyUnit gain_unit(const std::string& unit) {
  static const std::map<std::string, std::string_view> suffixes{{"1", "1"},
                                                                {"rad", "rad"},
                                                                {"1/s", "per_s"},
                                                                {"rad/s", "rad_per_s"},
                                                                {"rad/(s.N.m)", "rad_per_s_N_m"},
                                                                {"rad/(N.m)", "rad_per_N_m"}};
  return {.suffix = suffixes.at(unit)};
}

// Those of the usual structures; a structure of the case's own has others, a state space none.
void describe_usual_gains(Visitor& v) {
  const NumberForm known{.above = 0.0, .finite = true};
  const auto gain = [&](std::string_view key, const KeyUnit& of, std::string_view meaning) {
    v.number(key, 0.0, of, meaning, known);
  };
  const KeyUnit& corner = unit::radian_per_second;
  v.members_if(false, [&] {
    gain("rate_gain", unit::ratio, "kr");
    gain("position_gain", unit::per_second, "kp");
    gain("rate_integral_corner", corner, "wi");
    gain("rate_lead_corner", corner, "wz; of a lead");
    gain("rate_lag_corner", corner, "wp; absent without lag");
    gain("notch_frequency", corner, "wn; of a notch");
    gain("notch_numerator_damping", unit::ratio, "zz; of a notch");
    gain("notch_denominator_damping", unit::ratio, "zp; of a notch");
    gain("pressure_feedback_gain", {.suffix = "rad_per_s_N_m"}, "kT; of pressure feedback");
    gain("pressure_washout_corner", corner, "wd; of pressure feedback");
    gain("position_integral_corner", corner, "wip");
    gain("position_integral_dead_zone", {.suffix = "rad"}, "dzp; of +D");
    gain("position_integral_freeze", {.suffix = "rad"}, "fzp; of +F");
    gain("compliance", {.suffix = "rad_per_N_m"}, "cs; of compliance compensation");
    gain("compliance_corner", corner, "wcs; of compliance compensation");
  });
}

void describe_gains(Visitor& v, const control::Controller& controller) {
  const auto describe_them = [&] {
    const auto& descriptions = control::gain_descriptions(controller.structure);
    for (std::size_t i = 0; i < controller.gains.size(); ++i) {
      std::string key = descriptions[i].name;
      std::ranges::replace(key, ' ', '_');
      v.number(key, controller.gains[i], gain_unit(descriptions[i].unit), descriptions[i].symbol);
    }
  };
  v.numbers_by_name(
      "^(rate|pressure|position|compliance|notch)_[a-z0-9_]+_"
      "(1|rad|rad_per_s|per_s|rad_per_s_N_m|rad_per_N_m)$",
      "A gain of a [[loop]] of the case.", [&] {
        if (v.by_example()) {
          describe_usual_gains(v);
        } else {
          describe_them();
        }
      });
}

void describe_breaks(Visitor& v, const design::Design& design) {
  std::vector<DesignBreak> breaks;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    breaks.push_back(
        {control::loop_breaks.at(b), design.verification.peaks.at(b), design.margins.at(b)});
  }
  v.list("loop_breaks", breaks, "The loop cut at each of three places.",
         [&](const DesignBreak& one) {
           describe_break(v, "loop_break", one.loop_break);
           v.number("sensitivity_peak", one.peak.upper, unit::ratio,
                    "No frequency has a larger sensitivity.", positive);
           v.number("sensitivity_peak_lower_bound", one.peak.lower, unit::ratio,
                    "Sensitivity at the frequency below.", positive);
           v.number("sensitivity_peak_frequency", one.peak.frequency, unit::hertz_of_radians,
                    "Where it is; null where it is only approached towards infinity.", positive);
           v.group("margins", "The smallest.", [&] {
             v.defined_as("margins", "Stability margins; null where there is none.");
             describe(v, one.margins);
           });
         },
         {.minimum = control::loop_breaks.size(), .maximum = control::loop_breaks.size()});
}

void describe_check(Visitor& v, const design::Verification& check) {
  v.number("rate_loop_abscissa", check.stability.rate_loop_abscissa, unit::per_second,
           "Largest real part of the eigenvalues, position loop open.");
  v.number("closed_loop_abscissa", check.stability.closed_loop_abscissa, unit::per_second,
           "Largest real part of the eigenvalues, all loops closed.");
  v.number("dead_time_residue", check.stability.dead_time_residue, unit::ratio,
           "What the rational dead time leaves out, of the return difference.", positive);
  v.number("lyapunov_to_spectral_rms", check.lyapunov.total / check.spectral_rms, unit::ratio,
           "Rms by Lyapunov equation over rms by spectrum.", positive);
}

}  // namespace

void describe(Visitor& v, const plant::PlantMode& mode) {
  v.defined_as("mode", "A mode of the plant.");
  v.text("description", mode.description, "What moves most.");
  v.number("frequency", mode.frequency, unit::hertz, "Magnitude of the pole.", positive);
  v.number("damping_ratio", mode.damping_ratio, unit::ratio,
           "Above 1 for two real poles given as one mode.");
  v.number("pole_real", mode.pole.real(), unit::radian_per_second, "Real part of the pole.");
  v.number("pole_imaginary", mode.pole.imag(), unit::radian_per_second,
           "Imaginary part of the pole.");
  v.number("participation", mode.participation, unit::ratio,
           "Fraction of the described part in the mode, 0 to 1.", positive);
  v.number("oil_fraction", mode.oil_fraction, unit::ratio,
           "d ln frequency^2/d ln oil stiffness; without damping the oil spring's fraction of the "
           "mode's elastic energy.");
  v.number("gear_fraction", mode.gear_fraction, unit::ratio, "The same of the gear spring.");
}

void describe(Visitor& v, const design::Design& design) {
  const auto& tuning = design.tuning;
  const auto& check = design.verification;
  v.defined_as("design", "One tuned and verified controller. Angles at the sky, one axis.");
  v.text("structure", control::to_string(tuning.controller.structure),
         "Loop structure, a usual one or the case's own.");
  v.flag("feasible", tuning.status == design::TuningStatus::optimal, "Every constraint is met.");
  v.flag("verified", check.passed,
         "Confirmed apart from the tuner: eigenvalues stable, peaks within goals, rms by Lyapunov "
         "equation and by spectrum within 0.5 %.");
  v.text_or_null("verification_failure", check.failure, "Why it is not verified; null if it is.");
  v.group("gains",
          "rate: kr (1 + wi/s)(1 + s/wz)/(1 + s/wp), pressure: kT s/(s + wd), position: kp (1 + "
          "wip/s), compliance: cs/(1 + s/wcs), notch; others of structures of the case's own; none "
          "of a state space.",
          [&] { describe_gains(v, tuning.controller); });
  v.number("boresight_rms", design.boresight_rms, unit::millidegree,
           "Boresight error in wind and sensor noise.", positive);
  v.number("wind_rms", design.wind_rms, unit::millidegree, "Its part by wind.", positive);
  v.number("noise_rms", design.noise_rms, unit::millidegree, "Its part by sensor noise.", positive);
  v.number("control_effort", design.control_effort, unit::radian_per_second,
           "Rms of the noise-driven valve command, as no-load motor rate.", positive);
  describe_breaks(v, design);
  v.object("hydraulic_mode", design.hydraulic_mode,
           "The lowest mode of the plant that moves the oil.");
  v.texts("active_constraints", tuning.active_constraints, "Goals that limit the design.");
  v.texts("gains_at_bound", tuning.gains_at_bound, "Gains at an end of the range searched.");
  v.number("worst_constraint", tuning.worst_constraint, unit::ratio,
           "Largest of value over goal; above 1 if infeasible.", positive);
  v.count("starts", tuning.starts, "Starting points of the search.");
  v.count("starts_at_optimum", tuning.starts_at_optimum, "Starts that ended at the best design.");
  v.count("evaluations", tuning.evaluations, "Evaluations of the loop.");
  v.group("verification", "The independent check.", [&] { describe_check(v, check); });
}

void describe(Visitor& v, const design::EnsembleResult& ensemble) {
  v.defined_as("ensemble", "A controller with fixed gains on the ensemble members.");
  v.count("stable", ensemble.stable, "Members on which the loop is stable.");
  v.count("within_constraints", ensemble.within_constraints, "Members that meet every constraint.");
  v.number("min_boresight_rms", ensemble.min_rms, unit::millidegree, "Of the stable members.");
  v.number("median_boresight_rms", ensemble.median_rms, unit::millidegree,
           "Of the stable members.");
  v.number("quantile_95_boresight_rms", ensemble.high_rms, unit::millidegree,
           "95 % of the stable members are below.");
  v.number("largest_boresight_rms", ensemble.largest_rms, unit::millidegree,
           "Of the stable members.");
  v.text("worst",
         ensemble.members.empty() ? std::string_view()
                                  : std::string_view(ensemble.members.at(ensemble.worst).name),
         "The member farthest from its goals.");
  v.list("members", ensemble.members, "One a plant.", [&](const design::MemberResult& member) {
    v.text("name", member.name, "Which sample.");
    v.flag("stable", member.stable, "By eigenvalues.");
    v.number("boresight_rms", member.boresight_rms, unit::millidegree, "Null if unstable.");
    v.numbers("sensitivity_peaks", member.sensitivity_peaks, unit::ratio,
              "Rate loop alone, valve command, position loop.");
    v.number("control_effort", member.control_effort, unit::radian_per_second, "Rms from noise.");
    v.number("worst_constraint", member.worst_constraint, unit::ratio,
             "Largest quantity over its goal; null if unstable.");
  });
}

}  // namespace boresight::io
