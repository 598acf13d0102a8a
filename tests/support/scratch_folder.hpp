#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "spume/parallel/communicator.hpp"

namespace spume::testing {

/// An empty folder of the running test, seen by all ranks, removed at the end. Collective.
class ScratchFolder {
 public:
  ScratchFolder() : communicator_(parallel::Communicator::world()) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ =
        std::filesystem::temp_directory_path() / ("spume_" + std::string(test->test_suite_name()) + "_" +
                                                  test->name() + "_" + std::to_string(communicator_.size()));
    communicator_.on_root([&] {
      std::filesystem::remove_all(path_);
      std::filesystem::create_directories(path_);
    });
  }
  ~ScratchFolder() {
    communicator_.barrier();
    if (communicator_.is_root()) std::filesystem::remove_all(path_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  parallel::Communicator communicator_;
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace spume::testing
