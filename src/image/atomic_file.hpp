#pragma once
// Files that are whole or not there: what is written goes beside its place under a temporary name,
// is flushed to the disk, and takes its name only then. If anything fails, the file that was there
// before stays as it was, and no temporary file is left.

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace wold {

/// Calls `write` with a temporary path in the same folder and with the same extension, flushes what
/// it wrote and moves it to `path`. Rethrows what `write` throws; otherwise throws Error(io) that
/// names `path` and the cause.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

/// Writes these bytes as the file `path`. Throws Error(io).
void write_file(const std::string& path, std::string_view bytes);

/// The whole file. Throws Error(io) if it is missing or cannot be read; a folder is not a file.
std::string read_file(const std::string& path);

/// To be called before long work: throws Error(io) unless `path` could be written now (its folder
/// exists and allows new files, and it is no folder itself), and Error(usage) if `extensions` is
/// not empty and has not the extension of `path` (".png"; capitals do not matter).
void check_writable(const std::string& path, std::span<const std::string> extensions = {});

/// Calls `write`, which writes files into the folder; makes the folder before, and if `write`
/// throws and nothing is in it, takes it away again. Throws Error(io), and what `write` throws.
void write_folder(const std::string& folder, const std::function<void()>& write);

/// To be called before long work: throws Error(io) unless files could be written into the folder
/// now, which may be missing.
void check_folder_writable(const std::string& folder);

/// "the disk is full": what a system error number means, for messages.
std::string io_reason(int error);

/// The extension with its dot, in small letters: ".png"; empty if there is none.
std::string extension_of(const std::string& path);

}  // namespace wold
