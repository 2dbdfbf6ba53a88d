#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/change/change_report.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/servo_record_wording.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string band_text(const design::RatioBand& ratio) {
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", ratio.value, ratio.lower, ratio.upper);
}

std::string rms_text(const design::RmsBand& rms) {
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", rms.value / millidegree, rms.lower / millidegree,
                     rms.upper / millidegree);
}

std::string verdict(const ChangeReport& report, const design::RatioAtSpeed& at) {
  const double percent = 100.0 * report.confidence;
  if (at.change == design::Change::none) {
    return fmt::format("no change that is significant at {:g} %", percent);
  }
  return fmt::format("{}, significant at {:g} %", to_string(at.change), percent);
}

std::string prediction_text(const ChangeReport& report) {
  if (!report.predicted) return {};
  const auto& predicted = *report.predicted;
  return fmt::format("; the linear model predicted {}: {}", band_text(predicted.ratio),
                     predicted.held ? "held" : "NOT held");
}

std::string not_compared(const ChangeReport& report) {
  const auto& before = report.comparison.before;
  const auto& after = report.comparison.after;
  if (report.comparison.kind == design::WindComparisonKind::no_overlap) {
    return fmt::format(
        "No verdict: the mean wind speeds do not overlap, {:.1f} to {:.1f} m/s before and {:.1f} "
        "to {:.1f} m/s after. Record at wind speeds that both conditions have.",
        before.slowest, before.fastest, after.slowest, after.fastest);
  }
  return fmt::format(
      "No verdict: {} records before and {} after, in different winds. Record at least three of "
      "each, or all within 10 % of one wind speed.",
      before.records.size(), after.records.size());
}

std::string check_text(design::ChangeCheckKind kind) {
  using enum design::ChangeCheckKind;
  switch (kind) {
    case wind_overlap:
      return "Wind speeds before and after overlap";
    case wind_direction:
      return "Wind directions before and after differ by at most 30 deg";
    case improvement:
      return "The error is significantly smaller";
    case prediction:
      return "The prediction held";
    case stability:
      return "The new controller is stable on the nominal plant and every ensemble member";
    case design_wind_rms:
      return "In the design wind the rms is within the tightest budget";
  }
  return "";
}

std::string check_value(const ChangeReport& report, design::ChangeCheckKind kind) {
  using enum design::ChangeCheckKind;
  const auto& comparison = report.comparison;
  const auto degrees = [](const std::optional<double>& angle) {
    return angle ? fmt::format("{:.0f} deg", *angle / degree) : std::string("not recorded");
  };
  switch (kind) {
    case wind_overlap:
      return fmt::format("{:.1f} to {:.1f}, {:.1f} to {:.1f} m/s", comparison.before.slowest,
                         comparison.before.fastest, comparison.after.slowest,
                         comparison.after.fastest);
    case wind_direction:
      return degrees(comparison.before.wind_direction) + ", " +
             degrees(comparison.after.wind_direction);
    case improvement:
      return comparison.at_reference ? "ratio " + band_text(comparison.at_reference->ratio)
                                     : "not compared";
    case prediction:
      return report.predicted ? "ratio " + band_text(report.predicted->ratio) : "no prediction";
    case stability:
      return fmt::format("{} of {} members{}", report.stable_plants, report.plants,
                         report.stable_nominal ? "" : ", NOT the nominal plant");
    case design_wind_rms: {
      if (!report.budget) return "the case has no budget";
      if (report.error != design::RecordedError::boresight) {
        return "position errors do not include the flexure beyond the encoder";
      }
      const auto& at = comparison.at_design;
      if (!at) return "not compared there";
      return fmt::format("{} mdeg at {:g} m/s, budget {:.4g} mdeg{}", rms_text(at->after),
                         at->speed, *report.budget / millidegree,
                         at->after_extrapolated ? "; EXTRAPOLATED beyond the records" : "");
    }
  }
  return "";
}

Document controller_part(const std::string& title, const RecordedController& controller) {
  Document text =
      subheading(fmt::format("{}: {} ({})", title, controller.structure, controller.source));
  if (!controller.state_space.empty()) return text + wrapped(controller.state_space + ".", "    ");
  Rows rows{{"gain", "value"}};
  for (const auto& gain : controller.gains) {
    rows.push_back({fmt::format("{} {}", gain.symbol, gain.name), gain.text});
  }
  return text + table(std::move(rows), "ll");
}

