#include "image/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../base/testing.hpp"

namespace wold {
namespace {

namespace fs = std::filesystem;

using testing_base::error_of;

class AtomicFile : public testing_base::FolderTest {};

std::string check_error(const std::string& file, ErrorKind kind,
                        const std::vector<std::string>& extensions = {}) {
  return error_of([&] { check_writable(file, extensions); }, kind);
}

TEST_F(AtomicFile, FailureLeavesTheOldFileAndNoOther) {
  write_file(path("a.txt"), "old");
  const auto failing = [](const std::string& temporary) {
    std::ofstream(temporary) << "half of the ne";
    throw Error(ErrorKind::cancelled, "stopped");
  };
  EXPECT_THROW(write_atomically(path("a.txt"), failing), Error);
  EXPECT_EQ(read_file(path("a.txt")), "old");
  EXPECT_THROW(write_atomically(path("b.txt"), failing), Error);
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, TheTemporaryFileIsBesideItsPlaceWithTheSameExtension) {
  write_atomically(path("a.exr"), [&](const std::string& temporary) {
    EXPECT_EQ(fs::path(temporary).extension(), ".exr");
    EXPECT_EQ(fs::path(temporary).parent_path(), folder());
    EXPECT_FALSE(fs::exists(path("a.exr")));
    std::ofstream(temporary) << "new";
  });
  EXPECT_EQ(read_file(path("a.exr")), "new");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, PermissionsAndLinksStay) {
  write_file(path("a.txt"), "old");
  ASSERT_EQ(::chmod(path("a.txt").c_str(), 0640), 0);
  fs::create_symlink("a.txt", path("link.txt"));
  write_file(path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(read_file(path("a.txt")), "new");
  EXPECT_EQ(fs::status(path("a.txt")).permissions(), static_cast<fs::perms>(0640));
}

TEST_F(AtomicFile, WhatCannotBeWrittenIsSaidBefore) {
  EXPECT_NO_THROW(check_writable(path("a.exr")));
  EXPECT_EQ(check_error("", ErrorKind::usage), "the name of the file to write is empty");
  EXPECT_EQ(
      check_error(path("x/a.exr"), ErrorKind::io),
      "cannot write '" + path("x/a.exr") + "': the folder '" + path("x") + "' does not exist");
  EXPECT_EQ(check_error(folder().string(), ErrorKind::io),
            "cannot write '" + folder().string() + "': it is a folder; add a file name");
  write_file(path("file"), "");
  EXPECT_EQ(check_error(path("file/a.exr"), ErrorKind::io),
            "cannot write '" + path("file/a.exr") + "': '" + path("file") + "' is not a folder");
  EXPECT_EQ(check_error("/dev/null", ErrorKind::io),
            "cannot write '/dev/null': it is not a regular file");
  EXPECT_EQ(check_error("a.xyz", ErrorKind::usage, {".exr", ".png"}),
            "cannot write 'a.xyz': unknown extension '.xyz'; known are .exr, .png");
  EXPECT_EQ(check_error("a", ErrorKind::usage, {".exr"}),
            "cannot write 'a': its name has no extension; known are .exr");
  const std::vector<std::string> exr{".exr"};
  EXPECT_NO_THROW(check_writable(path("A.EXR"), exr));
}

TEST_F(AtomicFile, AFolderIsMadeForFilesAndTakenAwayIfThereAreNone) {
  const auto fail = [] { throw Error(ErrorKind::io, "the disk is full"); };
  EXPECT_THROW(write_folder(path("a/b/"), fail), Error);
  EXPECT_EQ(file_count(), 0);
  EXPECT_THROW(write_folder(path("a/b"),
                            [&] {
                              write_file(path("a/b/one"), "1");
                              fail();
                            }),
               Error);
  EXPECT_EQ(read_file(path("a/b/one")), "1");
  fs::create_directory(path("empty"));
  EXPECT_THROW(write_folder(path("empty"), fail), Error);
  EXPECT_TRUE(fs::exists(path("empty"))) << "it was there before";
  write_folder(path("c"), [&] { write_file(path("c/two"), "2"); });
  EXPECT_EQ(read_file(path("c/two")), "2");
}

TEST_F(AtomicFile, AFolderThatCannotBeWrittenIntoIsSaidBefore) {
  EXPECT_NO_THROW(check_folder_writable(folder().string()));
  EXPECT_NO_THROW(check_folder_writable(path("not/there/yet/")));
  EXPECT_NO_THROW(check_folder_writable("maps"));
  write_file(path("file"), "");
  const auto complaint = [](const std::string& folder) {
    return error_of([&] { check_folder_writable(folder); }, ErrorKind::io);
  };
  EXPECT_EQ(complaint(path("file")), "cannot write into '" + path("file") + "': it is no folder");
  EXPECT_EQ(complaint(path("file/maps")),
            "cannot write into '" + path("file/maps") + "': '" + path("file") + "' is no folder");
}

TEST_F(AtomicFile, ReadOnlyFolderIsSaidBefore) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(folder(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(check_error(path("a.exr"), ErrorKind::io).find("permission denied"), std::string::npos);
}

}  // namespace
}  // namespace wold
