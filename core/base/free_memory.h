/// @file  Gives memory that was freed back to the system.
#pragma once

namespace flytri {

/// After work that needed much for a while: the allocator keeps what a thread frees, so that a scan
/// would hold the most that each of its threads ever needed. Takes some milliseconds; does nothing
/// where the allocator has no such call.
void release_free_memory();

}  // namespace flytri