Document records_part(const ChangeReport& report) {
  Document text = heading("Records");
  Rows rows{
      {"record", "condition", "minutes", "wind m/s", "intensity", "gusts", "rms mdeg", "dof"}};
  for (const bool after : {false, true}) {
    const auto& condition = after ? report.comparison.after : report.comparison.before;
    for (const auto& record : condition.records) {
      rows.push_back(
          {record.name, after ? "after" : "before", fmt::format("{:.1f}", record.duration / 60.0),
           fmt::format("{:.2f}", record.mean_speed), fmt::format("{:.3f}", record.wind_intensity),
           fmt::format("{:.2f}", std::exp(0.5 * record.log_gusts)),
           fmt::format("{:.4g}", record.rms / millidegree), fmt::format("{:.0f}", record.freedom)});
    }
  }
  text += table(std::move(rows), "ll");
  text += wrapped(
      fmt::format("Rms of the {} from {:.3g} to {:.3g} Hz. Intensity: standard deviation of the "
                  "wind speed over its mean. Gusts: amplitude over that usual in these records at "
                  "that speed. Dof: degrees of freedom of the mean square.",
                  to_string(report.error), report.comparison.lowest, report.comparison.highest),
      "  ");
  for (const auto* files : {&report.before_files, &report.after_files}) {
    for (const auto& notes : *files) {
      for (const auto& sentence : reading_of(notes))
        text += wrapped(notes.path + ": " + sentence, "  ", "  ");
    }
  }
  for (const auto& remark : report.remarks) text += wrapped(remark, "  ");
  return text;
}

}  // namespace

std::vector<std::string> decision(const ChangeReport& report) {
  const auto& at = report.comparison.at_reference;
  if (!at) return {not_compared(report)};
  std::string error(to_string(report.error));
  error[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(error[0])));
  std::vector<std::string> sentences{fmt::format(
      "{} rms after the change is {} times that before, at a mean wind speed of {:.1f} m/s: {}{}.",
      error, band_text(at->ratio), at->speed, verdict(report, *at), prediction_text(report))};
  if (report.comparison.directions_differ) {
    sentences.emplace_back(
        "The wind came from different directions: its torque depends on the attitude, and the "
        "ratio "
        "holds only if that effect is small.");
  }
  return sentences;
}

Document controllers_part(const ChangeReport& report) {
  Document text = heading("Controllers");
  text += report.old_controller
              ? controller_part("Before", *report.old_controller)
              : wrapped("Before: not known. State [gains] in the case, or --old-gains.", "  ");
  return text + controller_part("After", report.new_controller);
}

Document evidence_part(const ChangeReport& report) {
  const auto& comparison = report.comparison;
  Document text = heading("Evidence");
  Rows rows{{"wind m/s", "before mdeg", "after mdeg", "after/before", "verdict"}};
  for (const auto* at : {&comparison.at_reference, &comparison.at_design}) {
    if (!*at) continue;
    const bool extrapolated = (*at)->before_extrapolated || (*at)->after_extrapolated;
    rows.push_back({fmt::format("{:.2f}", (*at)->speed), rms_text((*at)->before),
                    rms_text((*at)->after), band_text((*at)->ratio),
                    std::string(to_string((*at)->change)) +
                        (extrapolated ? ", EXTRAPOLATED beyond the records" : "")});
  }
  if (rows.size() > 1) text += essential(table(std::move(rows), "rllll"));
  text += wrapped(
      fmt::format("{} records before, {} after; {}. Rms of the {} from {:.3g} to {:.3g} Hz, with "
                  "{:g} % intervals.",
                  comparison.before.records.size(), comparison.after.records.size(),
                  to_string(comparison.kind), to_string(report.error), comparison.lowest,
                  comparison.highest, 100.0 * report.confidence),
      "  ");
  if (comparison.kind == design::WindComparisonKind::regression) {
    text += wrapped(fmt::format("The variance of the error rises as the {:.2f}th power of the wind "
                                "speed and the {:.2f}th of the gusts' power.",
                                comparison.exponent, comparison.gust_exponent),
                    "  ");
  }
  text += wrapped(
      fmt::format("Coherent with the measured wind: {:.1f} % of the error's power before, {:.1f} % "
                  "after (significant above {:.1f} and {:.1f} %).{}",
                  100.0 * comparison.before.explained, 100.0 * comparison.after.explained,
                  100.0 * comparison.before.explained_threshold,
                  100.0 * comparison.after.explained_threshold,
                  comparison.by_coherence
                      ? fmt::format(" That part alone, of the slow gusts: after/before {}.",
                                    band_text(*comparison.by_coherence))
                      : " Too little for a ratio of that part."),
      "  ");
  if (report.predicted) {
    const auto& predicted = *report.predicted;
    text +=
        wrapped(fmt::format("Predicted by the linear model in that wind and band: {:.4g} mdeg "
                            "before, {:.4g} mdeg after, ratio {} over {} plants.",
                            predicted.rms_before / millidegree, predicted.rms_after / millidegree,
                            band_text(predicted.ratio), predicted.plants),
                "  ");
  }
  return text;
}

Document checks_part(const ChangeReport& report) {
  Rows rows{{"check", "found", "result"}};
  for (const auto& check : report.checks) {
    rows.push_back({check_text(check.kind), check_value(report, check.kind),
                    !check.passed   ? "not checked"
                    : *check.passed ? "pass"
                                    : "FAIL"});
  }
  return heading("Checks") + essential(table(std::move(rows), "lll"));
}

Document document_of(const ChangeReport& report) {
  Document text =
      report_title("benchmark: before and after", report.title,
                   words_beside(report.title, report.axis), report.case_path, report.seed);
  text += lead(decision(report));
  return text + evidence_part(report) + checks_part(report) + controllers_part(report) +
         records_part(report) + document_of(report.assumed);
}

std::string to_text(const ChangeReport& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
