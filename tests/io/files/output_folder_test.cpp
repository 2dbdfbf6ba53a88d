#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/files/output_folder.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

TEST(OutputFolder, IsMadeWithThoseAboveItAndKeptWhereItIs) {
  const auto root = std::filesystem::temp_directory_path() / "boresight-output-folder";
  std::filesystem::remove_all(root);
  const auto folder = output_folder(root / "a/b", "sheets");
  EXPECT_TRUE(std::filesystem::is_directory(folder));
  std::ofstream(folder / "file") << "kept";
  EXPECT_EQ(output_folder(folder, "sheets"), folder);
  EXPECT_TRUE(std::filesystem::exists(folder / "file"));
  std::filesystem::remove_all(root);
}

TEST(OutputFolder, RefusesAFileInItsPlace) {
  const auto path = std::filesystem::temp_directory_path() / "boresight-output-folder-file";
  std::ofstream(path) << "no folder";
  try {
    output_folder(path, "sheets");
    FAIL() << "made a folder of a file";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("expected a folder to write sheets to, found none"));
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace boresight::io
