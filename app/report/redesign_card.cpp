#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/interpretation_verdicts.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/redesign/next_test.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/margins_line.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/decisions/confidence.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using design::Confidence;
using design::Doubt;

// How the headings of the sections begin.
constexpr std::string_view loops = "Tuned loops";
constexpr std::string_view in_time = "In the time domain";
constexpr std::string_view matching = "Inertia matching";
constexpr std::string_view inertia = "Inertia at the motor shaft";
constexpr std::string_view audited = "Audit";
constexpr std::string_view inputs = "Assumed inputs";

std::string mdeg(double angle) {
  return fmt::format("{:.3f}", angle / millidegree);
}

bool simulated(const Report& report) {
  return report.time_domain && std::isfinite(report.time_domain->result.wind.boresight_rms);
}

// None without a whole set of records.
const design::SimulatedRms* expected_rms(const Report& report) {
  if (!simulated(report) || !report.time_domain->rms) return nullptr;
  const auto& expected = *report.time_domain->rms;
  return std::isfinite(expected.rms.value) ? &expected : nullptr;
}

bool inertias_agree(const Report& report) {
  if (report.campaign) return report.campaign->contradiction.empty();
  return !report.identification || !report.identification->combined ||
         !report.identification->combined->contradictory();
}

// As designed_antenna takes it.
design::PlantBasis plant_basis(const Report& report) {
  if (!report.campaign) return design::PlantBasis::drawings;
  return report.campaign->grey_box ? design::PlantBasis::records : design::PlantBasis::failed_fit;
}

std::size_t members_beyond_constraints(const TuningSection& section) {
  if (!section.ensemble) return 0;
  return section.ensemble->members.size() -
         static_cast<std::size_t>(section.ensemble->within_constraints);
}

design::ConfidenceGrade confidence(const Report& report, const TuningSection& section) {
  design::Evidence evidence;
  evidence.fitness = section.fitness;
  evidence.simulated = simulated(report);
  evidence.plant = plant_basis(report);
  const bool unstable_samples = section.instability && section.instability->value > 0.0;
  evidence.constraints_met_on_members =
      members_beyond_constraints(section) == 0 && !unstable_samples;
  evidence.inertias_agree = inertias_agree(report);
  evidence.resonance_agrees = !report.resonance || !report.resonance->contradicts();
  evidence.verdict_depends_on_interpretation =
      !other_interpretations_text(report, section).empty() ||
      !other_attitudes_text(report, section).empty() ||
      !guessed_fractions_text(report, section).empty();
  if (!section.input_effects.empty()) {
    evidence.largest_effect = section.input_effects.front().change(section.design.boresight_rms);
  }
  return design::grade(evidence);
}

std::string_view reason(Doubt doubt) {
  switch (doubt) {
    case Doubt::not_verified:
      return "no controller meets the constraints";
    case Doubt::not_robust:
      return "constraints violated on some models";
    case Doubt::not_simulated:
      return "not shown on the nonlinear antenna";
    case Doubt::limit_cycle:
      return "limit cycle beyond the allowed amplitude, or not shown";
    case Doubt::inertias_disagree:
      return "inertia estimates contradict";
    case Doubt::resonance_disagrees:
      return "resonance contradicts the plant";
    case Doubt::interpretation_decides:
      return "assumed inputs decide";
    case Doubt::fit_failed:
      return "no model fits the records";
    case Doubt::plant_not_identified:
      return "no records";
    case Doubt::input_decides:
      return "one input moves the rms by over 20 %";
  }
  return "";
}

// Of a controller that meets its constraints on the plant of the case.
std::string_view deficiency(design::Fitness fitness) {
  switch (fitness) {
    case design::Fitness::misses_budget:
      return ", misses a required budget";
    case design::Fitness::misses_member:
      return ", violates constraints on some models";
    case design::Fitness::not_shown:
      return ", not shown to be free of limit cycles";
    case design::Fitness::limit_cycle:
      return ", limit-cycles beyond the allowed amplitude";
    case design::Fitness::lost_in_wind:
      return ", lost in simulated wind";
    default:
      return "";
  }
}

