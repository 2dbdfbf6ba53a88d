#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/studies/commission_study.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using design::PlantBand;
using design::StageKind;

std::string structure_of_gains(const CommissionOptions& options) {
  return options.structure.empty() ? "DPF" : options.structure;
}

control::ControlLaw given_law(const io::Case& antenna, const CommissionOptions& options) {
  const std::string structure = structure_of_gains(options);
  control::ControlLaw law{io::loop_structure(antenna, structure), {}};
  std::vector<std::string> known;
  for (const auto& block : law.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      const std::string& symbol = block.gains[i].symbol;
      known.push_back(symbol);
      const auto text = std::ranges::find_if(
          options.gains, [&](const std::string& one) { return one.starts_with(symbol + "="); });
      if (text == options.gains.end()) {
        throw InvalidInput(fmt::format("--gains: expected a value for {} ({}) of {}, found none",
                                       symbol, block.gains[i].name, structure));
      }
      try {
        law.gains.push_back(io::parse_quantity(text->substr(symbol.size() + 1),
                                               io::gain_kind(block.path, block.kind, i))
                                .value);
      } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("--gains {}: {}", io::in_quotes(*text), error.what()));
      }
    }
  }
  for (const auto& text : options.gains) {
    const std::string symbol = text.substr(0, text.find('='));
    if (std::ranges::find(known, symbol) == known.end()) {
      throw InvalidInput(fmt::format("--gains {}: expected KEY=VALUE with a key of {}, found none",
                                     io::in_quotes(text), fmt::join(known, ", ")));
    }
  }
  control::validate(law);
  return law;
}

// The recommended controller; its structure and bounds go into the report.
control::ControlLaw recommended(const io::DesignedAntenna& designed,
                                const CommissionOptions& options, CommissionReport& report) {
  design::TuneOptions tuning;
  if (!options.structure.empty()) {
    tuning.structures = structure_option(designed.antenna, {options.structure});
  }
  tuning.starts = options.starts;
  tuning.seed = options.seed;
  tuning.threads = options.threads;
  tuning.interrupted = options.interrupted;
  if (options.progress) {
    tuning.progress = [&](std::size_t done, std::size_t all) {
      options.progress("tuning", done, all);
    };
  }
  design::ControllerStudy study = study_controllers(designed.mission, designed.ensemble, tuning);
  if (options.interrupted && options.interrupted()) throw Interrupted("interrupted by the user");
  // One that limit-cycles is planned for with a warning.
  const TunedLaw* law = commissionable(study);
  if (law == nullptr) {
    report.structure = fmt::format("{}", fmt::join(study.tuned.structures, ", "));
    const auto shortfalls = section_of(designed.antenna, std::move(study.tuned)).shortfalls;
    throw InfeasibleRequirement(fmt::format(
        "commission: no law of {} meets its goals on every plant that may be the true one{}",
        report.structure,
        shortfalls.empty() ? std::string()
                           : ": " + shortfalls[0].infeasible + " " + shortfalls[0].closest));
  }
  report.structure = law->structure;
  report.bounds = about_bounds(study.tuned, io::GainUnits(designed.antenna), {law});
  return law->design.tuning.law;
}

std::string range(const PlantBand& band, double unit, int digits) {
  return fmt::format("{:.{}g} ({:.{}g} to {:.{}g})", band.nominal / unit, digits, band.lower / unit,
                     digits, band.upper / unit, digits);
}

std::string percent(const PlantBand& band) {
  return fmt::format("{:.1f} ({:.1f} to {:.1f}) %", 100.0 * band.nominal, 100.0 * band.lower,
                     100.0 * band.upper);
}

std::string settling(const PlantBand& band) {
  return std::isfinite(band.upper) ? "settles into 5 % in " + range(band, 1.0, 3) + " s"
                                   : "settles slowly";
}

// Whether every plant can do what the stage asks for. Only the gains as found may not.
bool foreseen(const design::CommissioningStage& stage) {
  return stage.expected.stable == stage.expected.plants;
}

