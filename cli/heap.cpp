#include "cli/heap.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace farol::cli {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;
constexpr int kLargestBlock = 32 << 20;  ///< glibc's greatest M_MMAP_THRESHOLD
constexpr int kMostKept = 1 << 30;

}  // namespace

void growHeap(int bytes) {
    // All threads share the one heap that grows here, and large blocks come from it, too.
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, kLargestBlock);
    mallopt(M_TRIM_THRESHOLD, kMostKept);
    mallopt(M_TOP_PAD, bytes);
    void* block = std::malloc(kHugePage);  // from the end of the heap, which grows by the pad
    mallopt(M_TOP_PAD, static_cast<int>(kHugePage));
    if (block == nullptr) return;
    const auto first = (reinterpret_cast<std::uintptr_t>(block) + kHugePage - 1) & ~(kHugePage - 1);
    const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) & ~(kHugePage - 1);
    if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
    std::free(block);
}

}  // namespace farol::cli
