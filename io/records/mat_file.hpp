#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/records/mat_elements.hpp>

namespace boresight::io {

/// The arrays of a MAT file of version 5, compressed or not, in their order. An array is read from
/// bytes that are gone after `take`. `name` stands in messages.
/// @throws InvalidInput for another version and what is damaged, and as `take` does
void read_mat_file(std::string_view content, std::string_view name,
                   const std::function<void(MatArray&)>& take);

/// The fields of a structure that are arrays, in their order. Nothing of an array of structures.
/// @throws InvalidInput if it is damaged, and as `take` does
void read_mat_fields(MatArray& structure,
                     const std::function<void(const std::string& field, MatArray&)>& take);

/// Codes of a text's characters, column by column. @throws InvalidInput if it is damaged
std::vector<double> mat_characters(MatArray& text);

}  // namespace boresight::io