void describe_check(const io::Case& antenna, StageSheet& sheet) {
  const auto& expected = sheet.stage.expected;
  const double gear = io::gear_ratio(antenna);
  const double sky = gear * millidegree;
  if (!foreseen(sheet.stage)) {
    sheet.check = fmt::format("Nothing: as the plants have it, {} of {} are unstable.",
                              expected.plants - expected.stable, expected.plants);
    return;
  }
  const bool open = sheet.stage.law.position_open;
  if (sheet.stage.kind == StageKind::feedforward) {
    sheet.check = "Largest encoder error of the move: " + range(expected.move_error, sky, 3) +
                  " mdeg. The step as in the stage before. ";
  } else {
    sheet.check = fmt::format(
        "Step of the {} command of {:.3g} mdeg{} at the sky: rises (10 % to 90 %) in {} s, "
        "overshoots by {}, {}. ",
        open ? "rate" : "position", sheet.step / millidegree, open ? "/s" : "",
        range(expected.rise_time, 1.0, 3), percent(expected.overshoot),
        settling(expected.settling_time));
  }
  sheet.check += fmt::format("Crossover {} Hz. ", range(expected.crossover, two_pi, 3));
  sheet.check +=
      "In still air, rms of the valve command " + range(expected.still_valve, 1.0, 3) + " rad/s";
  sheet.check += open
                     ? ", of the tachometer " + range(expected.still_tachometer, 1.0, 3) + " rad/s."
                     : ", of the encoder error " + range(expected.still_encoder, sky, 3) +
                           " mdeg. Beam rms in the design wind " +
                           range(expected.beam_rms, sky, 3) + " mdeg.";
}

void describe_abort(const io::Case& antenna, StageSheet& sheet, const CommissionReport& report) {
  const auto& abort = sheet.stage.abort;
  if (!foreseen(sheet.stage)) {
    sheet.abort =
        "Not known: the plants say that these gains do not work, and the antenna runs on them.";
    return;
  }
  sheet.abort = fmt::format(
      "Overshoot above {:.0f} %, or in still air rms of the valve command above {:.3g} rad/s",
      100.0 * abort.overshoot, abort.still_valve_rms);
  if (!sheet.stage.law.position_open) {
    sheet.abort += fmt::format(" or of the encoder error above {:.3g} mdeg",
                               abort.still_encoder_rms / (io::gear_ratio(antenna) * millidegree));
  }
  sheet.abort += ", or any ringing that does not die out. ";
  sheet.abort += std::isfinite(abort.gain_reserve)
                     ? fmt::format(
                           "The peak of S reaches {:g} on the worst plant ({}) with {:.2f} "
                           "times this loop gain.",
                           report.options.abort_peak, abort.worst_plant, abort.gain_reserve)
                     : fmt::format(
                           "The peak of S stays below {:g} on every plant even with 8 times "
                           "this loop gain.",
                           report.options.abort_peak);
}

void describe_way_back(const StageSheet* before, StageSheet& sheet) {
  const auto kind = sheet.stage.kind;
  if (before == nullptr || before->stage.kind == StageKind::as_found) {
    sheet.way_back = "Brakes on, then the gains as found.";
    if (before == nullptr) {
      sheet.way_back = "Brakes on; nothing has been changed yet.";
    } else if (!foreseen(before->stage)) {
      sheet.way_back =
          "Brakes on. The gains as found only if the antenna did run on them, whatever the plants "
          "say.";
    }
  } else if (kind == StageKind::feedforward) {
    sheet.way_back = "Switch feedforward off: the loops are as they were.";
  } else if (sheet.stage.law.position_open) {
    sheet.way_back = "Rate command to zero, then the gains of the stage before.";
  } else if (before->stage.law.position_open) {
    sheet.way_back = "Open the position loop (rate command zero); the rate loop keeps its gains.";
  } else {
    sheet.way_back = "Open the position loop, set the gains of the stage before, close it again.";
  }
}

