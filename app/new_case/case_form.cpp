#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/new_case/case_form.hpp>
#include <boresight/case_form_text.hpp>

namespace boresight::app {
namespace {

// As it may stand between double quotes in TOML; characters that may not are left out.
std::string toml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) >= ' ' && c != '\x7f') result += c;
  }
  return result;
}

}  // namespace

CaseForm case_form(std::string_view title) {
  constexpr std::string_view mark = "@title@";
  constexpr std::string_view blank = "= \"?\"";
  CaseForm form;
  form.text = case_form_text;
  const std::string titled = toml_text(title);
  for (auto at = form.text.find(mark); at != std::string::npos;
       at = form.text.find(mark, at + titled.size())) {
    form.text.replace(at, mark.size(), titled);
  }
  for (auto at = form.text.find(blank); at != std::string::npos;
       at = form.text.find(blank, at + 1)) {
    if (form.blanks++ == 0) {
      form.first_blank =
          1 + static_cast<std::size_t>(
                  std::count(form.text.begin(), form.text.begin() + static_cast<long>(at), '\n'));
    }
  }
  return form;
}

}  // namespace boresight::app
