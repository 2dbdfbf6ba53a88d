#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include <boresight/io/records/mat_elements.hpp>
#include <boresight/io/records/mat_writer.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

// Values of the file format.
constexpr std::uint32_t type_int32 = 5, type_uint32 = 6, type_double = 9, type_utf16 = 17;
constexpr std::uint32_t class_cell = 1, class_structure = 2, class_text = 4, class_double = 6;
constexpr std::uint32_t complex_flag = 0x0800;
constexpr std::size_t longest_name = 63;

template <typename Number>
void append_number(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

// Padded to a multiple of eight bytes; what has four or less goes into the tag, as readers expect.
void append_element(std::string& bytes, std::uint32_t type, std::string_view content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  if (size > 0 && size <= 4) {
    append_number(bytes, (size << 16U) | type);
    bytes += content;
    bytes.append(4 - size, '\0');
    return;
  }
  append_number(bytes, type);
  append_number(bytes, size);
  bytes += content;
  bytes.append((8 - content.size() % 8) % 8, '\0');
}

std::string head_of(std::uint32_t array_class, const std::vector<std::size_t>& dimensions) {
  std::string flags, sizes, head;
  append_number(flags, array_class);
  append_number(flags, std::uint32_t{0});
  for (const std::size_t size : dimensions) {
    append_number(sizes, static_cast<std::int32_t>(size));
  }
  append_element(head, type_uint32, flags);
  append_element(head, type_int32, sizes);
  return head;
}

std::string doubles(const double* first, std::size_t count) {
  std::string bytes(count * sizeof(double), '\0');
  if (count > 0) std::memcpy(bytes.data(), first, bytes.size());
  return bytes;
}

// One unit or, beyond the first plane, two for every code point of UTF-8.
std::vector<std::uint16_t> utf16(std::string_view text) {
  std::vector<std::uint16_t> units;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0x80U ? 0U : lead >= 0xF0U ? 3U : lead >= 0xE0U ? 2U : 1U;
    std::uint32_t code = more == 0 ? lead : lead & (0x3FU >> more);
    bool whole = lead < 0x80U || (lead >= 0xC2U && lead < 0xF5U);
    for (std::size_t k = 1; whole && k <= more; ++k) {
      const unsigned char next =
          i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : std::uint8_t{0};
      whole = (next & 0xC0U) == 0x80U;
      code = (code << 6U) | (next & 0x3FU);
    }
    if (!whole) code = '?';
    i += whole ? more + 1 : 1;
    if (code >= 0x10000U) {
      units.push_back(static_cast<std::uint16_t>(0xD800U + ((code - 0x10000U) >> 10U)));
      code = 0xDC00U + ((code - 0x10000U) & 0x3FFU);
    }
    units.push_back(static_cast<std::uint16_t>(code));
  }
  return units;
}

// Head and body of a text.
std::pair<std::string, std::string> text_parts(std::string_view text) {
  const auto units = utf16(text);
  std::string content, body;
  for (const std::uint16_t unit : units) append_number(content, unit);
  append_element(body, type_utf16, content);
  return {head_of(class_text, {units.empty() ? std::size_t{0} : 1, units.size()}), std::move(body)};
}

bool is_name(const std::string& name) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && name.size() <= longest_name && letter(name.front()) &&
         std::ranges::all_of(
             name, [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

}  // namespace

void MatVariables::keep(const std::string& name, std::string head, std::string body) {
  if (!is_name(name)) {
    throw InvalidInput(fmt::format(
        "MAT file: expected a name of a letter and at most {} letters, digits and underscores "
        "behind it, found '{}'",
        longest_name - 1, name));
  }
  if (std::ranges::find(variables_, name, &Variable::name) != variables_.end()) {
    throw InvalidInput(fmt::format("MAT file: expected each name once, found '{}' again", name));
  }
  constexpr auto maximum = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (body.size() > maximum - 1024) {
    throw InvalidInput(fmt::format("MAT file: expected arrays below 2^31 bytes, found {} in '{}'",
                                   body.size(), name));
  }
  variables_.push_back({name, std::move(head), std::move(body)});
}

std::string MatVariables::element_of(const Variable& variable, const std::string& name) {
  std::string whole = variable.head;
  append_element(whole, mat_int8, name);
  whole += variable.body;
  std::string bytes;
  append_element(bytes, mat_matrix, whole);
  return bytes;
}

void MatVariables::add_matrix(const std::string& name, const Eigen::MatrixXd& matrix) {
  std::string body;
  append_element(body, type_double,
                 doubles(matrix.data(), static_cast<std::size_t>(matrix.size())));
  keep(name,
       head_of(class_double,
               {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())}),
       std::move(body));
}

void MatVariables::add_number(const std::string& name, double number) {
  add_matrix(name, Eigen::MatrixXd::Constant(1, 1, number));
}

void MatVariables::add_pages(const std::string& name, const std::vector<Eigen::MatrixXcd>& pages) {
  const Eigen::Index rows = pages.empty() ? 0 : pages.front().rows();
  const Eigen::Index columns = pages.empty() ? 0 : pages.front().cols();
  std::string real, imaginary, body;
  for (const auto& page : pages) {
    if (page.rows() != rows || page.cols() != columns) {
      throw InvalidInput(fmt::format("MAT file: expected pages of {} x {} in '{}', found {} x {}",
                                     rows, columns, name, page.rows(), page.cols()));
    }
    const Eigen::MatrixXd parts[] = {page.real(), page.imag()};
    real += doubles(parts[0].data(), static_cast<std::size_t>(page.size()));
    imaginary += doubles(parts[1].data(), static_cast<std::size_t>(page.size()));
  }
  append_element(body, type_double, real);
  append_element(body, type_double, imaginary);
  keep(name,
       head_of(class_double | complex_flag,
               {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), pages.size()}),
       std::move(body));
}

void MatVariables::add_text(const std::string& name, std::string_view text) {
  auto [head, body] = text_parts(text);
  keep(name, std::move(head), std::move(body));
}

void MatVariables::add_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::string body;
  for (const auto& text : texts) {
    auto [head, content] = text_parts(text);
    body += element_of({{}, std::move(head), std::move(content)}, {});
  }
  keep(name, head_of(class_cell, {texts.size(), 1}), std::move(body));
}

void MatVariables::add_structure(const std::string& name, const MatVariables& fields) {
  std::string length, names, body;
  append_number(length, static_cast<std::int32_t>(longest_name + 1));
  for (const auto& field : fields.variables_) {
    names += field.name;
    names.append(longest_name + 1 - field.name.size(), '\0');
  }
  append_element(body, type_int32, length);
  append_element(body, mat_int8, names);
  for (const auto& field : fields.variables_) body += element_of(field, {});
  keep(name, head_of(class_structure, {1, 1}), std::move(body));
}

std::string MatVariables::file(std::string_view description) const {
  constexpr std::size_t text_size = 116, head_size = 124;
  std::string bytes = "MATLAB 5.0 MAT-file, ";
  bytes += description.substr(0, text_size - bytes.size());
  bytes.resize(text_size, ' ');
  bytes.resize(head_size, '\0');  // no data of a subsystem
  append_number(bytes, std::uint16_t{0x0100});
  append_number(bytes, std::uint16_t{0x4D49});  // "IM" where the low byte comes first
  for (const auto& variable : variables_) bytes += element_of(variable, variable.name);
  return bytes;
}

}  // namespace boresight::io
