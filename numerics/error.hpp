#pragma once

#include <stdexcept>
#include <string>

namespace boresight {

/// Base of every error this library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument or an input file is not what the function or the format asks for.
/// The message names the function (or file, line, column, key), what was expected and what was
/// found. Exit code 2.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A requirement cannot be met: the message names it and the closest achievable value. Exit code 3.
class InfeasibleRequirement : public Error {
 public:
  using Error::Error;
};

/// A computation has no trustworthy result: unstable loop, singular matrix, no convergence.
/// Exit code 4.
class NumericalFailure : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop. Exit code 130.
class Interrupted : public Error {
 public:
  using Error::Error;
};

}  // namespace boresight
