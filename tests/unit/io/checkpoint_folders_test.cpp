#include "spume/io/checkpoint_folders.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/support/scratch_folder.hpp"

namespace spume::io {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;
using testing::text_of;

void put(const fs::path& checkpoint, const std::string& text, bool complete) {
  fs::create_directories(checkpoint);
  std::ofstream(checkpoint / "state") << text;
  if (complete) std::ofstream(checkpoint / "complete") << "yes";
}

std::function<void(const fs::path&)> writer(const std::string& text) {
  return [text](const fs::path& folder) { std::ofstream(folder / "state") << text; };
}

std::string found_in(const fs::path& folder) {
  const auto checkpoint = CheckpointFolders(folder).complete();
  return checkpoint ? text_of(*checkpoint / "state") : "none";
}

TEST(CheckpointFolders, NewestReplacesTheLast) {
  const ScratchFolder folder;
  EXPECT_EQ(found_in(folder.path()), "none");
  for (const char* text : {"one", "two", "three"}) {
    CheckpointFolders(folder.path()).replace(writer(text));
    EXPECT_EQ(found_in(folder.path()), text);
  }
  EXPECT_TRUE(fs::exists(folder.path() / "checkpoint"));
  EXPECT_FALSE(fs::exists(folder.path() / "checkpoint.new"));
  EXPECT_FALSE(fs::exists(folder.path() / "checkpoint.old"));
}

TEST(CheckpointFolders, FailureWhileWritingLeavesTheLastOne) {
  const ScratchFolder folder;
  CheckpointFolders(folder.path()).replace(writer("good"));
  EXPECT_THROW(CheckpointFolders(folder.path()).replace([](const fs::path& empty) {
    std::ofstream(empty / "state") << "half";
    throw std::runtime_error("disk full");
  }),
               std::runtime_error);
  EXPECT_EQ(found_in(folder.path()), "good");
  CheckpointFolders(folder.path()).replace(writer("next"));
  EXPECT_EQ(found_in(folder.path()), "next");
}

// What a kill leaves behind, instant by instant: (new, current, old) with the state that must be found.
TEST(CheckpointFolders, EveryInstantOfAReplacementHasACompleteOne) {
  struct Instant {
    const char *in_new, *in_current, *in_old, *expected;  // "-": no folder; leading '?': no marker
  };
  const Instant instants[] = {
      {"?half", "B", "-", "B"},  // while writing
      {"C", "B", "-", "C"},      // marker written
      {"C", "-", "B", "C"},      // between the two renames
      {"-", "C", "B", "C"},      // renamed, the old one not yet removed
      {"-", "C", "?half", "C"},  // while removing the old one
      {"?half", "-", "B",
       "B"},                 // killed between the renames, restarted with new removed, killed while writing
      {"C", "B", "A", "C"},  // an old one was left from before
      {"?half", "-", "-", "none"},  // before the first was ever complete
  };
  for (const Instant& instant : instants) {
    const ScratchFolder folder;
    const auto make = [&](const char* name, const std::string& text) {
      if (text != "-")
        put(folder.path() / name, text.front() == '?' ? text.substr(1) : text, text.front() != '?');
    };
    make("checkpoint.new", instant.in_new);
    make("checkpoint", instant.in_current);
    make("checkpoint.old", instant.in_old);
    EXPECT_EQ(found_in(folder.path()), instant.expected);
    // A writer that is killed right away must not lose it, and one that succeeds cleans up.
    EXPECT_THROW(
        CheckpointFolders(folder.path()).replace([](const fs::path&) { throw std::runtime_error("killed"); }),
        std::runtime_error);
    EXPECT_EQ(found_in(folder.path()), instant.expected);
    CheckpointFolders(folder.path()).replace(writer("D"));
    EXPECT_EQ(text_of(folder.path() / "checkpoint" / "state"), "D");
    EXPECT_FALSE(fs::exists(folder.path() / "checkpoint.new"));
    EXPECT_FALSE(fs::exists(folder.path() / "checkpoint.old"));
  }
}

TEST(CheckpointFolders, KilledWritersLeaveAWholeStateEveryTime) {
  const ScratchFolder folder;
  const std::size_t length = 200000;
  CheckpointFolders(folder.path()).replace(writer(std::string(length, 'a')));
  for (int kill_number = 0; kill_number < 15; ++kill_number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (char c = 'a';; c = c == 'z' ? 'a' : c + 1)
        CheckpointFolders(folder.path()).replace(writer(std::string(length, c)));
    }
    usleep(2000 + 1700 * kill_number);
    ::kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    const std::string text = found_in(folder.path());
    ASSERT_EQ(text.size(), length);
    EXPECT_EQ(text.find_first_not_of(text.front()), std::string::npos);
  }
}

}  // namespace
}  // namespace spume::io
