#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/system/file_descriptor.h"

namespace clatter {

// The parts of the program that need more than POSIX. platform_linux.cpp has them for Linux with
// glibc. platform_plain.cpp needs POSIX alone, and gives up what each function says; the option
// CLATTER_PLAIN_SYSTEM of CMake chooses it.

/// Asks for huge pages in newly allocated memory. Plain: large arrays stay on small pages.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Bytes of memory of the machine. Plain: infinity, so that no scene is refused as too large.
double machine_memory();

/// Bytes that the process has allocated at present. Plain: 0.
double heap_bytes();

/// Takes the resident size of now as the largest so far. Plain: the largest since the start stays.
void restart_peak_memory();

/// A file without a name, closed in child processes; none, with errno set, where that fails. Plain:
/// it is on the disk of temporary files.
FileDescriptor nameless_file();

/// A pipe whose ends are closed in child processes.
struct Pipe {
  FileDescriptor output, input;
};
/// Nothing, with errno set, where that fails. Plain: a child that starts at the same moment on
/// another thread may inherit the ends.
std::optional<Pipe> make_pipe();

/// A name by which a child process opens this very file while we live. Plain: `path`, which another
/// process may have given to another file meanwhile.
std::string name_while_open(const FileDescriptor& file, const std::string& path);

/// A name that starts this program again, however it was started. Plain: `name`, which is then
/// sought on the PATH.
std::string this_program(const std::string& name);

}  // namespace clatter
