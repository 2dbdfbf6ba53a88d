#pragma once

#include <string>
#include <vector>

namespace boresight::design {

/// A number as a source prints it, "0.22177 lbf.ft.s2".
struct PrintedForm {
  /// As printed, number first; empty for a number without text.
  std::string text;
  double value = 0.0;      // SI
  double half_unit = 0.0;  // half a unit of the last printed digit, SI; 0 for an exact number
  /// Index of the table's parallel column (0 metric, 1 inch-pound, ...); negative if its unit is
  /// the same in all of them.
  int column = -1;
};

/// The number at the start of the text, in the text's own unit; 0 if the text begins with none.
double printed_value(const PrintedForm& form);

/// SI value of one of the text's own units; 1 if the text has no number or it is 0.
double unit_factor(const PrintedForm& form);

/// The text with another SI value instead of the printed one, in the same unit, rounded to
/// `extra_digits` more digits than the original has.
std::string reprint(const PrintedForm& form, double value, int extra_digits);

/// The SI value truncated after the form's last digit.
double cut_like(const PrintedForm& form, double value);

/// `value` rounded to a number of significant digits.
double round_to_digits(double value, int digits);

/// `value` truncated to a number of significant digits.
double cut_to_digits(double value, int digits);

/// Number of significant digits of the printed number, without leading zeros.
int printed_digits(const PrintedForm& form);

/// All texts from swapping two unlike neighbouring digits of the number, with their values.
std::vector<PrintedForm> transposed_digits(const PrintedForm& form);

/// All texts from changing one digit of the number.
std::vector<PrintedForm> changed_digits(const PrintedForm& form);

/// All texts from omitting one digit of the number.
std::vector<PrintedForm> omitted_digits(const PrintedForm& form);

}  // namespace boresight::design
