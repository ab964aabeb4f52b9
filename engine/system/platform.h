#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/system/file_descriptor.h"

namespace clatter {

// The parts of the program that need more than POSIX. platform_linux.cpp has them for Linux with
// glibc. platform_plain.cpp needs only POSIX; "Plain:" below states its limitation. The CMake
// option CLATTER_PLAIN_SYSTEM selects it.

/// Asks for huge pages in newly allocated memory. Plain: large arrays stay on small pages.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Memory that the system gives to this process, in bytes: that of the machine, or the limit of its
/// control groups. Plain: infinity, so that no scene is rejected as too large.
double machine_memory();

/// Number of processors that the system gives to this process: those of its affinity, or the quota
/// of its control groups, rounded up. Plain: all processors of the machine.
int machine_processors();

/// Bytes currently allocated by the process. Plain: 0.
double heap_bytes();

/// Returns unused memory of the heap to the system. Plain: the process keeps it.
void return_unused_memory();

/// Resets the peak of the resident memory to its current size. Plain: keeps the peak since the
/// start.
void restart_peak_memory();

/// A file without a name, closed in child processes; none with errno on failure. Plain: the file is
/// in the folder of temporary files.
FileDescriptor nameless_file();

/// A pipe whose ends are closed in child processes.
struct Pipe {
  FileDescriptor output, input;
};
/// Makes a pipe; absent with errno on failure. Plain: a child that another thread starts at the
/// same moment may inherit the ends.
std::optional<Pipe> make_pipe();

/// Kills this child process when its parent ends. Plain: it runs to its own end.
void end_with_parent();

/// A name with which a child process can open this file while this process lives. Plain, and
/// without /proc: `path`, which may meanwhile be another file.
std::string name_while_open(const FileDescriptor& file, const std::string& path);

/// A name that starts this program again, independent of its start. Plain: `name`, to be found on
/// the PATH.
std::string this_program(const std::string& name);

}  // namespace clatter