CardLine controller_line(const Report& report, const TuningSection& section) {
  if (!section.design.usable()) {
    return {"Controller", "none: no controller found meets every constraint of the case",
            std::string(loops)};
  }
  const auto& controller = section.design.tuning.controller;
  const auto values = section.gain_units.texts(controller);
  std::vector<std::string> gains;
  for (std::size_t i = 0; i < values.size(); ++i) {
    gains.push_back(fmt::format("{} = {}", controller.structure.gains()[i].symbol, values[i]));
  }
  if (const auto* system = controller.structure.state_space()) {
    gains.push_back(fmt::format("{}, sampled every {:.3g} s, code: `boresight export`",
                                controller.structure.name(), system->sample_time));
  }
  const std::string beside =
      section.loops
          ? fmt::format(
                "; best loops {}, {} mdeg{}", section.loops->structure,
                mdeg(section.loops->simulated_rms.value_or(section.loops->design.boresight_rms)),
                section.loops->simulated_rms ? "" : " linear")
          : "";
  const bool fit = section.fitness == design::Fitness::fit;
  const bool sure = confidence(report, section).grade != Confidence::low;
  return {!fit    ? "Do not load"
          : !sure ? "Recommended"
                  : "Load",
          fmt::format("{} ({}{}): {}{}", section.name, to_string(section.tuned_for),
                      deficiency(section.fitness), fmt::join(gains, ", "), beside),
          std::string(loops)};
}

std::string upper_end(double rms) {
  return std::isfinite(rms) ? mdeg(rms) : "unstable";
}

// " (95 % 0.410 to 0.425 over 10 winds; inputs 0.195 to 0.558, 1 sigma)": behind the rms what it is
// uncertain by.
std::string uncertainty_text(const Report& report, const TuningSection& section,
                             const design::RmsRange& range) {
  std::vector<std::string> parts;
  if (const design::SimulatedRms* expected = expected_rms(report)) {
    parts.push_back(fmt::format("95 % {} to {} over {} winds", mdeg(expected->rms.lower),
                                mdeg(expected->rms.upper), expected->records));
  } else if (simulated(report)) {
    parts.emplace_back("one record");
  }
  if (!section.input_effects.empty()) {
    parts.push_back(
        fmt::format("inputs {} to {}, 1 sigma", mdeg(range.lower), upper_end(range.upper)));
  }
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, "; "));
}

CardLine pointing_line(const Report& report, const TuningSection& section) {
  const auto tightest = std::ranges::min_element(
      section.budgets, {}, [](const BudgetResult& one) { return one.budget.rms; });
  const auto range = combined_range(section.input_effects, section.design.boresight_rms);
  const design::SimulatedRms* expected = expected_rms(report);
  std::string text =
      simulated(report)
          ? fmt::format("{} mdeg rms at {:.3g} m/s, simulated",
                        mdeg(expected != nullptr ? expected->rms.value
                                                 : report.time_domain->result.wind.boresight_rms),
                        report.time_domain->wind_speed)
          : fmt::format("{} mdeg rms at {:.3g} m/s, linear plant, not simulated",
                        mdeg(section.design.boresight_rms), section.design_speed);
  text += uncertainty_text(report, section, range);
  if (section.effect.amplitude > 0.0 && std::isfinite(section.effect.factor)) {
    text += fmt::format("; {} with limit cycle",
                        mdeg(section.effect.rms(section.design.boresight_rms)));
  }
  if (tightest != section.budgets.end()) {
    const bool met = tightest->wind_speed_limit >= section.design_speed;
    const bool sure = design::within_budget(section.effect.rms(range.upper), tightest->budget.rms);
    text += fmt::format("; budget {}, {}", mdeg(tightest->budget.rms),
                        !met    ? "MISSED"
                        : !sure ? "met nominally"
                                : "met");
  }
  if (!section.ties.empty()) {
    text += fmt::format("; a tie with {}", section.ties.front());
    if (section.ties.size() > 1) text += fmt::format(" and {} more", section.ties.size() - 1);
  }
  return {report.axis.name == "azimuth" ? "Cross-elevation" : "Error per axis", text,
          std::string(simulated(report) ? in_time : loops)};
}

// Both figures simulated, or both linear.
CardLine present_line(const Report& report, const TuningSection& section) {
  const auto line = [](std::string text) {
    return CardLine{"Gains of today", std::move(text), std::string(loops)};
  };
  if (section.present.empty()) {
    return line(section.is_retuned_present
                    ? fmt::format("not given; {} is the recommended controller",
                                  present_label(section.name, true))
                    : "not given ([gains]): no comparison");
  }
  const auto& present = section.present.front();
  if (present.design.tuning.status == design::TuningStatus::unstable) {
    return line(
        fmt::format("{}: unstable on the plant of the case; check the case", present.structure));
  }
  const design::SimulatedRms* expected = expected_rms(report);
  const bool in_wind = expected != nullptr && present.simulated_rms;
  return line(fmt::format("{} {} mdeg{}, recommended {}, {}",
                          present.retuned ? "not given; " + present_label(present.structure, true)
                                          : present.structure + ":",
                          mdeg(in_wind ? *present.simulated_rms : present.design.boresight_rms),
                          present.design.verification.passed ? "" : " (constraints violated)",
                          mdeg(in_wind ? expected->rms.value : section.design.boresight_rms),
                          in_wind ? "simulated" : "linear plant"));
}

