#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/matching_verdict.hpp>
#include <boresight/app/redesign/tuning_verdict.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/study_decision.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/tune_verdict.hpp>

namespace boresight::app {
namespace {

using Sentences = std::vector<std::string>;

std::string audited(const AuditReport& report) {
  const std::size_t departing = report.findings.size();
  if (departing > 0) {
    return fmt::format(
        "{} of {} printed numbers {} not follow from the others: mend those that move a headline "
        "result before designing on them.",
        departing, report.checked, departing == 1 ? "does" : "do");
  }
  const bool sound = report.implausible.empty();
  if (report.checked == 0) {
    return std::string("The case states no derived numbers to compare") +
           (sound ? ", and nothing in it is physically implausible." : ".");
  }
  return (report.checked == 1
              ? "The case's one printed number that can be compared agrees"
              : fmt::format("The case's {} printed numbers hang together", report.checked)) +
         (sound ? ": design on the case." : ".");
}

std::string assumptions(const std::vector<io::Quantity>& assumed) {
  const std::size_t count = count_of_antenna(assumed);
  if (count == 0) return "No number of the antenna is assumed.";
  return fmt::format(
      "{} numbers of the antenna are assumed, in value or in uncertainty: every number here stands "
      "on them until they are measured.",
      count);
}

Sentences audit_decision(const AuditReport& report) {
  Sentences sentences{audited(report)};
  const auto& findings = report.findings;
  const design::Finding* largest = nullptr;
  double change = 0.0;
  for (const auto& finding : findings) {
    for (const auto& consequence : finding.consequences) {
      if (std::abs(consequence.relative_change()) <= change) continue;
      change = std::abs(consequence.relative_change());
      largest = &finding;
    }
  }
  if (largest != nullptr) {
    sentences.push_back(fmt::format(
        "The one that moves a headline result most is {} '{}', by {:.3g} %.", largest->id,
        largest->forms.empty() ? std::string() : largest->forms.front().text, 100.0 * change));
  }
  if (!report.implausible.empty()) {
    sentences.push_back(fmt::format(
        "{}. {} before designing on the case.", failing_checks(report.implausible),
        report.implausible.size() == 1 ? "Explain or mend it" : "Explain or mend each"));
  }
  return sentences;
}

Sentences identify_decision(const Report& report) {
  Sentences sentences;
  if (report.campaign && report.campaign->grey_box) {
    const auto& found = *report.campaign->grey_box;
    const auto& inertia = found.quantity("inertia").posterior;
    const auto& ratio = found.quantity("motor to load ratio").posterior;
    sentences.push_back(fmt::format(
        "Design on a reflected inertia of {:.3f} kg m2 (95 % interval {:.3f} to {:.3f}) and a "
        "motor-to-load ratio of {:.2f} ({:.2f} to {:.2f}): {} records agree on them.",
        inertia.value, inertia.lower, inertia.upper, ratio.value, ratio.lower, ratio.upper,
        found.records.size()));
    if (const auto count = report.campaign->contradictions.size(); count > 0) {
      sentences.push_back(
          fmt::format("The records contradict {} of the numbers that the case states: correct "
                      "them there.",
                      count));
    }
    return sentences;
  }
  if (report.campaign && !report.campaign->contradiction.empty()) {
    sentences.push_back(report.campaign->contradiction);
  }
  if (report.identification) {
    const auto& methods = report.identification->inertia.methods;
    const auto [least, most] = std::ranges::minmax_element(
        methods, {}, [](const auto& m) { return m.reflected_inertia.value; });
    if (least != methods.end()) {
      sentences.push_back(fmt::format(
          "The methods put the reflected inertia between {:.3f} kg m2 ({}) and {:.3f} ({}).",
          least->reflected_inertia.value, least->name, most->reflected_inertia.value, most->name));
    }
  }
  return sentences;
}

Sentences model_decision(const PlantSection& plant) {
  Sentences sentences{fmt::format(
      "The loops must live with a hydraulic mode at {:.3g} Hz, damping ratio {:.2g}, and motors "
      "that carry {:.2f} times the inertia they drive.",
      plant.hydraulic.frequency, plant.hydraulic.damping_ratio, plant.motor_to_load_ratio)};
  if (plant.torque_for_wind > 0.0) {
    sentences.push_back(fmt::format(
        "The mean wind of the design takes {:.0f} % of what friction and offset leave of the "
        "supply's torque.",
        100.0 * std::abs(plant.mean_wind_torque) / plant.torque_for_wind));
  } else if (plant.supply_torque > 0.0) {
    sentences.emplace_back(
        "Friction at the tracking rate and offset take all of the supply's torque: none is left "
        "for the wind.");
  }
  return sentences;
}

Sentences redesign_decision(const Report& report) {
  Sentences sentences;
  if (report.resonance && report.resonance->contradicts()) {
    sentences.push_back(resonance_sentence(*report.resonance));
  }
  if (report.tuning)
    std::ranges::move(decide_tuning(report, *report.tuning), std::back_inserter(sentences));
  if (report.matching) {
    if (auto text = decide_matching(report, *report.matching); !text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences.empty() ? identify_decision(report) : sentences;
}

}  // namespace

std::vector<std::string> decision(const Report& report) {
  if (report.matched) return decision(*report.matched);
  if (report.evaluated) return decision(*report.evaluated);
  if (report.measured) {
    return {report.conclusions.begin(),
            report.conclusions.begin() +
                static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, report.conclusions.size()))};
  }
  if (report.tuned) {
    auto sentences = decision(*report.tuned, report.time_domain, report.limit);
    if (sentences.size() < 3) sentences.push_back(assumptions(report.assumed));
    return sentences;
  }
  Sentences sentences;
  if (report.command == "redesign") {
    sentences = redesign_decision(report);
  } else if (report.audit) {
    sentences = audit_decision(*report.audit);
  } else if (report.identification || report.campaign) {
    sentences = identify_decision(report);
  } else if (report.plant) {
    sentences = model_decision(*report.plant);
  }
  if (sentences.size() < 3 && report.command != "redesign" && report.command != "audit") {
    sentences.push_back(assumptions(report.assumed));
  }
  return sentences;
}

std::vector<std::string> reservations(const Report& report) {
  Sentences sentences;
  if (report.command != "redesign") {
    if (auto text = resonance_warning(report.resonance); !text.empty()) sentences = {text};
    if (!report.tuned) return sentences;
    const TunedLaw* law = recommended_law(*report.tuned);
    if (law == nullptr) return sentences;
    std::ranges::move(about_bounds(*report.tuned, report.tuned->gain_units, {law}),
                      std::back_inserter(sentences));
    return sentences;
  }
  if (report.tuning) sentences = tuning_reservations(report, *report.tuning);
  sentences.push_back(assumptions(report.assumed));
  return sentences;
}

}  // namespace boresight::app
