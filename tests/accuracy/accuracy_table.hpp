#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "../reference_values.hpp"

namespace boresight::reference {

/// One quantity of one reference case.
struct AccuracyRow {
  std::string name;  // of the case
  std::string quantity;
  std::string reference;  // as text
  int digits = 0;         // significant ones of the reference
  double error = 0.0;     // relative
  std::string asked;
  bool holds = false;
  std::string remark;  // in place of the verdict "holds"
};

/// Rows of one reference file.
class AccuracySection {
 public:
  AccuracySection(std::string title, std::string text)
      : title_(std::move(title)), text_(std::move(text)) {}

  /// Numbers known to `digits` digits, each to be met to `tolerance` of itself.
  void numbers(const std::string& name, const std::string& quantity,
               const std::vector<double>& found, const std::vector<double>& reference, int digits,
               double tolerance, const std::string& remark = "");
  void number(const std::string& name, const std::string& quantity, double found, double reference,
              int digits, double tolerance, const std::string& remark = "") {
    numbers(name, quantity, std::vector{found}, {reference}, digits, tolerance, remark);
  }
  /// A matrix, its elements to `tolerance` of the largest.
  void matrix(const std::string& name, const std::string& quantity, const Eigen::MatrixXd& found,
              const Eigen::MatrixXd& reference, int digits, double tolerance,
              const std::string& remark = "");
  /// Numbers to be met to half a unit of the last digit each is printed with, or 1e-9 where that
  /// is more. The error is given relative to the largest.
  void printed(const std::string& name, const std::string& quantity,
               const std::vector<double>& found, const std::vector<PrintedNumber>& reference,
               const std::string& remark = "");
  /// What cannot be put as a number: `holds` if it is as the reference says.
  void stated(const std::string& name, const std::string& quantity, const std::string& reference,
              bool holds, const std::string& remark = "");

  bool holds() const;
  std::size_t size() const { return rows_.size(); }
  std::string markdown() const;

 private:
  std::string title_;
  std::string text_;
  std::vector<AccuracyRow> rows_;
};

/// Rows of a printed table one after the other, as `flattened(matrix)` has them.
std::vector<PrintedNumber> flattened(const std::vector<std::vector<PrintedNumber>>& rows);
std::vector<double> flattened(const Eigen::MatrixXd& matrix);

/// Whether two tables are the same but for errors that differ by up to a factor of ten: rounding is
/// not the same on every processor. Otherwise `difference` says where they are not.
bool same_table(const std::string& found, const std::string& expected, std::string& difference);

// One a reference file, in the order of docs/accuracy.md.
AccuracySection margin_accuracy();
AccuracySection state_space_margin_accuracy();
AccuracySection norm_accuracy();
AccuracySection step_accuracy();
AccuracySection sampling_accuracy();
AccuracySection dead_time_accuracy();
AccuracySection zero_accuracy();
AccuracySection matrix_equation_accuracy();
AccuracySection slicot_accuracy();
AccuracySection peer_accuracy();

}  // namespace boresight::reference