// How much of the budgets a card has room for.
struct BudgetDetail {
  std::size_t shown = 3;
  bool named = true;
};

// Those that matter first: required ones before others, the tightest before wider ones. The
// probability of the first. Simulated or linear as the error is.
CardLine budget_line(const TuningSection& section, const BudgetDetail& detail) {
  std::vector<BudgetResult> order = section.budgets;
  std::ranges::stable_sort(order, {}, [](const BudgetResult& one) {
    return std::pair(!one.budget.wind_speed.has_value(), one.budget.rms);
  });
  if (order.size() > detail.shown) order.resize(detail.shown);
  std::vector<std::string> budgets;
  for (const auto& result : order) {
    const double reached = reached_wind_speed(section, result);
    std::string text = fmt::format("{} {}{} {}", result.budget.band, mdeg(result.budget.rms),
                                   detail.named ? fmt::format(" ({})", result.budget.name) : "",
                                   !(reached > 0.0)         ? std::string("in no wind")
                                   : std::isfinite(reached) ? fmt::format("to {:.1f} m/s", reached)
                                                            : std::string("in every wind"));
    const auto& needed = result.budget.wind_speed;
    if (needed) text += fmt::format(" (required {:.3g})", *needed);
    if (budgets.empty() && result.probability) {
      text += fmt::format(", probability {:.3f} ({:.3f} to {:.3f}) at {:.3g} m/s",
                          result.probability->value, result.probability->lower,
                          result.probability->upper, needed.value_or(section.design_speed));
    }
    budgets.push_back(std::move(text));
  }
  return {"Budgets (mdeg)",
          budgets.empty() ? "the case states none ([[pointing.budget]])"
                          : fmt::format("{}", fmt::join(budgets, "; ")),
          std::string(loops)};
}

CardLine limit_cycle_line(const TimeDomainSection& section) {
  std::vector<std::string> parts;
  for (const auto& run : section.result.limit_cycles) {
    const std::string at = run.rate == 0.0 ? "at rest" : "while tracking";
    if (run.status != design::RunStatus::complete) {
      parts.push_back("not shown " + at);
    } else if (run.limit_cycle) {
      parts.push_back(fmt::format("+-{:.2f} mdeg {}", run.boresight_amplitude / millidegree, at));
    } else {
      parts.push_back("none " + at);
    }
  }
  std::string text = fmt::format("{}", fmt::join(parts, ", "));
  if (!limit_cycle_remark(section).empty()) text += ": BEYOND the allowed amplitude";
  if (const auto& reversal = section.result.reversal;
      reversal && reversal->status == design::RunStatus::complete) {
    text += fmt::format("; reversal peak {:.1f} mdeg", reversal->boresight_error / millidegree);
  }
  return {"Limit cycle", text, std::string(in_time)};
}

CardLine flywheel_line(const MatchingSection& section) {
  const std::string evidence(matching);
  if (section.rows.size() < 2) return {"Flywheels", "not compared", evidence};
  const MatchingVerdict verdict(section);
  if (verdict.unusable() > 0) {
    return {"Flywheels", "no verdict: constraints are missed at some inertias", evidence};
  }
  const MatchingSeries& series = section.series.front();
  const std::size_t end = verdict.better_end(), built = verdict.built();
  const auto at = [&](const MatchingSeries& one, std::size_t row) {
    return mdeg(one.designs[row].boresight_rms);
  };
  // Tuned on the nominal plant at each inertia, not robustly.
  const std::string text = fmt::format(
      "{}, linear: {} mdeg at {} as built, {} at {}", control::short_name(series.structure),
      at(series, built), section.rows[built].label, at(series, end), section.rows[end].label);
  const bool better = verdict.change(series, end) < -negligible_change;
  if (verdict.flat() || (!better && !verdict.friction_decides())) {
    return {"Flywheels", "keep; " + text, evidence};
  }
  if (const MatchingSeries* other = verdict.other_friction();
      other != nullptr && verdict.friction_decides()) {
    return {"Flywheels",
            fmt::format("keep until friction is known; {}; {} and {} with {}", text,
                        at(*other, built), at(*other, end), other->friction),
            evidence};
  }
  return {"Flywheels", fmt::format("change; {}; confirm by `boresight evaluate`", text), evidence};
}

