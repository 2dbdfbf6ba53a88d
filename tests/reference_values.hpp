#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "zero_order_hold.hpp"
#include "zeros_poles_gain.hpp"
#include <boresight/plant/linear/state_space.hpp>

/// What others found (tests/data/reference), read for tests, benchmarks and the accuracy report.
namespace boresight::reference {

inline std::string text_of_file(const std::string& path) {
  std::ifstream file(BORESIGHT_SOURCE_DIR "/tests/data/reference/" + path);
  if (!file) throw std::runtime_error("no reference data at " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// values/NAME.json
inline nlohmann::json reference_values(const std::string& name) {
  return nlohmann::json::parse(text_of_file("values/" + name + ".json"));
}

/// peers.json: item -> modes -> {val, from_, refined}
inline nlohmann::json peer_values() {
  return nlohmann::json::parse(text_of_file("peers.json"));
}

/// The element of a list of cases with that `id`.
inline nlohmann::json case_of(const nlohmann::json& cases, std::string_view id) {
  for (const auto& entry : cases) {
    if (entry.at("id") == id) return entry;
  }
  throw std::runtime_error("no reference case " + std::string(id));
}

/// Rows of numbers; "I2" is the identity of two rows, "I" one of `rows` rows.
inline Eigen::MatrixXd matrix(const nlohmann::json& rows, Eigen::Index size = 0) {
  if (rows.is_string()) {
    const auto text = rows.get<std::string>();
    if (text.front() != 'I') throw std::runtime_error("no matrix: " + text);
    if (text.size() > 1) size = std::stoi(text.substr(1));
    return Eigen::MatrixXd::Identity(size, size);
  }
  const auto columns = rows.empty() ? 0 : rows.front().size();
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(columns));
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      result(i, j) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
    }
  }
  return result;
}

/// Numbers, or pairs of real and imaginary part.
inline std::vector<std::complex<double>> complex_numbers(const nlohmann::json& list) {
  std::vector<std::complex<double>> result;
  for (const auto& entry : list) {
    if (entry.is_array()) {
      result.emplace_back(entry.at(0).get<double>(), entry.at(1).get<double>());
    } else {
      result.emplace_back(entry.get<double>(), 0.0);
    }
  }
  return result;
}

/// Coefficients as the files have them, descending powers, to the ascending ones of `rational`.
inline std::vector<double> ascending(const nlohmann::json& coefficients) {
  auto descending = coefficients.get<std::vector<double>>();
  return {descending.rbegin(), descending.rend()};
}

/// Inputs u (or u1, u2, ...), outputs y, states x1, x2, ...
inline plant::StateSpace state_space(Eigen::MatrixXd a, Eigen::MatrixXd b, Eigen::MatrixXd c,
                                     Eigen::MatrixXd d, double sample_time = 0.0) {
  const auto names = [](const std::string& stem, Eigen::Index count, bool number_one) {
    std::vector<std::string> result;
    for (Eigen::Index i = 1; i <= count; ++i) {
      result.push_back(count == 1 && !number_one ? stem : stem + std::to_string(i));
    }
    return result;
  };
  plant::StateSpace system;
  system.inputs = names("u", b.cols(), false);
  system.outputs = names("y", c.rows(), false);
  system.states = names("x", a.rows(), true);
  system.a = std::move(a);
  system.b = std::move(b);
  system.c = std::move(c);
  system.d = std::move(d);
  system.sample_time = sample_time;
  plant::validate(system);
  return system;
}

/// {A, B, C, [D], [Ts]}
inline plant::StateSpace matrices_of(const nlohmann::json& file) {
  const Eigen::MatrixXd a = matrix(file.at("A"));
  const Eigen::MatrixXd b = matrix(file.at("B"), a.rows());
  const Eigen::MatrixXd c = matrix(file.at("C"), a.rows());
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(c.rows(), b.cols());
  if (file.contains("D") && file.at("D").is_array()) d = matrix(file.at("D"));
  return state_space(a, b, c, d, file.value("Ts", 0.0));
}

/// {gain, zeros, poles, [Ts]} as a cascade of first- and second-order sections.
inline plant::StateSpace sections_of(const nlohmann::json& file) {
  return zeros_poles_gain(complex_numbers(file.at("zeros")), complex_numbers(file.at("poles")),
                          file.at("gain"), file.value("Ts", 0.0));
}

