#pragma once

namespace farol::cli {

/// Grows the heap once by `bytes` in pages of 2 MiB (transparent huge pages), where the kernel has
/// them, and keeps freed memory in it. A process that draws one image touches 20,000 fresh pages of
/// 4 KiB otherwise, each a fault of the kernel. For processes that end after their work, and before
/// they start threads. No effect where the kernel refuses the memory.
void growHeap(int bytes);

}  // namespace farol::cli
