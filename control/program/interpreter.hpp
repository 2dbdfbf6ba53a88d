#pragma once

#include <string_view>
#include <vector>

#include <boresight/control/program/program.hpp>

namespace boresight::control::program {

enum class Precision { single_precision, double_precision };

/// What executes a program: the Interpreter, or compiled code behind an adapter.
class Runner {
 public:
  /// The program must outlive it.
  explicit Runner(const Program& program) : program_(&program) {}
  Runner(const Runner&) = default;
  Runner& operator=(const Runner&) = default;
  virtual ~Runner() = default;

  /// Parameters and states to their initial values.
  virtual void restart() = 0;
  virtual void step() = 0;
  /// Of a variable by its index (variable_index). Booleans are 0 or 1.
  virtual double value(std::size_t variable) const = 0;
  virtual void set_value(std::size_t variable, double value) = 0;

  /// The same by name. @throws InvalidInput for an unknown one.
  double get(std::string_view name) const { return value(variable_index(*program_, name)); }
  void set(std::string_view name, double value) {
    set_value(variable_index(*program_, name), value);
  }

 protected:
  const Program& program() const { return *program_; }

 private:
  const Program* program_;
};

/// Runs a program as its generated code does: every operation rounds to the precision of its type.
class Interpreter final : public Runner {
 public:
  explicit Interpreter(const Program& program, Precision precision = Precision::double_precision);

  void restart() override;
  void step() override;
  double value(std::size_t variable) const override { return values_[variable]; }
  void set_value(std::size_t variable, double value) override;

 private:
  double rounded(double value, Type type) const;
  double evaluate(const Expression& expression) const;
  void run(const std::vector<Statement>& statements);

  Precision precision_;
  std::vector<double> values_;
};

}  // namespace boresight::control::program
