#include <cmath>
#include <limits>

#include "accuracy_table.hpp"
#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::reference {

namespace {

/// Crossovers as columns; phase crossovers at the ends of the frequency axis apart.
struct Columns {
  std::vector<double> gain_frequency, phase_margin, delay_margin;
  std::vector<double> phase_frequency, gain_margin;
  std::vector<double> end_frequency, end_margin;
};

Columns columns_of(const std::vector<control::GainCrossover>& gain,
                   const std::vector<control::PhaseCrossover>& phase, double nyquist_frequency) {
  Columns columns;
  for (const auto& crossover : gain) {
    columns.gain_frequency.push_back(crossover.frequency);
    columns.phase_margin.push_back(crossover.phase_margin_deg);
    columns.delay_margin.push_back(crossover.delay_margin);
  }
  for (const auto& crossover : phase) {
    const bool end = crossover.frequency == 0.0 || crossover.frequency >= nyquist_frequency;
    (end ? columns.end_frequency : columns.phase_frequency).push_back(crossover.frequency);
    (end ? columns.end_margin : columns.gain_margin).push_back(crossover.gain_margin);
  }
  return columns;
}

/// L at w = 0 or pi/T, from zeros and poles where they are given.
double real_end(const nlohmann::json& system, const plant::StateSpace& loop, double w) {
  if (!system.contains("zeros")) return plant::frequency_response(loop, w)(0, 0).real();
  const double end = loop.sample_time > 0.0 ? (w == 0.0 ? 1.0 : -1.0) : 0.0;
  std::complex<double> gain = system.at("gain").get<double>();
  for (const auto zero : complex_numbers(system.at("zeros"))) gain *= end - zero;
  for (const auto pole : complex_numbers(system.at("poles"))) gain /= end - pole;
  return gain.real();
}

/// A loop of the files and the names their quantities have there.
class LoopRows {
 public:
  LoopRows(AccuracySection& section, std::string name, const plant::StateSpace& loop,
           std::string remark = "")
      : section_(section),
        name_(std::move(name)),
        remark_(std::move(remark)),
        loop_(loop),
        margins_(control::margins(loop)) {
    const double nyquist = loop.sample_time > 0.0
                               ? std::acos(-1.0) / loop.sample_time * (1.0 - 1e-12)
                               : std::numeric_limits<double>::infinity();
    const auto crossovers = control::crossovers(loop);
    scan_ = columns_of(margins_.gain_crossovers, margins_.phase_crossovers, nyquist);
    eigenvalues_ = columns_of(crossovers.gain, crossovers.phase, nyquist);
  }

  /// One column of crossovers by both routes.
  void column(const char* quantity, std::vector<double> Columns::*values,
              const std::vector<double>& reference, int digits = 12,
              const std::string& remark = "") const {
    const std::string& said = remark.empty() ? remark_ : remark;
    section_.numbers(name_, quantity, scan_.*values, reference, digits, 1e-9, said);
    section_.numbers(name_, std::string(quantity) + ", by eigenvalues", eigenvalues_.*values,
                     reference, digits, 1e-9, said);
  }

  /// Where L is real and negative at an end of the frequency axis, in the file or not: the gain
  /// margin beside the rational function there.
  void ends(const nlohmann::json& system) const {
    for (std::size_t i = 0; i < scan_.end_frequency.size(); ++i) {
      const double w = scan_.end_frequency[i];
      if (!std::isfinite(w)) continue;
      section_.number(name_, w == 0.0 ? "gain margin at w = 0" : "gain margin at w = pi/T",
                      scan_.end_margin[i], -1.0 / real_end(system, loop_, w), 16, 1e-9);
    }
  }

  /// The closest approach to -1; where the file stopped at the end of its scan, the response there.
  void distance(double reference, double frequency) const {
    if (at_end_of_scan(frequency)) {
      section_.number(name_, "distance to -1 at the end of the scan", std::abs(1.0 + at(frequency)),
                      reference, 12, 1e-9, remark_);
      section_.stated(name_, "closest to -1", "beyond the scan",
                      at_end_of_axis(margins_.sensitivity.frequency));
      return;
    }
    section_.number(name_, "distance to -1", margins_.distance_to_minus_one(), reference, 12, 1e-9,
                    remark_);
    section_.number(name_, "its frequency", margins_.sensitivity.frequency, frequency, 12, 1e-6,
                    remark_);
  }
  void disk(double reference, double frequency) const {
    if (at_end_of_scan(frequency)) {
      const auto gain = at(frequency);
      const double alpha = 1.0 / std::abs(0.5 * (1.0 - gain) / (1.0 + gain));
      section_.number(name_, "disk alpha at the end of the scan", alpha, reference, 12, 1e-9,
                      remark_);
      section_.stated(name_, "disk margin", "beyond the scan",
                      at_end_of_axis(margins_.disk.frequency));
      return;
    }
    section_.number(name_, "disk margin alpha", margins_.disk.alpha, reference, 12, 1e-9, remark_);
    section_.number(name_, "its frequency", margins_.disk.frequency, frequency, 12, 1e-6, remark_);
  }
  void distance_alone(double reference) const {
    section_.number(name_, "distance to -1", margins_.distance_to_minus_one(), reference, 12, 1e-9);
  }
  void disk_alone(double reference) const {
    section_.number(name_, "disk margin alpha", margins_.disk.alpha, reference, 12, 1e-9);
  }