// Contradictions to resolve first.
CardLine settle_line(const Report& report) {
  std::vector<std::string> open;
  std::string_view evidence = audited;
  if (report.resonance && report.resonance->contradicts()) {
    evidence = inertia;
    open.push_back(fmt::format("resonance {:.3g} Hz measured, {:.3g} Hz expected",
                               report.resonance->measured, report.resonance->expected));
  }
  if (!inertias_agree(report)) {
    evidence = inertia;
    std::string text = "reflected inertia";
    if (report.identification && !report.identification->inertia.methods.empty()) {
      const auto [minimum, maximum] =
          std::ranges::minmax(report.identification->inertia.methods, {},
                              [](const auto& method) { return method.reflected_inertia.value; });
      text += fmt::format(" {:.3f} to {:.3f} kg m2 by method", minimum.reflected_inertia.value,
                          maximum.reflected_inertia.value);
    }
    open.push_back(std::move(text));
  }
  if (report.campaign && io::rejection(*report.campaign) == io::Rejection::fit_failed) {
    evidence = inertia;
    open.emplace_back("no model fits the records: plant as the case states it");
  }
  const auto suspicions =
      report.campaign ? io::suspicions(*report.campaign) : std::vector<io::ChannelSuspicion>{};
  if (!suspicions.empty()) {
    evidence = inertia;
    open.push_back(fmt::format("{} in record '{}'", suspicions.front().finding,
                               suspicions.front().records.front()));
  }
  if (report.audit && !report.audit->findings.empty()) {
    open.push_back(fmt::format("{} of {} stated values inconsistent", report.audit->findings.size(),
                               report.audit->checked));
  }
  return {"Settle first", open.empty() ? "nothing" : fmt::format("{}", fmt::join(open, "; ")),
          std::string(evidence)};
}

CardLine test_line(const Report& report, const TuningSection& section) {
  const auto test =
      next_test(section.input_effects, section.design.boresight_rms, report.time_domain,
                is_superseded(report.superseded, "friction_curve."));
  if (!test) {
    return {"Next test", "none would change the result significantly", std::string(loops)};
  }
  if (test->key.empty()) {
    return {"Next test", test->test + ": friction decides the simulated rms", std::string(in_time)};
  }
  const auto& effect = section.input_effects.front();
  const std::vector<design::NumberEffect> alone{effect};
  const auto range = combined_range(alone, section.design.boresight_rms);
  return {"Next test",
          fmt::format("{}: rms {} to {} mdeg over {}", test->test, mdeg(range.lower),
                      upper_end(range.upper), test->quantity),
          std::string(loops)};
}

CardLine confidence_line(const Report& report, const TuningSection& section) {
  const auto found = confidence(report, section);
  std::vector<std::string_view> reasons;
  const auto doubted = [&](Doubt doubt) {
    return std::ranges::find(found.doubts, doubt) != found.doubts.end();
  };
  for (const Doubt doubt : found.doubts) {
    // Said with the one before it.
    if (doubt == Doubt::resonance_disagrees && doubted(Doubt::inertias_disagree)) continue;
    if (doubt == Doubt::input_decides && doubted(Doubt::interpretation_decides)) continue;
    const bool both = doubt == Doubt::inertias_disagree && doubted(Doubt::resonance_disagrees);
    reasons.push_back(both ? "inertias and resonance contradict" : reason(doubt));
  }
  std::string text(to_string(found.grade));
  if (!reasons.empty()) text += fmt::format(": {}", fmt::join(reasons, "; "));
  return {"Confidence", text, std::string(inputs)};
}

std::vector<CardLine> card_with_budgets(const Report& report, const BudgetDetail& budgets) {
  const TuningSection& section = *report.tuning;
  std::vector<CardLine> card{controller_line(report, section)};
  if (section.design.usable()) {
    card.push_back(pointing_line(report, section));
    card.push_back(present_line(report, section));
    card.push_back(budget_line(section, budgets));
    card.push_back(margins_line(report));
    if (report.time_domain) card.push_back(limit_cycle_line(*report.time_domain));
  }
  if (report.matching) card.push_back(flywheel_line(*report.matching));
  card.push_back(settle_line(report));
  card.push_back(test_line(report, section));
  card.push_back(confidence_line(report, section));
  return card;
}

}  // namespace

std::vector<CardLine> redesign_card(const Report& report) {
  if (!report.tuning) return {};
  // On one screen: of a controller of many gains fewer budgets are shown, or one without its name.
  constexpr std::ptrdiff_t max_lines = 16;
  constexpr std::array<BudgetDetail, 4> details{{{3, true}, {2, true}, {1, true}, {1, false}}};
  std::vector<CardLine> card;
  for (const auto& budgets : details) {
    card = card_with_budgets(report, budgets);
    // Behind a blank line.
    if (std::ranges::count(to_text(document_of(card)), '\n') <= 1 + max_lines) break;
  }
  return card;
}

Document document_of(const std::vector<CardLine>& card) {
  constexpr std::size_t width = 16;
  Lead lead;
  for (const auto& line : card) {
    lead.paragraphs.push_back({fmt::format("{} [{}]", line.text, line.evidence), "  ",
                               std::string(width, ' '), line.label});
  }
  return {{{std::move(lead)}}};
}

}  // namespace boresight::app
