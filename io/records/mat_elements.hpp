#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::io {

/// A data element of a MAT file of version 5: its type and bytes.
struct MatElement {
  std::uint32_t type = 0;
  std::string_view bytes;
};

/// Meaning of `type` of an element. Values of the file format.
enum MatType : std::uint32_t { mat_int8 = 1, mat_matrix = 14, mat_compressed = 15 };

/// Walks over the elements that stand one behind the other in some bytes.
class MatCursor {
 public:
  /// `swapped`: the file has the other byte order than this machine. `name` stands in messages.
  MatCursor(std::string_view bytes, bool swapped, std::string_view name)
      : bytes_(bytes), swapped_(swapped), name_(name) {}

  bool at_end() const { return position_ >= bytes_.size(); }
  /// @throws InvalidInput if the element is longer than the bytes left
  MatElement next();
  bool swapped() const { return swapped_; }
  std::string_view name() const { return name_; }
  /// "NAME: expected a whole MAT file, found WHAT". @throws InvalidInput always
  [[noreturn]] void refuse(const std::string& what) const;

  /// Numbers of any type as doubles. @throws InvalidInput for a type that holds none
  std::vector<double> numbers(const MatElement& element) const;
  /// Same, of 32-bit integers.
  std::vector<std::int64_t> integers(const MatElement& element) const;

 private:
  std::uint32_t word(std::size_t at) const;

  std::string_view bytes_;
  bool swapped_;
  std::string_view name_;
  std::size_t position_ = 0;
};

/// The array that a matrix element holds, its parts still undecoded.
struct MatArray {
  enum class Class { structure, text, number, other };
  Class kind = Class::other;
  bool complex = false;
  std::string name;
  std::vector<std::int64_t> dimensions;
  /// Product of the dimensions.
  std::uint64_t elements = 0;
  /// Elements behind the name.
  MatCursor rest;
};

/// @throws InvalidInput if it is damaged
MatArray read_mat_array(const MatElement& matrix, bool swapped, std::string_view name);

/// Bytes of a compressed element, at most 1032 times as many (deflate can do no more).
/// @throws InvalidInput if they are damaged or shorter than they say
std::string inflate_mat(const MatElement& compressed, bool swapped, std::string_view name);

}  // namespace boresight::io