std::vector<StageGain> acting_gains(const io::Case& antenna, const design::StageLaw& stage,
                                    const StageSheet* before) {
  const auto texts = io::GainUnits(antenna).texts(stage.law);
  std::vector<StageGain> gains;
  std::size_t index = 0;
  for (const auto& block : stage.law.structure.blocks()) {
    const bool outer =
        block.path == control::LoopPath::position || block.path == control::LoopPath::compliance;
    for (const auto& description : block.gains) {
      StageGain gain{description.symbol, description.name, texts[index], stage.law.gains[index]};
      ++index;
      if (outer && stage.position_open) continue;
      const auto same = [&](const StageGain& other) {
        return other.symbol == gain.symbol && other.value == gain.value;
      };
      gain.changed = before != nullptr && std::ranges::none_of(before->gains, same);
      gains.push_back(std::move(gain));
    }
  }
  return gains;
}

std::vector<StageSheet> make_sheets(const io::Case& antenna, const CommissionReport& report,
                                    const std::vector<double>& steps) {
  std::vector<StageSheet> sheets;
  sheets.reserve(report.plan.stages.size());
  for (std::size_t i = 0; i < report.plan.stages.size(); ++i) {
    const StageSheet* before = sheets.empty() ? nullptr : &sheets.back();
    StageSheet sheet;
    sheet.stage = report.plan.stages[i];
    sheet.gains = acting_gains(antenna, sheet.stage.law, before);
    sheet.step = steps[i];
    describe_check(antenna, sheet);
    describe_abort(antenna, sheet, report);
    describe_way_back(before, sheet);
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

void conclude_plan(const CommissionReport& report, const io::Case& antenna,
                   std::vector<std::string>& sentences) {
  if (report.limit_cycle) {
    sentences.push_back(fmt::format(
        "On the nonlinear antenna {} {}: the stages are those of linear loops. Measure the "
        "friction before this law is set, or plan for another.",
        report.structure,
        std::isfinite(*report.limit_cycle)
            ? fmt::format("hunts by +-{:.2f} mdeg, beyond the tightest budget",
                          *report.limit_cycle / millidegree)
            : std::string("does not complete a run in still air")));
  }
  sentences.insert(sentences.end(), report.bounds.begin(), report.bounds.end());
  const auto& first = report.plan.stages.front();
  const auto& last = report.plan.stages.back();
  const double sky = io::gear_ratio(antenna) * millidegree;
  if (!foreseen(first)) {
    sentences.push_back(fmt::format(
        "With the gains as found {} of {} plants are unstable, but the antenna runs on them: its "
        "plant, or what a gain means, is not what the case says. Find out which (leakage, inertia, "
        "units and definition of the gains) before any stage: all that follows rests on these "
        "plants.",
        first.expected.plants - first.expected.stable, first.expected.plants));
  }
  sentences.push_back(fmt::format(
      "{} stages lead to {}; no gain changes by more than a factor of {:.3g} at once, and the peak "
      "of S is at most {:.2f} on each of {} plants at every one of them.",
      report.plan.stages.size() - (first.kind == StageKind::as_found ? 1 : 0), report.structure,
      report.plan.largest_step,
      std::ranges::max(report.plan.stages, {},
                       [](const design::CommissioningStage& stage) {
                         return stage.kind == StageKind::as_found ? 0.0
                                                                  : stage.expected.peak.largest;
                       })
          .expected.peak.largest,
      last.expected.plants));
  if (first.kind == StageKind::as_found && std::isfinite(first.expected.beam_rms.upper)) {
    sentences.push_back(fmt::format(
        "Beam rms, one axis, at {:g} m/s ({} wind): {} mdeg as found, {} mdeg at the end.",
        report.wind_speed, report.wind_model, range(first.expected.beam_rms, sky, 3),
        range(last.expected.beam_rms, sky, 3)));
  } else {
    sentences.push_back(
        fmt::format("Beam rms, one axis, at {:g} m/s ({} wind) at the end: {} mdeg.",
                    report.wind_speed, report.wind_model, range(last.expected.beam_rms, sky, 3)));
  }
}

std::vector<std::string> conclude(const CommissionReport& report, const io::Case& antenna) {
  std::vector<std::string> sentences;
  if (report.failure == nullptr) {
    conclude_plan(report, antenna, sentences);
  } else {
    sentences.push_back(
        fmt::format("There is no plan for {}: {}", report.structure, report.no_plan));
  }
  for (const auto& channel : report.comparisons) {
    if (!channel.not_compared.empty()) continue;
    const auto& whole = channel.comparison.whole;
    std::string sentence = fmt::format(
        "{}, {:.3g} to {:.3g} Hz: rms after is {:.3g} times that before ({:.3g} to {:.3g}): {}.",
        to_string(channel.quantity), whole.lowest, whole.highest, whole.ratio, whole.lower,
        whole.upper, to_string(whole.change));
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    if (channel.predicted) {
      const auto& predicted = *channel.predicted;
      sentence +=
          fmt::format(" The plan predicts {:.3g} ({:.3g} to {:.3g}) in the design wind: {}.",
                      predicted.value, predicted.lower, predicted.upper,
                      agrees(channel.comparison, predicted) ? "they agree" : "they do not agree");
    }
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace

CommissionReport plan_commission(const io::DesignedAntenna& designed,
                                 const CommissionOptions& options) {
  const io::Case& antenna = designed.antenna;
  const design::PlantEnsemble& ensemble = designed.ensemble;
  if (options.before.empty() != options.after.empty()) {
    throw InvalidInput(
        "commission: expected both --before and --after, or neither: one record alone shows no "
        "change");
  }
  CommissionReport report;
  report.case_path = antenna.path;
  report.title = antenna.title;
  report.axis = antenna.axis;
  report.seed = options.seed;
  report.tuned = options.gains.empty();
  report.structure = report.tuned ? options.structure : structure_of_gains(options);
  report.ensemble_source = to_string(ensemble.source);
  report.ensemble_size = ensemble.members.size();
  report.wind_speed = designed.mission.wind.mean_speed;
  report.wind_model = antenna.wind.model;
  report.gear_ratio = gear_ratio(designed.mission.antenna);
  report.before = options.before;
  report.after = options.after;
  report.assumed = assumed_inputs(antenna, {.valve_stroke = true});
  report.options.largest_step = options.largest_step;
  report.options.threads = options.threads;
  report.options.stop = options.interrupted;
  if (options.progress) {
    report.options.progress = [progress = options.progress](std::size_t done, std::size_t all) {
      progress("planning", done, all);
    };
  }
  report.move = design::commissioning_move(designed.mission);
  if (!options.structure.empty()) io::loop_structure(antenna, options.structure);
  if (!options.before.empty()) {
    report.comparisons =
        compare_case_records(antenna, options.before, options.after, options.threads);
  }
  // What the records say of work that is done does not hang on a plan.
  const auto without_plan = [&](const std::exception& error) {
    if (report.comparisons.empty()) throw;
    report.failure = std::current_exception();
    report.no_plan = error.what();
  };
  try {
    const control::ControlLaw target =
        report.tuned ? recommended(designed, options, report) : given_law(antenna, options);
    const design::CommissionStudy study =
        study_commission(designed.mission, ensemble, target, report.options, options.seed);
    report.plan = study.plan;
    report.limit_cycle = study.limit_cycle;
    for (auto& channel : report.comparisons) {
      channel.predicted = predicted_ratio(report.plan, channel.quantity);
    }
    report.sheets = make_sheets(antenna, report, study.steps);
  } catch (const InfeasibleRequirement& error) {
    without_plan(error);
  } catch (const NumericalFailure& error) {
    without_plan(error);
  }
  report.conclusions = conclude(report, antenna);
  report.figures = commission_figures(report);
  return report;
}

}  // namespace boresight::app
