#pragma once
// What a calculation does with its memory between one step and the next.

namespace zerodrift {

/// From now on memory that is freed stays with the process, up to some hundred MB, instead of going back to the system.
/// A search that frees megabytes and asks for as many again, a thousand times, would get every page anew and filled
/// with zeros; that took a third of its time. Does nothing where the C library is not GNU's.
void keep_freed_memory();

}  // namespace zerodrift
