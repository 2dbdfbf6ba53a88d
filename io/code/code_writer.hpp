#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/control/program/interpreter.hpp>
#include <boresight/control/program/program.hpp>

namespace boresight::io {

/// A generated file.
struct CodeFile {
  std::string name;  // within the folder
  std::string content;
};

/// Prints the statements of a program in a language. Binary operations are grouped by parentheses
/// as in the expression wherever the language would group them otherwise, so that every language
/// computes the same.
class CodeWriter {
 public:
  CodeWriter(const control::program::Program& program, control::program::Precision precision);
  CodeWriter(const CodeWriter&) = delete;
  CodeWriter& operator=(const CodeWriter&) = delete;
  virtual ~CodeWriter() = default;

  std::string expression(const control::program::Expression& expression) const;
  /// Indented by so many levels of two blanks; lines but remarks are broken at blanks beyond column
  /// 100.
  std::string statements(const std::vector<control::program::Statement>& statements,
                         int level) const;

 protected:
  const control::program::Program& program() const { return program_; }
  bool is_single() const { return precision_ == control::program::Precision::single_precision; }

  virtual std::string name(const control::program::Variable& variable) const = 0;
  virtual std::string literal(double value, control::program::Type type) const = 0;
  /// Of an operation that is no operator, with the text of its operands.
  virtual std::string call(const control::program::Expression& expression,
                           const std::vector<std::string>& operands) const = 0;
  virtual std::string_view conjunction() const = 0;
  virtual std::string_view complement() const = 0;
  virtual std::string_view assignment() const = 0;
  virtual std::string_view end_of_statement() const { return ";"; }
  virtual std::string remark(const std::string& text) const = 0;
  virtual std::string begin_if(const std::string& condition) const = 0;
  virtual std::string otherwise() const = 0;
  virtual std::string end_if() const = 0;
  /// At the end of a line that goes on in the next one.
  virtual std::string_view continuation() const { return ""; }

 private:
  struct Text {
    std::string text;
    int precedence = 0;
  };
  Text printed(const control::program::Expression& expression) const;
  std::string broken(const std::string& line, int level) const;

  const control::program::Program& program_;
  control::program::Precision precision_;
};

/// Unit and comment of a variable: "deg/s: of the target"; empty without either.
std::string description_of(const control::program::Variable& variable);

/// A number with all its digits (9 of single precision), with a decimal point or an exponent.
std::string real_literal(double value, bool single);

}  // namespace boresight::io
