#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace boresight::io {

/// Variables of a MAT file of version 5, or fields of a structure in one, in the order in which
/// they are added. Numbers are doubles, bit by bit; text is UTF-16 as MATLAB writes it. Neither
/// compressed nor dated, so that the same numbers are the same bytes.
///
/// Names: a letter, then letters, digits and underscores, 63 characters at most, each once. Adding
/// throws InvalidInput for any other name, and for an array beyond the format's 2^31 bytes.
class MatVariables {
 public:
  void add_matrix(const std::string& name, const Eigen::MatrixXd& matrix);
  void add_number(const std::string& name, double number);
  /// Pages of one size, the k-th as name(:,:,k): a frequency response, outputs x inputs x points.
  /// @throws InvalidInput for pages of different sizes.
  void add_pages(const std::string& name, const std::vector<Eigen::MatrixXcd>& pages);
  /// Bytes of UTF-8; what is none becomes '?'.
  void add_text(const std::string& name, std::string_view text);
  /// A column of cells.
  void add_texts(const std::string& name, const std::vector<std::string>& texts);
  void add_structure(const std::string& name, const MatVariables& fields);

  /// The whole file; `description` stands in its head, up to 90 characters of it.
  std::string file(std::string_view description) const;

 private:
  // An array's bytes before and behind its name: a field of a structure has none.
  struct Variable {
    std::string name, head, body;
  };
  void keep(const std::string& name, std::string head, std::string body);
  static std::string element_of(const Variable& variable, const std::string& name);

  std::vector<Variable> variables_;
};

}  // namespace boresight::io
