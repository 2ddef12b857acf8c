/// @file  Returns freed memory to the operating system.
#pragma once

namespace flytri {

/// Call it after work that needed much memory for a short time. The allocator keeps the memory that
/// a thread frees, so a scan would otherwise hold the peak of each thread. Takes some milliseconds;
/// does nothing if the C library has no such call.
void release_free_memory();

}  // namespace flytri
