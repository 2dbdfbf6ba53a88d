#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/wind_mast.hpp>

namespace boresight::app {
namespace {

std::string ratio_text(double ratio) {
  return ratio > 0.0 && std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : "undefined";
}

void conclude_masses(const IdentificationSection& section, std::vector<std::string>& sentences) {
  std::string text = "Mass properties give";
  bool first = true;
  for (const auto& method : section.inertia.methods) {
    if (method.kind != identification::MethodKind::mass_properties) continue;
    text += fmt::format("{} {:.3f} kg.m2", first ? "" : ";", method.reflected_inertia.value);
    if (section.pounds_force) {
      text += fmt::format(" ({:.3f} lbf.ft.s2)",
                          method.reflected_inertia.value / pound_foot_second_squared);
    }
    text +=
        fmt::format(" and R = {} ({})", ratio_text(method.motor_to_load_ratio.value), method.name);
    first = false;
  }
  sentences.push_back(text + ".");
}

// What the records say takes the place of the methods' own printed numbers.
void conclude_campaign(const io::CampaignSection& section,
                       const identification::GreyBoxResult& found,
                       std::vector<std::string>& sentences) {
  const auto& inertia = found.quantity("inertia").posterior;
  const auto& ratio = found.quantity("motor to load ratio").posterior;
  const auto& leakage = found.quantity("leakage rate").posterior;
  sentences.push_back(
      fmt::format("{} records together give a reflected inertia of {:.3f} kg.m2 (95 % interval "
                  "{:.3f} .. {:.3f}), R = {:.2f} ({:.2f} .. {:.2f}), and leakage of {:.3g} 1/s "
                  "({:.3g} .. {:.3g}); the plant below uses them.",
                  found.records.size(), inertia.value, inertia.lower, inertia.upper, ratio.value,
                  ratio.lower, ratio.upper, leakage.value, leakage.lower, leakage.upper));
  if (!section.contradictions.empty()) {
    sentences.push_back(fmt::format("They contradict {} of the case's stated numbers.",
                                    section.contradictions.size()));
  }
}

// The measured hydraulic frequency against the antenna's, and where they contradict each other what
// has to give way.
std::string resonance_text(const io::ResonanceVerdict& verdict,
                           const IdentificationSection& section) {
  if (!verdict.contradicts()) return resonance_sentence(verdict);
  std::string text = resonance_warning(verdict);
  for (const auto& method : section.inertia.methods) {
    const auto& left = method.antenna_remainder;
    const auto& needs = section.inertia.methods.front().antenna_remainder;
    const bool apart = left.upper < needs.lower || left.lower > needs.upper;
    if (method.kind != identification::MethodKind::resonance || !apart) continue;
    text += fmt::format(
        " If the antenna were rigid, {:.3g} Hz would imply an antenna inertia of {:.3f} to {:.3f} "
        "kg.m2; the mass properties give {:.3f} to {:.3f}.",
        verdict.measured, left.lower, left.upper, needs.lower, needs.upper);
  }
  return text +
         " Check the oil stiffness (bulk modulus, volumes, efficiencies), the masses and the "
         "reading of the resonance.";
}

void conclude_identification(const IdentificationSection& section,
                             const std::optional<io::ResonanceVerdict>& resonance,
                             std::vector<std::string>& sentences) {
  if (resonance) sentences.push_back(resonance_text(*resonance, section));
  const auto& methods = section.inertia.methods;
  const bool tested =
      std::any_of(methods.begin(), methods.end(), [](const identification::InertiaMethod& method) {
        return method.kind != identification::MethodKind::mass_properties;
      });
  conclude_masses(section, sentences);
  if (std::string unread = unread_resonance(resonance); !unread.empty()) {
    sentences.push_back(std::move(unread));
  }
  if (!tested) {
    sentences.emplace_back("Only mass properties give the inertia; no test confirms it.");
    return;
  }
  const auto by_inertia = [](const identification::InertiaMethod& x,
                             const identification::InertiaMethod& y) {
    return x.reflected_inertia.value < y.reflected_inertia.value;
  };
  const auto [minimum, maximum] = std::minmax_element(methods.begin(), methods.end(), by_inertia);
  const double ratio = minimum->motor_to_load_ratio.value;
  std::string text = fmt::format(
      "The methods put the reflected inertia between {:.3f} kg.m2 ({}) and {:.3f} ({}), and the "
      "motor-to-load ratio between {} and {}{}.",
      minimum->reflected_inertia.value, minimum->name, maximum->reflected_inertia.value,
      maximum->name, ratio_text(maximum->motor_to_load_ratio.value), ratio_text(ratio),
      rigid_resonance_remark(resonance, *minimum, *maximum));
  if (ratio > 2.0 && std::isfinite(ratio)) {
    // dR/R = -(1 + R) dJ/J
    text += fmt::format(
        " At R = {:.1f}, 1 % of inertia changes R by {:.1f} %: R is ill-conditioned here; compare "
        "inertias instead.",
        ratio, 1.0 + ratio);
  }
  sentences.push_back(std::move(text));
}

}  // namespace

std::vector<std::string> conclude(const Report& report) {
  std::vector<std::string> sentences;
  if (report.campaign && report.campaign->grey_box) {
    conclude_campaign(*report.campaign, *report.campaign->grey_box, sentences);
  } else if (report.identification) {
    conclude_identification(*report.identification, report.resonance, sentences);
  }
  if (report.tuning) {
    if (const auto& mast = report.tuning->wind_mast) sentences.push_back(conclude_mast(*mast));
    conclude_tuning(report, *report.tuning, sentences);
  }
  if (report.plant && report.plant->tracking_slope < 0.0) {
    sentences.push_back(
        fmt::format("At the tracking rate friction falls with the rate, by {:.3g} N.m.s/rad: the "
                    "drive may stick and slip. Linear plants use a slope of 0; {}",
                    -report.plant->tracking_slope,
                    report.time_domain ? "the simulation above includes it."
                                       : "add a [simulation] to include it."));
  }
  if (report.time_domain) sentences.push_back(conclude(*report.time_domain));
  if (report.matching) conclude_matching(report, *report.matching, sentences);
  if (report.tuning) {
    const auto& effects = report.tuning->input_effects;
    std::string first =
        measure_first(effects, report.tuning->design.boresight_rms, report.time_domain,
                      is_superseded(report.superseded, "friction_curve."));
    if (!first.empty()) sentences.push_back(std::move(first));
  }
  return sentences;
}

}  // namespace boresight::app