 private:
  static bool at_end_of_scan(double frequency) { return frequency > 0.9e5 || frequency < 1.1e-6; }
  static bool at_end_of_axis(double frequency) { return frequency == 0.0 || frequency > 1e5; }
  std::complex<double> at(double frequency) const {
    return plant::DenseResponse(loop_).channel(frequency);
  }

  AccuracySection& section_;
  std::string name_;
  std::string remark_;
  const plant::StateSpace& loop_;
  control::Margins margins_;
  Columns scan_, eigenvalues_;
};

}  // namespace

AccuracySection margin_accuracy() {
  AccuracySection section(
      "Margins",
      "`values/margins.json`: every crossover of each loop, by the scan with refinement and by "
      "eigenvalues. The place of a closest approach is flat, so it is asked to 1e-6 only. Where a "
      "loop comes closest to -1 only as the frequency goes to 0 or infinity, the file holds the "
      "values at the end of its scan, and our response is compared there. The values of "
      "pc_disc_gh523a_T0.05 belong to 1.1 w^2/(s^2 + 0.4 w s + w^2), w = 2 pi, of which the file "
      "prints rounded coefficients and a slip, 43.42624593 for 43.42625936 (proof: "
      "tests/plant/linear/reference_values_test.cpp). Crossovers at w = 0 and pi/T, where L is "
      "real, are "
      "ours alone; they are compared with the value of the rational function.");
  const auto file = reference_values("margins");
  for (auto entry : file.at("cases")) {
    std::string remark;
    auto& system = entry.at("system");
    if (entry.at("id") == "pc_disc_gh523a_T0.05") {
      system.update(sampled_resonance());
      remark = "with exact coefficients, see above";
    }
    const plant::StateSpace loop = system_of(system);
    const LoopRows rows(section, entry.at("id"), loop, remark);
    const auto& verified = entry.at("verified");
    rows.column("gain crossovers", &Columns::gain_frequency, verified.at("gain_crossover_rad_s"));
    rows.column("phase margins", &Columns::phase_margin, verified.at("phase_margin_deg"));
    rows.column("delay margins", &Columns::delay_margin, verified.at("delay_margin_s"));
    rows.column("phase crossovers", &Columns::phase_frequency,
                verified.at("phase_crossover_rad_s"));
    rows.column("gain margins", &Columns::gain_margin, verified.at("gain_margin_abs"));
    rows.ends(system);
    rows.distance(verified.at("min_dist_to_minus1"), verified.at("min_dist_freq"));
    rows.disk(verified.at("disk_alpha_balanced"), verified.at("disk_freq"));
  }
  return section;
}

AccuracySection state_space_margin_accuracy() {
  AccuracySection section("Margins of state spaces",
                          "`values/margins_statespace.json`: loops of 18, 4 and 6 states.");
  const auto file = reference_values("margins_statespace");
  for (const auto& entry : file.at("cases")) {
    const plant::StateSpace loop = system_of(entry.at("ss"));
    const LoopRows rows(section, entry.at("id"), loop);
    const auto& verified = entry.at("verified");
    rows.column("gain crossovers", &Columns::gain_frequency, verified.at("wp"));
    rows.column("phase margins", &Columns::phase_margin, verified.at("pm"));
    rows.column("phase crossovers", &Columns::phase_frequency, verified.at("wg"));
    rows.column("gain margins", &Columns::gain_margin, verified.at("gm"));
    if (verified.contains("gm_at_dc")) {
      rows.column("gain margin at w = 0", &Columns::end_margin,
                  {entry.at("published").at("gm_all").at(0).get<double>()}, 16,
                  "the published value; the recomputed one is 2.6e-6 off "
                  "(MarginsReference.AtRestOfAnUnstablePlant)");
    } else {
      rows.ends(entry.at("ss"));
    }
    if (verified.contains("min_dist")) rows.distance_alone(verified.at("min_dist"));
    if (verified.contains("disk_alpha")) rows.disk_alone(verified.at("disk_alpha"));
  }
  return section;
}

}  // namespace boresight::reference
