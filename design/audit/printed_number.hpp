#pragma once

#include <string>
#include <vector>

namespace boresight::design {

/// A number as a source prints it, "0.22177 lbf.ft.s2".
struct PrintedForm {
  /// As printed, number first; empty for a number that no text belongs to.
  std::string text;
  double value = 0.0;      // SI
  double half_unit = 0.0;  // half a unit of the last printed digit, SI; 0 for an exact number
  /// Which of a table's parallel columns it belongs to (0 metric, 1 inch-pound, ...), negative if
  /// its unit is the same in all of them.
  int column = -1;
};

/// The number at the head of the text, in the text's own unit; 0 if the text begins with none.
double printed_value(const PrintedForm& form);

/// SI value of one of the text's own units; 1 if the text has no number or it is 0.
double unit_factor(const PrintedForm& form);

/// The text with another SI value in place of the printed one, in the same unit, rounded to
/// `extra_digits` more digits than the original has.
std::string reprint(const PrintedForm& form, double value, int extra_digits);

/// The SI value cut off behind the form's last digit.
double cut_like(const PrintedForm& form, double value);

/// `value` rounded to a number of significant digits.
double round_to_digits(double value, int digits);

/// `value` with all but a number of significant digits cut off.
double cut_to_digits(double value, int digits);

/// Significant digits of the printed number, leading zeros not counted.
int printed_digits(const PrintedForm& form);

/// Every text that swapping two neighbouring unlike digits of the number gives, with its value.
std::vector<PrintedForm> transposed_digits(const PrintedForm& form);

/// Every text that changing one digit of the number gives.
std::vector<PrintedForm> changed_digits(const PrintedForm& form);

/// Every text that leaving out one digit of the number gives.
std::vector<PrintedForm> omitted_digits(const PrintedForm& form);

}  // namespace boresight::design
