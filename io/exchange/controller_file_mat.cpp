#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/records/mat_file.hpp>
#include <boresight/io/records/mat_writer.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr int deepest = 4;
constexpr std::uint64_t max_numbers = 1000000;
constexpr std::uint64_t max_letters = 10000;

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t");
  if (from == std::string::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

// Names apart at commas, semicolons and blanks.
void append_names(const std::string& text, const char* separators,
                  std::vector<std::string>& names) {
  std::size_t from = 0;
  while (from <= text.size()) {
    const auto end = std::min(text.find_first_of(separators, from), text.size());
    const std::string name = trimmed(text.substr(from, end - from));
    if (!name.empty()) names.push_back(name);
    from = end + 1;
  }
}

class ControllerCollector {
 public:
  explicit ControllerCollector(const std::string& file) : file_(file) {}

  void take(MatArray& array, const std::string& name, int depth) {
    if (name == "A") take_matrix(array, "A", text_.a, has_a_);
    if (name == "B") take_matrix(array, "B", text_.b, has_b_);
    if (name == "C") take_matrix(array, "C", text_.c, has_c_);
    if (name == "D") take_matrix(array, "D", text_.d, has_d_);
    if (name == "Ts" || name == "sample_time") {
      Eigen::MatrixXd number;
      bool read = false;
      take_matrix(array, name.c_str(), number, read);
      if (number.size() != 1) {
        throw InvalidInput(fmt::format("{}: {}: expected one number, found {} x {}", file_, name,
                                       number.rows(), number.cols()));
      }
      text_.sample_time = number(0, 0);
    }
    if (name == "inputs" || name == "InputName") text_.inputs = names_of(array, ",; ");
    if (name == "outputs" || name == "OutputName") text_.outputs = names_of(array, ",; ");
    if (name == "input_units") text_.input_units = names_of(array, ",;");
    if (name == "output_units") text_.output_units = names_of(array, ",;");
    if (name == "angles") {
      const auto words = names_of(array, ",;");
      text_.angles = words.empty() ? "" : words.front();
    }
    if (array.kind == MatArray::Class::structure && depth < deepest) {
      read_mat_fields(
          array, [&](const std::string& field, MatArray& inner) { take(inner, field, depth + 1); });
    }
  }

  ControllerText text() && {
    if (!has_d_) {
      throw InvalidInput(fmt::format(
          "{}: expected matrices A, B, C, D (of a state space; an object such as ss is to be taken "
          "apart first: [A, B, C, D, Ts] = ssdata(sys)), found no D",
          file_));
    }
    if (!has_b_ || text_.b.size() == 0)
      text_.b = Eigen::MatrixXd::Zero(text_.a.rows(), text_.d.cols());
    if (!has_c_ || text_.c.size() == 0)
      text_.c = Eigen::MatrixXd::Zero(text_.d.rows(), text_.a.cols());
    return std::move(text_);
  }

 private:
  void take_matrix(MatArray& array, const char* name, Eigen::MatrixXd& matrix, bool& read) const {
    if (array.kind != MatArray::Class::number || array.complex || array.dimensions.size() != 2 ||
        array.elements > max_numbers) {
      throw InvalidInput(
          fmt::format("{}: {}: expected a full real matrix, found something else", file_, name));
    }
    std::vector<double> values;
    if (array.elements > 0) values = array.rest.numbers(array.rest.next());
    if (values.size() != array.elements) {
      array.rest.refuse(fmt::format("{} numbers in {} that should have {}", values.size(),
                                    in_quotes(name), array.elements));
    }
    if (read)
      throw InvalidInput(fmt::format("{}: {}: expected it once, found it again", file_, name));
    matrix = Eigen::Map<const Eigen::MatrixXd>(values.data(),
                                               static_cast<Eigen::Index>(array.dimensions[0]),
                                               static_cast<Eigen::Index>(array.dimensions[1]));
    read = true;
  }

  // A text, rows of texts or cells of texts.
  std::vector<std::string> names_of(MatArray& array, const char* separators) const {
    std::vector<std::string> names;
    if (array.elements == 0) return names;
    if (array.elements > max_letters) {
      throw InvalidInput(fmt::format("{}: expected names of at most {} letters, found {}", file_,
                                     max_letters, array.elements));
    }
    if (array.kind == MatArray::Class::text) {
      const std::vector<double> codes = mat_characters(array);
      const auto rows = static_cast<std::size_t>(array.dimensions[0]);
      for (std::size_t i = 0; i < rows; ++i) {
        std::string row;
        for (std::size_t k = i; k < codes.size(); k += rows) {
          row += codes[k] >= 32.0 && codes[k] < 127.0
                     ? static_cast<char>(static_cast<unsigned char>(codes[k]))
                     : '?';
        }
        append_names(row, separators, names);
      }
    } else if (array.kind == MatArray::Class::other) {
      for (std::uint64_t i = 0; i < array.elements && !array.rest.at_end(); ++i) {
        const MatElement cell = array.rest.next();
        if (cell.type != mat_matrix) break;
        MatArray inner = read_mat_array(cell, array.rest.swapped(), file_);
        if (inner.kind != MatArray::Class::text) continue;
        for (auto& name : names_of(inner, separators)) names.push_back(std::move(name));
      }
    }
    return names;
  }

  const std::string& file_;
  ControllerText text_;
  bool has_a_ = false, has_b_ = false, has_c_ = false, has_d_ = false;
};

// Names with commas between, as the file format of controllers has them.
std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

}  // namespace

ControllerText controller_from_mat(std::string_view content, const std::string& name,
                                   const std::string& part) {
  std::vector<std::string> structures;
  read_mat_file(content, name, [&](MatArray& array) {
    if (array.kind == MatArray::Class::structure) structures.push_back(array.name);
  });
  const std::string wanted = chosen_part(structures, part, name);
  ControllerCollector collector(name);
  read_mat_file(content, name, [&](MatArray& array) {
    if (wanted.empty() || array.name == wanted) collector.take(array, array.name, 0);
  });
  return std::move(collector).text();
}

std::string controller_mat(const plant::StateSpace& controller) {
  MatVariables variables;
  variables.add_matrix("A", controller.a);
  variables.add_matrix("B", controller.b);
  variables.add_matrix("C", controller.c);
  variables.add_matrix("D", controller.d);
  variables.add_number("Ts", controller.sample_time);
  variables.add_text("inputs", joined(controller.inputs));
  variables.add_text("outputs", joined(controller.outputs));
  variables.add_text("angles", "motor");
  return variables.file("controller of an antenna by boresight");
}

}  // namespace boresight::io
