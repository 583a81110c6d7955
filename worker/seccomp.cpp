#include <asm/termbits.h>
#include <fcntl.h>
#include <linux/sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "worker/sandbox.h"

namespace farol::worker {
namespace {

// Calls of Mesa, LLVM, the C library and the file readers after the setup, allowed with any
// arguments. A call that is neither here nor among the rules below fails with EPERM.
constexpr int kAllowed[] = {
    // memory and threads; LLVM generates code at run time, so executable pages stay possible
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect), SCMP_SYS(futex),
    SCMP_SYS(set_robust_list), SCMP_SYS(get_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(sched_getparam), SCMP_SYS(sched_getscheduler),
    SCMP_SYS(getcpu), SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(restart_syscall),
    // time
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(time),
    // facts about itself
    SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(getppid), SCMP_SYS(getuid), SCMP_SYS(geteuid),
    SCMP_SYS(getgid), SCMP_SYS(getegid), SCMP_SYS(getrusage), SCMP_SYS(times), SCMP_SYS(uname),
    SCMP_SYS(sysinfo), SCMP_SYS(getrandom), SCMP_SYS(getcwd),
    // open descriptors, and names; the rules below restrict opening
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(preadv), SCMP_SYS(write),
    SCMP_SYS(writev), SCMP_SYS(lseek), SCMP_SYS(close), SCMP_SYS(dup), SCMP_SYS(poll),
    SCMP_SYS(ppoll), SCMP_SYS(fstat), SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(newfstatat),
    SCMP_SYS(statx), SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2),
    SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getdents64), SCMP_SYS(fadvise64),
    // its own signal handlers
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
    SCMP_SYS(sigaltstack)};

// Writing Mesa's shader cache; Landlock confines these calls to its folder.
constexpr int kCacheCalls[] = {SCMP_SYS(mkdir), SCMP_SYS(rename),    SCMP_SYS(unlink),
                               SCMP_SYS(flock), SCMP_SYS(ftruncate), SCMP_SYS(fallocate)};

// F_SETOWN, F_SETSIG, F_SETLEASE and F_NOTIFY make the kernel send signals, to any process of the
// user before Landlock ABI 6. F_SETFL could make the log's shared pipe block other workers.
constexpr int kDescriptorCommands[] = {F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC};

constexpr int kAdvice[] = {MADV_NORMAL,   MADV_RANDOM, MADV_SEQUENTIAL, MADV_WILLNEED,
                           MADV_DONTNEED, MADV_FREE,   MADV_HUGEPAGE,   MADV_NOHUGEPAGE,
                           MADV_DONTDUMP, MADV_DODUMP};

// Memory that RLIMIT_DATA does not count: shared, growing down, huge pages, locked.
constexpr scmp_datum_t kMappingKind = 0x0F | MAP_GROWSDOWN | MAP_HUGETLB | MAP_LOCKED;

// Flags of clone(2) that a thread of the C library may have beside CLONE_THREAD: none that makes a
// namespace, a process or a tracer. 0x400000 is CLONE_DETACHED, which the kernel ignores.
constexpr scmp_datum_t kThreadFlags =
    CLONE_VM | CLONE_FS | CLONE_FILES | CLONE_SIGHAND | CLONE_THREAD | CLONE_SYSVSEM |
    CLONE_SETTLS | CLONE_PARENT_SETTID | CLONE_CHILD_CLEARTID | CLONE_CHILD_SETTID | 0x400000;

class Filter {
  public:
    Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM))) {}
    ~Filter() {
        if (context_ != nullptr) seccomp_release(context_);
    }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    template <typename... Conditions>
    void add(std::uint32_t action, int call, Conditions... conditions) {
        // -EDOM: this machine has no such call.
        const int result =
            seccomp_rule_add(context_, action, call, sizeof...(conditions), conditions...);
        if (result != 0 && result != -EDOM && error_ == 0) error_ = -result;
    }
    /// 0, or an errno.
    int load() {
        if (context_ == nullptr) return ENOMEM;
        if (error_ != 0) return error_;
        if (const int failed = seccomp_attr_set(context_, SCMP_FLTATR_CTL_TSYNC, 1); failed != 0)
            return -failed;
        return -seccomp_load(context_);
    }
    bool usable() const { return context_ != nullptr; }

  private:
    scmp_filter_ctx context_;
    int error_ = 0;
};

scmp_arg_cmp argument(unsigned index, scmp_compare how, scmp_datum_t a, scmp_datum_t b = 0) {
    scmp_arg_cmp compare{};
    compare.arg = index;
    compare.op = how;
    compare.datum_a = a;
    compare.datum_b = b;
    return compare;
}

}  // namespace

std::string restrictCalls(int socket, bool writesCache) {
    Filter filter;
    if (!filter.usable()) return "missing: seccomp_init failed";
    const auto equal = [](unsigned index, long value) {
        return argument(index, SCMP_CMP_EQ, static_cast<scmp_datum_t>(value));
    };
    for (const int call : kAllowed) filter.add(SCMP_ACT_ALLOW, call);
    for (const int command : kDescriptorCommands)
        filter.add(SCMP_ACT_ALLOW, SCMP_SYS(fcntl), equal(1, command));
    for (const int advice : kAdvice)
        filter.add(SCMP_ACT_ALLOW, SCMP_SYS(madvise), equal(2, advice));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(mmap),
               argument(3, SCMP_CMP_MASKED_EQ, kMappingKind, MAP_PRIVATE));
    // Landlock before ABI 3 does not see O_TRUNC with O_RDONLY.
    const scmp_datum_t forbidden =
        writesCache ? O_TRUNC : O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(open), argument(1, SCMP_CMP_MASKED_EQ, forbidden, 0));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(openat), argument(2, SCMP_CMP_MASKED_EQ, forbidden, 0));
    if (writesCache) {
        for (const int call : kCacheCalls) filter.add(SCMP_ACT_ALLOW, call);
        // The cache's index is mapped; shared memory without a file is not possible.
        filter.add(SCMP_ACT_ALLOW, SCMP_SYS(mmap),
                   argument(3, SCMP_CMP_MASKED_EQ, kMappingKind | MAP_ANONYMOUS, MAP_SHARED));
    }
    // Threads, not processes. The C library falls back to clone, whose flags can be checked.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(clone),
               argument(0, SCMP_CMP_MASKED_EQ, ~kThreadFlags | CLONE_THREAD, CLONE_THREAD));
    filter.add(SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(sendto), equal(0, socket));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(recvfrom), equal(0, socket));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(prctl), equal(0, PR_SET_NAME));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(ioctl), equal(1, TCGETS));  // isatty()
    // A library of the module for OpenEXR locks a buffer, and warns where it cannot: the call
    // succeeds, and nothing is locked.
    filter.add(SCMP_ACT_ERRNO(0), SCMP_SYS(mlock));
    // Reading its own limits: the third argument would be the new ones.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), equal(0, 0), equal(2, 0));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(getrlimit));
    // abort() signals its own process.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(tgkill), equal(0, getpid()));
    const int failed = filter.load();
    return failed == 0 ? "on" : std::string("missing: ") + std::strerror(failed);
}

}  // namespace farol::worker
