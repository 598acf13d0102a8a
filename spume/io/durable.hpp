#pragma once

#include <filesystem>
#include <string>

namespace spume::io {

/// Puts what was written to a file, or the entries of a folder, onto the disk (fsync).
/// Throws std::runtime_error when the system refuses.
void put_on_disk(const std::filesystem::path& path);

/// Puts `from` onto the disk and renames it to `to`, which it replaces: a reader, and a restart after a crash
/// at any instant, finds either the old file or the new one, whole. Throws std::runtime_error when the system
/// refuses.
void replace_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes a text file by replace_durably().
void write_text_durably(const std::filesystem::path& path, const std::string& text);

}  // namespace spume::io