/// One system of a reference file, whatever its kind; input u, output y where there is one each.
inline plant::StateSpace system_of(const nlohmann::json& file) {
  const std::string kind = file.value("kind", "ss");
  if (kind == "zpk" || kind == "zpk_discrete") return sections_of(file);
  if (kind == "ss") return matrices_of(file);
  if (kind == "tf" || kind == "tf_sampled") {
    const auto continuous =
        plant::rational(ascending(file.at("num")), ascending(file.at("den")), "u", "y", "x");
    return kind == "tf" ? continuous : zero_order_hold(continuous, file.at("Ts"));
  }
  if (kind == "ss_expr" && file.at("expr").get<std::string>().starts_with("100/(0.002*s+1) * ")) {
    plant::StateSpace masses = matrices_of(file);
    masses.inputs = {"torque"};
    return plant::connect({plant::rational({100.0}, {1.0, 0.002}, "u", "torque", "lag"), masses},
                          {"u"}, {"y"});
  }
  throw std::runtime_error("a reference system of unknown kind " + kind);
}

/// The coefficients that the verified values of pc_disc_gh523a_T0.05 (margins.json) belong to: the
/// file prints them rounded, and the numerator with a slip.
inline nlohmann::json sampled_resonance() {
  const double w = 2.0 * std::acos(-1.0);
  return {{"num", {1.1 * w * w}}, {"den", {1.0, 0.4 * w, w * w}}};
}

/// A number as printed, and half a unit of its last digit.
struct PrintedNumber {
  double value = 0.0;
  double half_unit = 0.0;
};

/// `text`: fixed or exponential (E, D) notation.
inline PrintedNumber printed_number(std::string text) {
  const auto exponent_at = text.find_first_of("eEdD");
  int exponent = 0;
  if (exponent_at != std::string::npos) {
    text[exponent_at] = 'e';
    exponent = std::stoi(text.substr(exponent_at + 1));
  }
  const std::string mantissa = text.substr(0, exponent_at);
  const auto point = mantissa.find('.');
  const auto decimals =
      point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  return {std::stod(text), 0.5 * std::pow(10.0, exponent - decimals)};
}

/// A number of a JSON file with the digits it stands there with (but for zeros at its end).
inline PrintedNumber printed_number(const nlohmann::json& number) {
  return printed_number(number.dump());
}

/// The numbers of a line, whatever stands between them.
inline std::vector<PrintedNumber> printed_numbers(const std::string& line) {
  std::vector<PrintedNumber> result;
  for (std::size_t at = 0; at < line.size();) {
    const auto start = line.find_first_of("+-.0123456789", at);
    if (start == std::string::npos) break;
    const auto end = std::min(line.find_first_not_of("+-.0123456789eEdD", start), line.size());
    const std::string token = line.substr(start, end - start);
    // "2x3", "H2": digits inside a word are no numbers of the table.
    const bool in_word = start > 0 && std::isalpha(static_cast<unsigned char>(line[start - 1]));
    if (!in_word && token.find_first_of("0123456789") != std::string::npos) {
      result.push_back(printed_number(token));
    }
    at = end;
  }
  return result;
}

/// slicot/data/NAME.dat: a title, one line of scalars, then matrices row by row.
class SlicotData {
 public:
  explicit SlicotData(const std::string& name) : text_(text_of_file("slicot/data/" + name)) {
    std::string title, line;
    std::getline(text_, title);
    std::getline(text_, line);
    for (const char mark : {'(', ')', ','}) std::replace(line.begin(), line.end(), mark, ' ');
    std::istringstream words(line);
    for (std::string word; words >> word;) scalars_.push_back(word);
  }

  double scalar(std::size_t i) const { return printed_number(scalars_.at(i)).value; }

  Eigen::MatrixXd next_matrix(Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd result(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < columns; ++j) {
        std::string word;
        if (!(text_ >> word)) throw std::runtime_error("a SLICOT data file ends too early");
        result(i, j) = printed_number(word).value;
      }
    }
    return result;
  }

 private:
  std::istringstream text_;
  std::vector<std::string> scalars_;
};

/// The numbers of slicot/results/NAME.res that follow a line containing `heading`, on that line
/// itself or from the next one that has any, row by row up to the next line without.
inline std::vector<std::vector<PrintedNumber>> slicot_result(const std::string& name,
                                                             std::string_view heading) {
  std::istringstream text(text_of_file("slicot/results/" + name));
  std::vector<std::vector<PrintedNumber>> rows;
  bool found = false;
  for (std::string line; std::getline(text, line);) {
    if (!found) {
      const auto at = line.find(heading);
      if (at == std::string::npos) continue;
      found = true;
      line = line.substr(at + heading.size());
    }
    const auto numbers = printed_numbers(line);
    if (!numbers.empty()) {
      rows.push_back(numbers);
    } else if (!rows.empty()) {
      break;
    }
  }
  if (rows.empty()) throw std::runtime_error("no numbers under that heading of " + name);
  return rows;
}

}  // namespace boresight::reference
