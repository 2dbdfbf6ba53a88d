#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace boresight::app {

/// A case file to be filled in.
struct CaseForm {
  std::string text;
  std::size_t blanks = 0;       // values that are "?"
  std::size_t first_blank = 0;  // its line, from 1
};

/// The form app/new_case/case_form.toml with a title; every table and key that the reader knows.
CaseForm case_form(std::string_view title);

}  // namespace boresight::app
